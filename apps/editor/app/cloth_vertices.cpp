#include "editor/app/cloth_vertices.h"

namespace weft::editor {

VertexSet ClothVertices::to_vertices(const VertexSet& all) const {
    std::vector<std::uint32_t> vertices;
    for (const std::uint32_t particle : all)
        if (particle < vertex_of.size() && vertex_of[particle] != none) vertices.push_back(vertex_of[particle]);
    return make_set(std::move(vertices));
}

VertexSet ClothVertices::to_particles(const VertexSet& vertices) const {
    std::vector<std::uint32_t> all;
    for (const std::uint32_t vertex : vertices)
        if (vertex < numbers->of_welded.size() && numbers->of_welded[vertex] != none)
            all.push_back(numbers->of_welded[vertex]);
    return make_set(std::move(all));
}

ClothVertices vertices_of(const Picture& picture, std::size_t cloth) {
    const ClothFrame& frame = picture.world->frame().cloths[cloth];
    const ClothModel& model = *frame.model;
    ClothVertices all{.numbers = picture.numbers[cloth], .vertex_of = {}, .rest = {}, .triangles = {}};
    const std::uint32_t count = all.numbers->particle_count;
    all.vertex_of.assign(count, none);
    for (std::uint32_t v = 0; v < all.numbers->of_welded.size(); ++v)
        if (const std::uint32_t p = all.numbers->of_welded[v]; p < count) all.vertex_of[p] = v;
    const TransformDesc& transform = picture.scene->cloths[cloth].transform;
    const Pose start{rotation_from_degrees(transform.rotation_degrees), transform.position};
    for (std::uint32_t p = 0; p < count; ++p) all.rest.push_back(to_local(start, model.rest_position(p)));
    for (Triangle t : frame.triangles) {
        for (std::uint32_t& corner : t) corner = original_of(frame, *all.numbers, corner);
        all.triangles.push_back(t);
    }
    return all;
}

std::uint32_t original_of(const ClothFrame& frame, const ParticleNumbers& numbers, std::uint32_t particle) {
    if (particle < numbers.particle_count) return particle;
    const auto& copied_from = frame.model->copied_from;
    const std::uint32_t copy = particle - numbers.particle_count;
    // A copy may have been made from a copy.
    return copy < copied_from.size() ? original_of(frame, numbers, copied_from[copy]) : none;
}

std::optional<std::size_t> cloth_called(const Picture& picture, const std::string& name) {
    for (std::size_t i = 0; i < picture.world->cloth_count(); ++i)
        if (picture.world->model(i)->name == name) return i;
    return {};
}

}  // namespace weft::editor
