// Cloths that are attached to bodies.
#pragma once

#include "body_worlds.h"

#include <functional>
#include <vector>

namespace weft::physical {

struct AttachedPart {
    ColliderId body;
    std::function<bool(Vec3 at_rest)> selects;
    float compliance = 0;  ///< m/N; 0: rigidly
};

/// A sheet of which some particles are attached to colliders. SheetDesc::spring must be empty.
inline ClothId add_attached(World& world, SheetDesc desc, const std::vector<AttachedPart>& parts) {
    const auto part_of = [&](Vec3 p) {
        return std::ranges::find_if(parts, [&](const AttachedPart& part) { return part.selects(p); });
    };
    const auto fixed = desc.pinned;
    desc.pinned = [&](Vec3 p) {
        const auto part = part_of(p);
        return (part != parts.end() && part->compliance == 0) || (fixed && fixed(p));
    };
    desc.spring = [&](Vec3 p) {
        const auto part = part_of(p);
        return part != parts.end() ? part->compliance : 0;
    };
    const auto model = make_sheet(desc);
    KinematicTargets targets;
    for (const AttachedPart& part : parts) targets.motions.push_back({.collider = part.body});
    // The particles of the flat sheet, in the order of its vertices, as in make_sheet().
    const auto flat = make_grid(desc.size, desc.resolution, desc.diagonal).positions;
    std::vector<KinematicTarget> anchors;
    std::uint32_t anchor = model->first_anchor();
    for (std::uint32_t p = 0; p < model->particle_count; ++p) {
        const auto part = part_of(flat[p]);
        if (part == parts.end()) continue;
        const Vec3 local = to_local(world.collider(part->body).pose, model->start[p].xyz());
        const auto motion = static_cast<std::uint32_t>(part - parts.begin());
        if (part->compliance == 0)
            targets.particles.push_back({p, motion, local});
        else
            anchors.push_back({anchor++, motion, local});
    }
    targets.particles.insert(targets.particles.end(), anchors.begin(), anchors.end());
    return world.add(model, targets);
}

/// Like momentum_of(), but pinned particles count in the bodies that have their mass.
inline Momentum momentum_with_attached(const World& world) {
    Momentum all = momentum_of(world);
    for (const ClothFrame& cloth : world.frame().cloths) {
        for (std::uint32_t p = 0; p < cloth.model->particle_count; ++p) {
            const Vec4 x = cloth.positions[p], v = cloth.velocities[p];
            if (!(x.w > 0))
                all.add(-double{cloth.model->mass[p]}, {double{x.x}, double{x.y}, double{x.z}},
                        {double{v.x}, double{v.y}, double{v.z}});
        }
    }
    return all;
}

/// A sheet whose rim is pinned carries a crate by four springs and a ball by its middle; another one, which collides
/// with it by `contact`, lies on both and is pinned to the crate by a corner.
inline void add_bodies_in_nets(World& world, SelfCollision contact = SelfCollision::off, std::uint32_t side = 9) {
    world.add(make_floor());
    const ColliderId crate = world.add(make_box({0.1f, 0.08f, 0.1f}, 2, {0.02f, -0.1f, 0}, {.spin = {0, 50, 0}}));
    const ColliderId ball = world.add(make_ball(0.05f, 0.3f, {0.32f, 0.06f, 0.3f}));
    const ClothLayout layout{.lines = true, .hierarchy = true};
    add_attached(world,
                 {.resolution = {side, side},
                  .fabric = find_fabric("cotton")->fabric,
                  .layout = layout,
                  .self_collision = contact,
                  .pinned = [](Vec3 p) { return std::max(std::abs(p.x), std::abs(p.z)) > 0.49f; }},
                 {{crate, [](Vec3 p) { return std::abs(p.x) < 0.2f && std::abs(p.z) < 0.2f; }, 1e-4f},
                  {ball, [](Vec3 p) { return std::abs(p.x - 0.25f) < 0.05f && std::abs(p.z - 0.25f) < 0.05f; }}});
    add_attached(world,
                 {.size = {0.6f, 0.6f},
                  .resolution = {side, side},
                  .position = {0, 0.2f, 0},
                  .fabric = find_fabric("silk")->fabric,
                  .layout = layout,
                  .self_collision = contact},
                 {{crate, [](Vec3 p) { return p.x < -0.29f && p.z < -0.29f; }}});
}

}  // namespace weft::physical
