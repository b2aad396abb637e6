// Bodies on taut sheets. A ball on a membrane is a case of `weft validate` (src/validate/cases/membrane.cpp).
#include "body_worlds.h"

#include <numbers>

namespace weft::physical {
namespace {

// A square meter whose border moves outward by `strain` of its length within half a second.
ClothId add_stretched(World& world, std::uint32_t side, const Fabric& fabric, float strain) {
    const auto is_border = [](Vec3 p) { return std::max(std::abs(p.x), std::abs(p.z)) > 0.499f; };
    const auto model = make_sheet({.resolution = {side, side},
                                   .fabric = fabric,
                                   .layout = {.lines = true, .hierarchy = true},
                                   .pinned = is_border});
    KinematicTargets targets;
    for (std::uint32_t p = 0; p < model->particle_count; ++p) {
        const Vec3 x = model->start[p].xyz();
        if (!is_border(x)) continue;
        targets.motions.push_back({.offsets = {{0, {}}, {0.5f, {x.x * strain, 0, x.z * strain}}}});
        targets.particles.push_back({p, static_cast<std::uint32_t>(targets.motions.size() - 1), x});
    }
    return world.add(model, targets);
}

Fabric elastic(float stiffness, float friction = 0.4f) {
    Fabric fabric;
    fabric.body = {.density = 0.1f, .damping = 1};
    fabric.stretch = {.stretch = {stiffness, stiffness}, .compression = {stiffness, stiffness}, .shear = stiffness / 3};
    fabric.bend = {};
    fabric.contact.friction[0] = fabric.contact.friction[1] = friction;
    return fabric;
}

// How far a block slides in a second on a taut sheet, with gravity along the slope.
double slides(float degrees, float friction) {
    const float angle = degrees * std::numbers::pi_v<float> / 180;
    World world = make_world({.gravity = {0, -9.81f, 0}, .solver = {.substeps = 20}});
    add_stretched(world, 33, elastic(4000, friction), 0.02f);
    run(world, 1);
    Collider block = make_box({0.08f, 0.03f, 0.08f}, 0.1f, {0, 0.033f, 0});
    block.friction = {friction, friction};
    const ColliderId id = world.add(std::move(block));
    run(world, 1);
    WorldSettings tilted = world.settings();
    tilted.gravity = {9.81f * std::sin(angle), -9.81f * std::cos(angle), 0};
    world.configure(tilted);
    run(world, 0.5);  // the sheet takes its new shape
    const float before = world.body(id).state.place.x;
    run(world, 1);
    return double{world.body(id).state.place.x - before};
}

TEST(BodiesOnSheets, a_block_holds_on_a_slope_while_friction_does) {
    const float friction = 0.4f, limit = std::atan(friction) * 180 / std::numbers::pi_v<float>;
    const double holds = slides(limit - 1, friction), goes = slides(limit + 1, friction);
    EXPECT_LT(holds, 2e-3);  // creeps
    EXPECT_GT(goes, 0.02);
}

}  // namespace
}  // namespace weft::physical
