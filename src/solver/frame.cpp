#include "solver/frame.h"

namespace weft {

std::vector<std::string_view> report_names(std::uint32_t reports) {
    std::vector<std::string_view> names;
    if (reports & report_speed_capped) names.push_back("SpeedCapped");
    if (reports & report_non_finite) names.push_back("NonFinite");
    return names;
}

void draw_surface(const ClothFrame& cloth, std::vector<Vec3>& positions, std::vector<Vec3>& normals) {
    if (!cloth.model->binding.empty()) {
        follow(cloth.model->binding, cloth.positions, cloth.normals, positions, normals);
        return;
    }
    const auto& particle = cloth.model->topology.vertex_to_particle;
    positions.resize(particle.size());
    normals.resize(particle.size());
    for (std::size_t v = 0; v < particle.size(); ++v) {
        const bool still = particle[v] == none;
        positions[v] = still ? cloth.model->mesh.positions[v] : cloth.positions[particle[v]].xyz();
        normals[v] = still ? Vec3{0, 1, 0} : cloth.normals[particle[v]].xyz();
    }
}

}  // namespace weft
