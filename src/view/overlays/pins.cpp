#include "view/overlay_parts.h"

#include <string>

namespace weft::overlay {
namespace {

constexpr Vec4 in_place{1.0f, 0.72f, 0.1f, 1}, on_collider{0.15f, 0.8f, 1.0f, 1};

// Marks the particles and anchors that a collider moves.
std::vector<std::uint8_t> attached_particles(const WorldFrame& world, const ClothFrame& cloth) {
    std::vector<std::uint8_t> by_collider(cloth.model->point_count());
    const KinematicTargets& targets = world.kinematic_targets(cloth.id);
    for (const KinematicTarget& target : targets.particles)
        if (target.particle < by_collider.size())
            by_collider[target.particle] = world.contains(targets.motions[target.motion].collider);
    return by_collider;
}

}  // namespace

void pins(const OverlayInput& input, OverlayOutput& output) {
    const float size = pixels(input, 8);
    std::size_t pinned[2] = {}, sprung = 0;
    for (const ClothFrame& cloth : input.frame.cloths) {
        const ClothModel& model = *cloth.model;
        const std::vector<std::uint8_t> by_collider = attached_particles(input.world, cloth);
        const auto color = [&](std::uint32_t point) { return by_collider[point] ? on_collider : in_place; };
        for (std::uint32_t p = 0; p < cloth.positions.size(); ++p) {
            if (cloth.positions[p].w > 0) continue;
            add_point(output.points, cloth.positions[p].xyz(), color(p), size);
            ++pinned[by_collider[p]];
        }
        // A spring: a small point at its anchor, and a line to the particle.
        const ConstraintTable& springs = model.table(ConstraintKind::attachment);
        const std::vector<Vec3> anchors = anchor_places(input.world, cloth, input.frame.time);
        for (std::uint32_t row = 0; row < springs.stride; ++row) {
            if (!springs.is_real(row)) continue;
            const std::uint32_t particle = springs.particles[row], anchor = springs.particles[springs.stride + row];
            const Vec3 at = cloth.positions[particle].xyz(), place = anchors[anchor - model.first_anchor()];
            add_point(output.points, at, color(anchor), size);
            add_point(output.points, place, color(anchor), size / 2);
            add_line(output.lines_on_top, at, place, color(anchor), pixels(input, 1.5f));
            ++sprung;
        }
    }
    Legend legend{.title = "pins"};
    if (pinned[0] > 0 || pinned[1] + sprung == 0)
        legend.entries.push_back({in_place, "pinned: " + std::to_string(pinned[0])});
    if (pinned[1] > 0) legend.entries.push_back({on_collider, "pinned to colliders: " + std::to_string(pinned[1])});
    if (sprung > 0) legend.entries.push_back({{}, "held by springs: " + std::to_string(sprung)});
    output.legends.push_back(std::move(legend));
}

}  // namespace weft::overlay
