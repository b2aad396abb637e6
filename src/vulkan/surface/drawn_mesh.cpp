#include "vulkan/surface/drawn_mesh.h"

#include <cassert>
#include <vector>

namespace weft::vulkan {
namespace {

// Arrays that the arena reads when it is built.
struct Lists {
    std::vector<std::uint32_t> offsets, items, particles;
    std::vector<Vec4> shape;
};

// A triangle with the same vertex twice is twice in the vertex's list, because compute_tangents() adds it twice.
void list_around(const TriangleMesh& mesh, Lists& lists) {
    lists.offsets.assign(mesh.positions.size() + 1, 0);
    for (const Triangle& triangle : mesh.triangles)
        for (const std::uint32_t v : triangle) ++lists.offsets[v + 1];
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) lists.offsets[v + 1] += lists.offsets[v];
    lists.items.resize(3 * mesh.triangles.size());
    std::vector<std::uint32_t> next(lists.offsets.begin(), lists.offsets.end() - 1);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const std::uint32_t v : mesh.triangles[t]) lists.items[next[v]++] = static_cast<std::uint32_t>(t);
}

void list_bound(const Binding& binding, Lists& lists) {
    for (const BoundVertex& vertex : binding.vertices) {
        lists.particles.insert(lists.particles.end(), vertex.particles.begin(), vertex.particles.end());
        lists.shape.push_back({vertex.weights[0], vertex.weights[1], vertex.offset.x, vertex.offset.y});
        lists.shape.push_back({vertex.offset.z, vertex.normal.x, vertex.normal.y, vertex.normal.z});
    }
}

}  // namespace

gpu::BufferRange range_of(const Arena& arena, Slot slot) {
    if (slot.bytes == 0) return {};
    return {arena.buffer().handle(), slot.offset, slot.bytes, arena.address(slot)};
}

Result<std::shared_ptr<const DrawnMesh>> DrawnMesh::create(gpu::Device& device,
                                                           std::shared_ptr<const ClothModel> cloth_model) {
    auto self = std::shared_ptr<DrawnMesh>(new DrawnMesh(std::move(cloth_model)));
    const ClothModel& model = *self->model;
    const TriangleMesh& mesh = model.mesh();
    assert(mesh.uvs.empty() || mesh.uvs.size() == mesh.positions.size());
    Arena& arena = self->arena_;
    Lists lists;
    self->triangles = arena.add_array(mesh.triangles);
    if (!mesh.uvs.empty()) {
        list_around(mesh, lists);
        self->uvs = arena.add_array(mesh.uvs);
        self->around_offsets = arena.add_array(lists.offsets);
        self->around_items = arena.add_array(lists.items);
    }
    if (model.binding.empty()) {
        self->particle = arena.add_array(model.vertex_to_particle);
    } else {
        list_bound(model.binding, lists);
        self->bound_particles = arena.add_array(lists.particles);
        self->bound_shape = arena.add_array(lists.shape);
    }
    if (auto built = arena.build(device, "drawn mesh of " + model.name, drawn_usage); !built) return built.errors();
    return std::shared_ptr<const DrawnMesh>(std::move(self));
}

}  // namespace weft::vulkan
