// Pins that change while cloth moves.

#include "sheet.h"

#include <cmath>

namespace weft::physical {
namespace {

TEST(LivePins, hold_a_particle_where_it_is) {
    World world = make_world({}, hung_upright());
    const ClothId id = world.frame().cloths[0].id;
    run(world, 0.5);
    auto pins = pinned_of(*world.model(id));
    constexpr std::uint32_t lowest = 8 + 16 * 17;
    pins.push_back(lowest);
    const Vec3 before = world.frame().cloths[0].positions[lowest].xyz();
    ASSERT_TRUE(world.set_pins(id, pins, {}).ok());
    run(world, 1);
    EXPECT_EQ(length(world.frame().cloths[0].positions[lowest].xyz() - before), 0);
    EXPECT_EQ(world.frame().cloths[0].positions[lowest].w, 0);
}

TEST(LivePins, let_go_with_the_weight_that_the_particle_had) {
    World world = make_world({}, hung_upright());
    const ClothId id = world.frame().cloths[0].id;
    ASSERT_TRUE(world.set_pins(id, {}, {}).ok());
    const ClothModel& model = *world.model(id);
    for (const std::uint32_t p : pinned_of(model)) EXPECT_EQ(world.frame().cloths[0].positions[p].w, 1 / model.mass[p]);
    run(world, 0.5);
    EXPECT_NEAR(center_of_mass(world.frame().cloths[0]).y, -0.5 * 9.81 * 0.25, 0.05);
}

TEST(LivePins, are_carried_by_keys_from_where_they_are) {
    World world = make_world({}, hung_upright());
    const ClothId id = world.frame().cloths[0].id;
    run(world, 0.25);
    const Vec3 at = world.frame().cloths[0].positions[100].xyz();
    const float now = static_cast<float>(world.time());
    Holds holds{.movers = {{.offsets = {{now, {0, 0, 0}}, {now + 0.5f, {0, 0.3f, 0}}}}}, .particles = {{100, 0, at}}};
    ASSERT_TRUE(world.set_pins(id, {100}, holds).ok());
    run(world, 0.5);
    EXPECT_NEAR(length(world.frame().cloths[0].positions[100].xyz() - (at + Vec3{0, 0.3f, 0})), 0, 1e-6);
    ASSERT_TRUE(world.set_pins(id, {}, {}).ok());
    run(world, 0.25);
    EXPECT_LT(world.frame().cloths[0].positions[100].y, at.y + 0.25f);
}

TEST(LivePins, of_coarse_cloth_stay_where_they_are) {
    World world = make_world({.solver = {.hierarchy = true}}, hung_upright({.lines = true, .hierarchy = true}));
    const ClothId id = world.frame().cloths[0].id;
    ASSERT_FALSE(world.model(id)->hierarchy.empty());
    run(world, 0.25);
    const Vec3 at = world.frame().cloths[0].positions[150].xyz();
    ASSERT_TRUE(world.set_pins(id, {150}, {}).ok());
    run(world, 1);
    EXPECT_EQ(length(world.frame().cloths[0].positions[150].xyz() - at), 0) << "levels that do not know the pin";
    EXPECT_EQ(world.frame().reports & report_non_finite, 0u);
}

TEST(LivePins, are_saved_and_restored) {
    World world = make_world({}, hung_upright());
    const ClothId id = world.frame().cloths[0].id;
    const Holds holds{.movers = {{.offsets = {{0, {0, 0, 0}}, {2, {0, 0.5f, 0}}}}},
                      .particles = {{40, 0, world.frame().cloths[0].positions[40].xyz()}}};
    ASSERT_TRUE(world.set_pins(id, {40}, holds).ok());
    run(world, 0.25);
    const Snapshot saved = world.save();
    const auto bytes = to_bytes(saved);
    run(world, 0.25);
    const std::string hash = world.state_hash();
    ASSERT_TRUE(world.set_pins(id, {1, 2, 3}, {}).ok());
    run(world, 0.1);
    auto read = snapshot_from_bytes(bytes);
    ASSERT_TRUE(read.ok());
    ASSERT_TRUE(world.restore(*read).ok());
    run(world, 0.25);
    EXPECT_EQ(world.state_hash(), hash);
}

TEST(LivePins, of_a_frame_that_is_not_finite_stay) {
    World world = make_world({}, hung_upright());
    const ClothId id = world.frame().cloths[0].id;
    ASSERT_TRUE(world.set_pins(id, {7}, {}).ok());
    run(world, 0.1);
    WorldSettings settings = world.settings();
    const Vec3 gravity = settings.gravity;
    settings.gravity.x = std::nanf("");
    world.configure(settings);
    EXPECT_TRUE(world.step(1.0 / 60).reports & report_non_finite);
    EXPECT_EQ(world.frame().cloths[0].positions[7].w, 0);
    EXPECT_GT(world.frame().cloths[0].positions[0].w, 0);
    settings.gravity = gravity;
    world.configure(settings);
    run(world, 0.2);
    EXPECT_EQ(world.frame().reports & report_non_finite, 0u);
}

}  // namespace
}  // namespace weft::physical
