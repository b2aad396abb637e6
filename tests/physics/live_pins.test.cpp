// Pins that change while cloth moves.

#include "sheet.h"

#include <cmath>

namespace weft::physical {
namespace {

TEST(LivePins, hold_a_particle_where_it_is) {
    World world = make_world({}, hung_upright());
    const ClothId id = world.frame().cloths[0].id;
    run(world, 0.5);
    auto pins = pinned_particles(*world.model(id));
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
    for (const std::uint32_t p : pinned_particles(model))
        EXPECT_EQ(world.frame().cloths[0].positions[p].w, 1 / model.mass[p]);
    run(world, 0.5);
    EXPECT_NEAR(center_of_mass(world.frame().cloths[0]).y, -0.5 * 9.81 * 0.25, 0.05);
}

// Particles are heavier near a pin, so that it bears its load. Without the pin they fall as the rest does.
TEST(LivePins, let_go_what_hung_by_a_point) {
    SheetDesc sheet = hung_by_corners(33, {.lines = true, .hierarchy = true});
    sheet.fabric.tether.use = Tethers::off;
    World world = make_world({}, sheet);
    const ClothId id = world.frame().cloths[0].id;
    ASSERT_TRUE(world.model(id)->has_pin_loads());
    run(world, 1);
    ASSERT_TRUE(world.set_pins(id, {}, {}).ok());
    const ClothFrame& cloth = world.frame().cloths[0];
    for (std::uint32_t p = 0; p < cloth.model->particle_count; ++p)
        EXPECT_EQ(cloth.positions[p].w, 1 / cloth.model->mass[p]);
    double before = 0, mass = 0;
    for (std::uint32_t p = 0; p < cloth.model->particle_count; ++p)
        before += double{cloth.model->mass[p]} * double{cloth.velocities[p].y}, mass += double{cloth.model->mass[p]};
    run(world, 0.1);
    double after = 0;
    const ClothFrame& fallen = world.frame().cloths[0];
    for (std::uint32_t p = 0; p < fallen.model->particle_count; ++p)
        after += double{fallen.model->mass[p]} * double{fallen.velocities[p].y};
    EXPECT_NEAR((after - before) / mass, -9.81 * 0.1, 1e-3);
}

TEST(LivePins, are_carried_by_keys_from_where_they_are) {
    World world = make_world({}, hung_upright());
    const ClothId id = world.frame().cloths[0].id;
    run(world, 0.25);
    const Vec3 at = world.frame().cloths[0].positions[100].xyz();
    const float now = static_cast<float>(world.time());
    KinematicTargets targets{.motions = {{.offsets = {{now, {0, 0, 0}}, {now + 0.5f, {0, 0.3f, 0}}}}},
                             .particles = {{100, 0, at}}};
    ASSERT_TRUE(world.set_pins(id, {100}, targets).ok());
    run(world, 0.5);
    EXPECT_NEAR(length(world.frame().cloths[0].positions[100].xyz() - (at + Vec3{0, 0.3f, 0})), 0, 1e-6);
    ASSERT_TRUE(world.set_pins(id, {}, {}).ok());
    run(world, 0.25);
    EXPECT_LT(world.frame().cloths[0].positions[100].y, at.y + 0.25f);
}

// Labels on Vulkan: long
TEST(LivePins, that_give_way_come_and_go_with_the_rows_that_there_are) {
    World world = make_world({.solver = {.substeps = 20}}, hung_upright({.lines = true}));
    const ClothId id = world.frame().cloths[0].id;
    run(world, 0.25);
    const auto before = world.model(id);
    constexpr float compliance = 0.05f;
    const Vec3 at = world.frame().cloths[0].positions[150].xyz();
    const auto held = world.set_pins(id, {}, {}, {{150, compliance, at}});
    ASSERT_TRUE(held.ok() && *held);
    EXPECT_TRUE(world.model(id)
                    ->table(ConstraintKind::stretch)
                    .particles.shares(before->table(ConstraintKind::stretch).particles))
        << "nothing is built anew";
    // It hangs by that spring alone, and swings: 0.53 s up and down.
    const auto mean_height = [&] {
        run(world, 0.5);
        double sum = 0;
        for (int i = 0; i < 159; ++i) sum += world.step(1.0 / 60).cloths[0].positions[150].y;
        return sum / 159;
    };
    double mass = 0;
    for (const float one : world.model(id)->mass) mass += one;
    const double sag = compliance * mass * 9.81;
    EXPECT_NEAR(at.y - mean_height(), sag, 0.25 * sag);
    const auto moved = world.set_pins(id, {}, {}, {{150, compliance, at + Vec3{0, 1, 0}}});
    ASSERT_TRUE(moved.ok() && *moved);
    EXPECT_NEAR(mean_height(), at.y + 1 - sag, 0.25 * sag);
    const auto none = world.set_pins(id, {}, {}, std::vector<Attachment>{});
    ASSERT_TRUE(none.ok() && *none);
    run(world, 0.75);
    EXPECT_LT(world.frame().cloths[0].positions[150].y, at.y - 1);
    EXPECT_EQ(world.frame().reports & report_non_finite, 0u);
}

TEST(LivePins, that_give_way_are_refused_where_there_is_no_room_or_no_sense_in_them) {
    World world = make_world({.solver = {.substeps = 5}}, hung_upright());
    const ClothId id = world.frame().cloths[0].id;
    run(world, 0.1);
    const std::string before = world.state_hash();
    std::vector<Attachment> many;
    for (std::uint32_t p = 0; p < 200; ++p) many.push_back({p, 0.1f, {}});
    const auto held = world.set_pins(id, {}, {}, many);
    ASSERT_TRUE(held.ok());
    EXPECT_FALSE(*held);
    EXPECT_FALSE(world.set_pins(id, {}, {}, {{100'000, 0.1f, {}}}).ok());
    EXPECT_FALSE(world.set_pins(id, {}, {}, {{5, 0, {}}}).ok());
    EXPECT_EQ(world.state_hash(), before);
}

TEST(LivePins, that_give_way_are_saved_and_restored) {
    const auto begin = [] { return make_world({.solver = {.substeps = 10}}, hung_upright({.lines = true})); };
    const auto hold = [](World& world) {
        const auto held =
            world.set_pins(world.cloth_id(0), {3}, {}, {{150, 0.01f, {0.1f, -0.2f, 0.05f}}, {9, 0.1f, {}}});
        EXPECT_TRUE(held.ok() && *held);
    };
    World world = begin();
    run(world, 0.2);
    hold(world);
    run(world, 0.2);
    const Snapshot snapshot = world.save();
    run(world, 0.2);
    World other = begin();
    hold(other);
    ASSERT_TRUE(other.restore(snapshot).ok());
    run(other, 0.2);
    EXPECT_EQ(other.state_hash(), world.state_hash());
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
    const KinematicTargets targets{.motions = {{.offsets = {{0, {0, 0, 0}}, {2, {0, 0.5f, 0}}}}},
                                   .particles = {{40, 0, world.frame().cloths[0].positions[40].xyz()}}};
    ASSERT_TRUE(world.set_pins(id, {40}, targets).ok());
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
