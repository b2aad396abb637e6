#include "view/overlay_parts.h"

#include <algorithm>
#include <cmath>

namespace weft::overlay {

std::vector<float> ParticleMeans::result() const {
    std::vector<float> means(sums_.size());
    for (std::size_t p = 0; p < means.size(); ++p)
        means[p] = weights_[p] > 0 ? static_cast<float>(sums_[p] / weights_[p]) : 0.0f;
    return means;
}

std::vector<float> at_vertices(const ClothModel& model, std::span<const float> of_particles) {
    std::vector<float> values;
    for (const BoundVertex& vertex : model.binding.vertices) {
        const auto [second, third] = vertex.weights;
        values.push_back(of_particles[vertex.particles[0]] * (1 - second - third) +
                         of_particles[vertex.particles[1]] * second + of_particles[vertex.particles[2]] * third);
    }
    for (const std::uint32_t particle : model.vertex_to_particle)
        values.push_back(particle == none ? 0.0f : of_particles[particle]);
    for (float& value : values)
        if (!std::isfinite(value)) value = 0;
    return values;
}

std::vector<std::uint32_t> first_vertices(const ClothModel& model) {
    std::vector<std::uint32_t> first(model.particle_count, none);
    for (auto v = static_cast<std::uint32_t>(model.vertex_to_particle.size()); v-- > 0;)
        if (model.vertex_to_particle[v] != none) first[model.vertex_to_particle[v]] = v;
    return first;
}

std::vector<Vec3> anchor_places(const WorldFrame& world, const ClothFrame& cloth, double time) {
    const ClothModel& model = *cloth.model;
    std::vector<Vec3> places;
    for (std::uint32_t i = 0; i < model.anchor_count; ++i)
        places.push_back(model.start[model.first_anchor() + i].xyz());
    const KinematicTargets& targets = world.kinematic_targets(cloth.id);
    for (const KinematicTarget& target : targets.particles) {
        if (target.particle < model.first_anchor() || target.particle >= model.point_count()) continue;
        const TargetMotion& motion = targets.motions[target.motion];
        places[target.particle - model.first_anchor()] =
            world.contains(motion.collider) ? to_world(world.collider(motion.collider).pose, target.local)
                                            : target.local + offset_at(motion.offsets, time);
    }
    return places;
}

float pixels(const OverlayInput& input, float size) {
    return size * std::max(1.0f, static_cast<float>(input.height) / 720);
}

void add_line(std::vector<render::Line>& lines, Vec3 from, Vec3 to, Vec4 color, float width) {
    if (finite(from) && finite(to)) lines.push_back({from, to, color, width});
}

void add_point(std::vector<render::Point>& points, Vec3 at, Vec4 color, float size) {
    if (finite(at)) points.push_back({at, color, size});
}

float pixel_size(const OverlayInput& input) {
    return 2 * input.size / static_cast<float>(std::max(1u, input.height));
}

float lift(const OverlayInput& input, const ClothModel& model) {
    return std::min(0.4f * pixel_size(input), 0.05f * model.mean_edge);
}

void add_line_on_surface(std::vector<render::Line>& lines, Vec3 from, Vec3 to, Vec3 from_normal, Vec3 to_normal,
                         float lifted, Vec4 color, float width) {
    for (const float side : {lifted, -lifted})
        add_line(lines, from + from_normal * side, to + to_normal * side, color, width);
}

Bounds bounds_of_cloths(const OverlayInput& input) {
    Bounds bounds;
    for (const ClothFrame& cloth : input.frame.cloths)
        for (const Vec3 p : cloth.render_mesh().positions)
            if (finite(p)) bounds.include(p);
    return bounds;
}

}  // namespace weft::overlay
