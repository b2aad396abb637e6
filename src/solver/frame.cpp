#include "solver/frame.h"

namespace weft {

std::vector<std::string_view> report_names(std::uint32_t reports) {
    std::vector<std::string_view> names;
    if (reports & report_speed_capped) names.push_back("SpeedCapped");
    if (reports & report_non_finite) names.push_back("NonFinite");
    return names;
}

void draw_positions(const ClothFrame& cloth, std::vector<Vec3>& out) {
    const auto& particle = cloth.model->topology.vertex_to_particle;
    out.resize(particle.size());
    for (std::size_t v = 0; v < particle.size(); ++v) {
        out[v] = particle[v] == none ? cloth.model->mesh.positions[v] : cloth.positions[particle[v]].xyz();
    }
}

void draw_normals(const ClothFrame& cloth, std::vector<Vec3>& out) {
    const auto& particle = cloth.model->topology.vertex_to_particle;
    out.resize(particle.size());
    for (std::size_t v = 0; v < particle.size(); ++v) {
        out[v] = particle[v] == none ? Vec3{0, 1, 0} : cloth.normals[particle[v]].xyz();
    }
}

}  // namespace weft
