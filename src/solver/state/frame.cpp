#include "solver/state/frame.h"

#include "physics/scalar.h"

namespace weft {

std::vector<std::string_view> report_names(std::uint32_t reports) {
    std::vector<std::string_view> names;
    if (reports & report_speed_capped) names.push_back("SpeedCapped");
    if (reports & report_non_finite) names.push_back("NonFinite");
    if (reports & report_device_failed) names.push_back("DeviceFailed");
    if (reports & report_contacts_full) names.push_back("ContactsFull");
    return names;
}

void draw_surface(const ClothFrame& cloth, std::vector<Vec3>& positions, std::vector<Vec3>& normals) {
    if (!cloth.model->binding.empty()) {
        follow(cloth.model->binding, cloth.positions, cloth.normals, positions, normals);
        return;
    }
    const auto& particle = cloth.model->vertex_to_particle;
    positions.resize(particle.size());
    normals.resize(particle.size());
    for (std::size_t v = 0; v < particle.size(); ++v) {
        const bool still = particle[v] == none;
        positions[v] = still ? cloth.model->mesh().positions[v] : cloth.positions[particle[v]].xyz();
        normals[v] = still ? Vec3{0, 1, 0} : cloth.normals[particle[v]].xyz();
    }
}

const RenderMesh& ClothFrame::render_mesh() const {
    if (computed_.has_mesh) return computed_.mesh;
    const std::lock_guard lock(computed_.mutex);
    if (computed_.has_mesh) return computed_.mesh;
    const TriangleMesh& mesh = model->mesh();
    RenderMesh& made = computed_.mesh;
    draw_surface(*this, made.positions, made.normals);
    made.triangles = mesh.triangles;
    made.uvs = mesh.uvs;
    made.colors = mesh.colors;
    made.rest_positions = mesh.positions;
    computed_.has_mesh = true;
    return made;
}

std::span<const Vec4> ClothFrame::tangents() const {
    if (computed_.has_tangents) return computed_.tangents;
    const RenderMesh& mesh = render_mesh();
    const std::lock_guard lock(computed_.mutex);
    if (computed_.has_tangents) return computed_.tangents;
    compute_tangents(mesh.triangles, mesh.uvs, mesh.positions, mesh.normals, computed_.tangents);
    computed_.has_tangents = true;
    return computed_.tangents;
}

void compute_tangents(std::span<const Triangle> triangles, std::span<const Vec2> uvs, std::span<const Vec3> positions,
                      std::span<const Vec3> normals, std::vector<Vec4>& tangents) {
    using namespace scalar;
    tangents.clear();
    if (uvs.empty()) return;
    const auto spread = [](Vec3 v) { return scalar::vec3(v.x, v.y, v.z); };
    std::vector<TangentFrame> sums(positions.size(), {scalar::vec3(0.0f), scalar::vec3(0.0f)});
    for (const auto& [a, b, c] : triangles) {
        const Vec2 first = uvs[b] - uvs[a], second = uvs[c] - uvs[a];
        const TangentFrame face = face_tangents(spread(positions[a]), spread(positions[b]), spread(positions[c]),
                                                first.x, first.y, second.x, second.y);
        for (const std::uint32_t v : {a, b, c}) {
            sums[v].tangent = sums[v].tangent + face.tangent;
            sums[v].bitangent = sums[v].bitangent + face.bitangent;
        }
    }
    tangents.resize(positions.size());
    for (std::size_t v = 0; v < sums.size(); ++v) {
        float handedness = 1;
        const scalar::vec3 t = unit_tangent(sums[v], spread(normals[v]), handedness);
        tangents[v] = {t.x, t.y, t.z, handedness};
    }
}

}  // namespace weft
