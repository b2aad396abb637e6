// Bodies that feel the cloth.
#include "body_worlds.h"

namespace weft::physical {
namespace {

SheetDesc pinned_sheet(std::uint32_t side) {
    return {.resolution = {side, side},
            .fabric = find_fabric("cotton")->fabric,
            .layout = {.lines = true, .hierarchy = true},
            .pinned = [](Vec3 p) { return std::max(std::abs(p.x), std::abs(p.z)) > 0.499f; }};
}

// Of a sheet and a ball that meet in free space. Errors in parts of the linear momentum that the heavier one had at
// first, for angular momentum at a distance of 1 m.
struct Meeting {
    double linear = 0, angular = 0;  ///< the largest errors
    double energy = 0;               ///< the largest, in parts of that at the start
    double energy_left = 0;
};

Meeting meet(Fabric fabric, float mass, bool spins, std::uint32_t substeps, int frames) {
    World world = make_world({.gravity = {}, .solver = {.substeps = substeps}, .contact_forces = spins});
    world.add(make_sheet({.resolution = {17, 17},
                          .rotation_degrees = {20, 0, 10},
                          .velocity = {0, -1, 0.3f},
                          .fabric = fabric,
                          .layout = {.lines = true, .hierarchy = true}}));
    world.add(make_ball(0.2f, mass, {0.05f, -0.4f, 0.1f},
                        {.velocity = {0.1f, 0.5f, 0}, .spin = {0, spins ? 400.0f : 0, 90}}));
    world.frame();
    const Momentum start = momentum_of(world);
    const double heavier = std::max(double{fabric.body.density} * 1.05, double{mass} * 0.5);
    Meeting meeting;
    for (int frame = 0; frame < frames; ++frame) {
        world.step(1.0 / 60);
        const Momentum now = momentum_of(world);
        meeting.linear = std::max(meeting.linear, distance_between(now.linear, start.linear) / heavier);
        meeting.angular = std::max(meeting.angular, distance_between(now.angular, start.angular) / heavier);
        meeting.energy = std::max(meeting.energy, now.energy / start.energy);
        meeting.energy_left = now.energy / start.energy;
    }
    return meeting;
}

void expect_momentum(const Fabric& fabric, double linear, double angular, double energy) {
    for (const float mass : {0.01f, 1.0f, 100.0f}) {
        for (const bool spins : {false, true}) {
            const Meeting meeting = meet(fabric, mass, spins, 4, 60);
            EXPECT_LT(meeting.linear, linear) << mass << ' ' << spins;
            EXPECT_LT(meeting.angular, angular) << mass << ' ' << spins;
            EXPECT_LT(meeting.energy, energy) << mass << ' ' << spins;
        }
    }
}

// Contact alone: particles without constraints, with long substeps.
TEST(ClothAndBody, exchange_momentum_and_lose_none) {
    Fabric loose = find_fabric("cotton")->fabric;
    loose.stretch = {.stretch = {0, 0}, .compression = {0, 0}, .shear = 0};
    loose.bend = {};
    expect_momentum(loose, 1e-4, 5e-4, 1.001);
}

// Taut edges add masses that differ by particle (taut.md).
TEST(ClothAndBody, keep_most_of_their_momentum_where_the_cloth_is_taut) {
    Fabric soft = find_fabric("cotton")->fabric;
    soft.stretch = {.stretch = {0.05f, 0.05f}, .compression = {0.05f, 0.05f}, .shear = 0.05f};
    soft.bend = {};
    expect_momentum(soft, 1.5e-3, 2e-3, 1.01);
}

TEST(ClothAndBody, lose_energy_when_they_meet) {
    for (const float mass : {0.01f, 1.0f, 100.0f}) {
        const Meeting meeting = meet(find_fabric("cotton")->fabric, mass, true, 20, 120);
        EXPECT_LT(meeting.energy, 1.001) << mass;
        EXPECT_LT(meeting.energy_left, 1) << mass;
    }
}

// A ball of 0.1 m on a square meter that is pinned along its border: at rest, over a second.
struct Resting {
    double force = 0;   ///< N, mean
    double speed = 0;   ///< m/s, the largest
    double height = 0;  ///< m, of the ball's center
};

Resting rest_on_sheet(std::uint32_t side, float mass, std::uint32_t substeps, double seconds) {
    World world = make_world({.solver = {.substeps = substeps}, .air = AirDesc{}, .contact_forces = true});
    world.add(make_sheet(pinned_sheet(side)));
    const ColliderId ball = world.add(make_ball(0.1f, mass, {0.03f, 0.12f, 0.02f}, {.damping = 3}));
    run(world, seconds - 1);
    Resting resting;
    for (int frame = 0; frame < 60; ++frame) {
        world.step(1.0 / 60);
        world.summary();
        resting.force += double{world.contact_forces().colliders.front().force.y} / 60;
        resting.speed = std::max(resting.speed, double{speed_of(world.body(ball))});
    }
    resting.height = double{world.body(ball).state.place.y};
    return resting;
}

// Labels: slow no-asan
TEST(ClothAndBody, a_sheet_bears_a_ball) {
    for (const float mass : {0.001f, 0.1f, 1.0f, 10.0f}) {
        const Resting resting = rest_on_sheet(33, mass, 20, 6);
        EXPECT_NEAR(resting.force / (double{mass} * 9.81), 1, 0.01) << mass;
        EXPECT_LT(resting.speed, 2e-2) << mass;
    }
}

// Its triangles bear what lies between their corners: balls of a third of an edge, and corners of boxes.
TEST(ClothAndBody, small_bodies_do_not_pass_between_the_particles) {
    World world = make_world({.solver = {.substeps = 20}});
    world.add(make_sheet(pinned_sheet(17)));
    std::vector<ColliderId> bodies;
    for (int i = 0; i < 4; ++i) {
        const float at = -0.3f + 0.18f * static_cast<float>(i);
        bodies.push_back(world.add(make_ball(0.02f, 0.02f, {at, 0.05f, 0.11f})));
        bodies.push_back(world.add(make_box({0.02f, 0.02f, 0.02f}, 0.02f, {at, 0.08f, -0.12f})));
    }
    run(world, 2);
    for (const ColliderId body : bodies) {
        const float height = world.body(body).state.place.y;
        EXPECT_GT(height, -0.03f);
        EXPECT_LT(height, 0.05f);
    }
}

// Heights that 240 substeps give: see taut.md.
// Labels: slow no-asan
TEST(ClothAndBody, a_sheet_sags_alike_under_a_ball_however_long_the_substeps_are) {
    for (const std::uint32_t substeps : {5u, 10u, 20u, 40u}) {
        EXPECT_NEAR(rest_on_sheet(33, 1, substeps, 4).height, 0.0061, 0.002) << substeps;
        EXPECT_NEAR(rest_on_sheet(33, 10, substeps, 4).height, -0.0946, 0.004) << substeps;
    }
}

// s, until the lower end of a meter of cotton has passed below the edge that holds it for the second time. It falls
// from the horizontal.
double second_passage(bool with_body) {
    World world = make_world({.solver = {.substeps = 5}});
    world.add(make_sheet({.resolution = {33, 33}, .layout = {.lines = true, .hierarchy = true}, .pinned = [](Vec3 p) {
                              return p.z < -0.49f;
                          }}));
    if (with_body) world.add(make_ball(0.1f, 1, {70, 0, 0}));
    world.frame();
    int passages = 0;
    float before = 0.5f;
    for (int frame = 1; frame <= 180; ++frame) {
        world.step(1.0 / 60);
        const ClothFrame& cloth = world.frame().cloths[0];
        const float now = cloth.positions[cloth.model->particle_count - 1].z + 0.5f;
        if (before * now < 0 && ++passages == 2) return frame / 60.0;
        before = now;
    }
    return 0;
}

// The mass of taut edges holds cloth back that is accelerated. Tension must not be overestimated.
TEST(ClothAndBody, a_body_far_away_hardly_slows_a_sheet_that_swings) {
    const double alone = second_passage(false), beside = second_passage(true);
    EXPECT_NEAR(alone, 1.4, 0.03);
    EXPECT_NEAR(beside, alone, 0.04);
}

// m: how deep a sheet of rubber that is pinned along its border bulges in the wind.
double bulge(bool with_body) {
    World world =
        make_world({.gravity = {}, .solver = {.substeps = 10}, .air = AirDesc{.wind = {{.velocity = {0, 10, 0}}}}});
    SheetDesc sheet = pinned_sheet(33);
    sheet.fabric = find_fabric("rubber")->fabric;
    world.add(make_sheet(sheet));
    if (with_body) world.add(make_ball(0.1f, 1, {70, 0, 0}));
    run(world, 3);
    return double{world.frame().cloths[0].positions[16 * 33 + 16].y};
}

// The air pushes cloth itself, and not also the mass of taut edges.
TEST(ClothAndBody, a_body_far_away_does_not_change_how_the_wind_fills_a_sheet) {
    const double alone = bulge(false);
    EXPECT_GT(alone, 0.05);
    EXPECT_NEAR(bulge(true) / alone, 1, 0.02);
}

// Labels: slow no-asan
TEST(ClothAndBody, a_fine_sheet_bears_as_much) {
    EXPECT_NEAR(rest_on_sheet(65, 10, 20, 4).height, -0.0936, 0.004);
}

TEST(ClothAndBody, a_fast_ball_does_not_pass_a_curtain) {
    World world = make_world(WorldSettings{});
    world.add(make_sheet({.resolution = {33, 33},
                          .rotation_degrees = {90, 0, 0},
                          .fabric = find_fabric("cotton")->fabric,
                          .layout = {.lines = true, .hierarchy = true},
                          .pinned = [](Vec3 p) { return p.z < -0.499f; }}));
    const ColliderId ball = world.add(make_ball(0.1f, 0.5f, {0, 0, -1.03f}, {.velocity = {0, 0.5f, 60}}));
    int met = 0;
    for (int frame = 0; frame < 100; ++frame) {
        world.step(1.0 / 1200);
        const Vec3 at = world.body(ball).state.place.xyz();
        if (at.z < 0) continue;
        if (at.z > 0.4f) break;
        ++met;
        for (const Vec4& x : world.frame().cloths[0].positions) {
            if (std::hypot(x.x - at.x, x.y - at.y) > 0.05f) continue;
            EXPECT_GT(x.z, at.z) << frame;
        }
    }
    EXPECT_GT(met, 5);
    EXPECT_LT(world.body(ball).state.velocity.z, 59.5f);
}

// Labels: slow no-asan long
TEST(ClothAndBody, the_same_bits_on_any_number_of_threads_and_after_a_restore) {
    std::string hash;
    for (const unsigned workers : {0u, 1u, 3u}) {
        World world = make_world(WorldSettings{}, CpuOptions{.workers = workers});
        world.add(make_sheet(pinned_sheet(33)));
        for (int i = 0; i < 8; ++i)
            world.add(make_ball(0.05f, 0.05f * static_cast<float>(i + 1),
                                {0.12f * static_cast<float>(i % 3) - 0.12f, 0.2f + 0.03f * static_cast<float>(i),
                                 0.12f * static_cast<float>(i / 3) - 0.12f}));
        world.add(make_box({0.06f, 0.04f, 0.05f}, 0.3f, {0.2f, 0.3f, 0.2f}));
        run(world, 0.75);
        const Snapshot middle = world.save();
        run(world, 0.75);
        const std::string end = world.state_hash();
        if (hash.empty()) hash = end;
        EXPECT_EQ(end, hash) << workers;
        ASSERT_TRUE(world.restore(*snapshot_from_bytes(to_bytes(middle))).ok());
        run(world, 0.75);
        EXPECT_EQ(world.state_hash(), hash) << workers;
    }
}

// Taut edges make the particles heavier only while there are bodies.
TEST(ClothAndBody, cloth_whose_bodies_are_gone_goes_on_as_if_there_had_been_none) {
    World world = make_world(WorldSettings{}), without = make_world(WorldSettings{});
    world.add(make_sheet(pinned_sheet(33)));
    without.add(make_sheet(pinned_sheet(33)));
    const ColliderId ball = world.add(make_ball(0.1f, 5, {0, 0.12f, 0}));
    run(world, 0.5), run(without, 0.05);
    world.remove(ball);
    ASSERT_TRUE(without.restore(world.save()).ok());
    run(world, 0.25), run(without, 0.25);
    EXPECT_EQ(world.state_hash(), without.state_hash());
}

TEST(ClothAndBody, a_body_without_reaction_does_not_feel_the_cloth) {
    World world = make_world(WorldSettings{});
    world.add(make_sheet(pinned_sheet(17)));
    const ColliderId ball = world.add(make_ball(0.1f, 0.001f, {0, 0.2f, 0}, {.reaction = false}));
    run(world, 0.25);
    EXPECT_NEAR(world.body(ball).state.velocity.y, -9.81 * 0.25, 1e-3);
}

TEST(ClothAndBody, a_stray_snapshot_is_refused) {
    World world = make_world(WorldSettings{});
    world.add(make_ball(0.1f, 1, {}));
    Snapshot snapshot = world.save();
    snapshot.bodies.clear();
    const auto restored = world.restore(snapshot);
    ASSERT_FALSE(restored.ok());
    EXPECT_NE(restored.error().message().find("bodies"), std::string::npos) << restored.error().message();
}

}  // namespace
}  // namespace weft::physical
