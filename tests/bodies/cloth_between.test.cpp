// Cloth between a body and a collider: the collider bears the body.
#include "body_worlds.h"

#include <algorithm>
#include <numbers>

namespace weft::physical {
namespace {

constexpr float friction = 0.5f;

Collider make_table(const Vec3& position = {}, const Vec3& rotation_degrees = {}) {
    Collider table = make_collider({.name = "table", .shape = BoxDesc{.half_extents = {1, 0.05f, 1}}});
    table.pose = {rotation_from_degrees(rotation_degrees), position};
    table.friction = {friction, friction};
    return table;
}

Fabric rubbed_cotton() {
    Fabric fabric;
    fabric.contact.friction[0] = fabric.contact.friction[1] = friction;
    return fabric;
}

float thickness() {
    return rubbed_cotton().contact.thickness;
}

// A square meter that lies on a table whose top is at y = 0.
std::shared_ptr<const ClothModel> table_cloth(std::uint32_t side, const std::function<bool(Vec3)>& pinned = {}) {
    return make_sheet({.resolution = {side, side},
                       .position = {0, 0.5f * thickness(), 0},
                       .fabric = rubbed_cotton(),
                       .layout = {.lines = true, .hierarchy = true},
                       .pinned = pinned});
}

// Where a body with this lower half lies on the cloth.
float resting_height(float half) {
    return half + thickness();
}

Collider rubbed(Collider body) {
    body.friction = {friction, friction};
    return body;
}

struct Rest {
    float height = 0;  ///< m, above the place where the body should lie
    float way = 0;     ///< m, in a second
    float speed = 0;   ///< m/s, the largest in a second
    double force = 0;  ///< N, of the table, mean
};

Rest rest_of(Collider body, float half, std::uint32_t side, std::uint32_t substeps, double seconds = 2) {
    World world = make_world({.solver = {.substeps = substeps}, .contact_forces = true});
    world.add(table_cloth(side));
    world.add(make_table({0, -0.05f, 0}));
    const ColliderId id = world.add(rubbed(std::move(body)));
    run(world, seconds - 1);
    const Vec4 before = world.body(id).state.place;
    Rest rest;
    for (int frame = 0; frame < 60; ++frame) {
        world.step(1.0 / 60);
        world.summary();
        rest.force -= double{world.contact_forces().colliders.front().force.y} / 60;
        rest.speed = std::max(rest.speed, speed_of(world.body(id)));
    }
    const Vec4 after = world.body(id).state.place;
    rest.way = std::hypot(after.x - before.x, after.z - before.z);
    rest.height = after.y - resting_height(half);
    return rest;
}

TEST(ClothBetween, bears_boxes_of_any_mass) {
    const double cloth = 0.14 * 9.81;
    for (const float mass : {0.01f, 0.3f, 10.0f, 300.0f}) {
        const Rest rest =
            rest_of(make_box({0.1f, 0.1f, 0.1f}, mass, {0.02f, resting_height(0.1f), 0.01f}), 0.1f, 21, 20);
        EXPECT_NEAR(rest.height, 0, 0.02f * thickness()) << mass;
        EXPECT_LT(rest.way, 5e-4f) << mass;
        EXPECT_LT(rest.speed, 2e-3f) << mass;
        EXPECT_NEAR(rest.force / (double{mass} * 9.81 + cloth), 1, 0.02) << mass;
    }
}

TEST(ClothBetween, bears_alike_in_substeps_of_any_length) {
    for (const std::uint32_t substeps : {5u, 10u, 40u}) {
        const Rest rest =
            rest_of(make_box({0.1f, 0.1f, 0.1f}, 0.3f, {0.02f, resting_height(0.1f), 0.01f}), 0.1f, 21, substeps);
        EXPECT_NEAR(rest.height, 0, 0.05f * thickness()) << substeps;
        EXPECT_LT(rest.way, 2e-3f) << substeps;
        EXPECT_LT(rest.speed, 1e-2f) << substeps;
    }
}

// It begins in the cloth by half of its thickness.
TEST(ClothBetween, does_not_throw_a_body_that_begins_in_it) {
    World world = make_world({.solver = {.substeps = 20}});
    world.add(table_cloth(21));
    world.add(make_table({0, -0.05f, 0}));
    const ColliderId id = world.add(rubbed(make_box({0.1f, 0.1f, 0.1f}, 0.3f, {0, 0.1f + 0.5f * thickness(), 0})));
    float highest = 0;
    for (int frame = 0; frame < 60; ++frame) {
        world.step(1.0 / 60);
        highest = std::max(highest, world.body(id).state.place.y);
    }
    EXPECT_LT(highest, resting_height(0.1f) + 2e-3f);
    EXPECT_NEAR(world.body(id).state.place.y, resting_height(0.1f), 0.02f * thickness());
}

struct Landing {
    double gained = 0;  ///< the largest rise of its energy above the least before, in parts of that of the fall
    Body end;
    float way = 0;  ///< m, the largest of a particle from where it lay
};

// A box falls on the cloth by 30 cm, turned by these angles. `side`: of the cloth, in particles.
Landing land(Vec3 degrees, std::uint32_t substeps, std::uint32_t side, float kinetic_friction = friction) {
    constexpr double gravity = 9.81;
    constexpr float fall = 0.3f, mass = 6, lowest = 0.2f;
    World world = make_world({.solver = {.substeps = substeps}});
    const auto cloth = table_cloth(side);
    world.add(cloth);
    Collider table = make_table({0, -0.05f, 0});
    table.friction[1] = kinetic_friction;
    world.add(std::move(table));
    Collider box = rubbed(make_box({0.15f, 0.1f, 0.1f}, mass, {0, lowest + fall, -0.1f}));
    box.pose.rotation = rotation_from_degrees(degrees);
    const ColliderId id = world.add(std::move(box));
    Landing landing;
    double least = mass * gravity * double{lowest + fall};
    for (int frame = 0; frame < 120; ++frame) {
        world.step(1.0 / 60);
        const Body& body = world.body(id);
        const double energy = kinetic_energy(body.state, body.mass) + mass * gravity * double{body.state.place.y};
        landing.gained = std::max(landing.gained, (energy - least) / (mass * gravity * double{fall}));
        least = std::min(least, energy);
    }
    landing.end = world.body(id);
    for (std::uint32_t p = 0; p < cloth->particle_count; ++p)
        landing.way =
            std::max(landing.way, length(world.frame().cloths.front().positions[p].xyz() - cloth->start[p].xyz()));
    return landing;
}

// What bears it is not parallel to what it presses with.
TEST(ClothBetween, does_not_throw_a_box_that_lands_on_an_edge_or_a_corner) {
    for (const Vec3 degrees : {Vec3{20, 0, 0}, Vec3{0, 0, 10}, Vec3{20, 30, 10}})
        for (const std::uint32_t substeps : {10u, 20u, 40u}) {
            const Landing landing = land(degrees, substeps, 41);
            EXPECT_LT(landing.gained, 0.3) << degrees.x << ' ' << degrees.z << ' ' << substeps;
            EXPECT_NEAR(landing.end.state.place.y, resting_height(0.1f), 0.1f * thickness())
                << degrees.x << ' ' << degrees.z << ' ' << substeps;
            EXPECT_LT(speed_of(landing.end), 5e-3f) << degrees.x << ' ' << degrees.z << ' ' << substeps;
        }
}

// What the table has held with static friction up to its limit does not slip back to kinetic friction.
TEST(ClothBetween, stays_flat_beneath_a_box_that_lands_on_a_corner) {
    for (const std::uint32_t substeps : {20u, 40u})
        EXPECT_LT(land({20, 30, 10}, substeps, 41, 0.35f).way, 0.08f) << substeps;
}

// Adds cloth whose edge is pulled over the table at this speed, from 0.25 s on.
void add_pulled_cloth(World& world, float speed, float way) {
    const auto is_edge = [](Vec3 p) { return p.x > 0.499f; };
    const auto model = table_cloth(41, is_edge);
    KinematicTargets targets;
    targets.motions.push_back({.offsets = {{0.25f, {}}, {0.25f + way / speed, {way, 0, 0}}}});
    for (std::uint32_t p = 0; p < model->particle_count; ++p)
        if (is_edge(model->start[p].xyz())) targets.particles.push_back({p, 0, model->start[p].xyz()});
    world.add(model, targets);
}

// How far a box goes that stands on cloth, which is pulled away by one edge.
float goes_along(float speed, std::uint32_t substeps) {
    World world = make_world({.solver = {.substeps = substeps}});
    add_pulled_cloth(world, speed, 1.2f);
    world.add(make_table({0, -0.05f, 0}));
    const ColliderId id = world.add(rubbed(make_box({0.05f, 0.05f, 0.05f}, 0.3f, {-0.2f, resting_height(0.05f), 0})));
    run(world, 0.25 + double{1.2f / speed});
    return world.body(id).state.place.x + 0.2f;
}

TEST(ClothBetween, leaves_a_box_behind_when_it_is_pulled_away_fast) {
    for (const std::uint32_t substeps : {20u, 40u}) EXPECT_LT(std::abs(goes_along(4, substeps)), 0.08f) << substeps;
}

// With static friction above kinetic friction, cloth that had to be pulled loose in each substep would hold the boxes.
TEST(ClothBetween, takes_boxes_along_when_it_is_pulled_slowly) {
    constexpr float speed = 0.1f, way = 2 * speed;
    for (const float mass : {0.03f, 0.3f, 3.0f}) {
        World world = make_world({.solver = {.substeps = 20}});
        add_pulled_cloth(world, speed, way);
        Collider table = make_table({0, -0.05f, 0});
        table.friction = {0.5f, 0.35f};
        world.add(std::move(table));
        Collider box = make_box({0.05f, 0.05f, 0.05f}, mass, {-0.2f, resting_height(0.05f), 0});
        box.friction = {0.5f, 0.35f};
        const ColliderId id = world.add(std::move(box));
        run(world, 2.25);
        EXPECT_NEAR(world.body(id).state.place.x + 0.2f, way, 0.2f * way) << mass << " kg";
    }
}

// How far a box slides in a second on cloth that lies on a sloping table, pinned at its upper edge.
float slides(float degrees) {
    World world = make_world({.solver = {.substeps = 20}});
    world.add(table_cloth(21, [](Vec3 p) { return p.x < -0.499f; }));
    world.add(make_table({0, -0.05f, 0}));
    const ColliderId id = world.add(rubbed(make_box({0.1f, 0.03f, 0.1f}, 0.3f, {0, resting_height(0.03f), 0})));
    run(world, 0.5);
    WorldSettings tilted = world.settings();
    const float angle = degrees * std::numbers::pi_v<float> / 180;
    tilted.gravity = {9.81f * std::sin(angle), -9.81f * std::cos(angle), 0};
    world.configure(tilted);
    run(world, 0.5);
    const float before = world.body(id).state.place.x;
    run(world, 1);
    return world.body(id).state.place.x - before;
}

TEST(ClothBetween, holds_a_box_on_a_slope_while_friction_does) {
    const float limit = std::atan(friction) * 180 / std::numbers::pi_v<float>;
    EXPECT_LT(slides(limit - 2), 2e-3f);
    EXPECT_GT(slides(limit + 2), 0.05f);
}

TEST(ClothBetween, rises_with_a_collider_that_carries_it) {
    World world = make_world({.solver = {.substeps = 20}});
    world.add(table_cloth(21));
    Collider table = make_table({0, -0.05f, 0});
    table.motion = {{.time = 0, .position = {0, -0.05f, 0}}, {.time = 1, .position = {0, 0.25f, 0}}};
    world.add(std::move(table));
    const ColliderId id = world.add(rubbed(make_box({0.1f, 0.1f, 0.1f}, 0.3f, {0.02f, resting_height(0.1f), 0.01f})));
    run(world, 2);
    EXPECT_NEAR(world.body(id).state.place.y, 0.3f + resting_height(0.1f), 0.05f * thickness());
}

// Labels: threads
TEST(ClothBetween, gives_the_same_bits_on_any_number_of_threads_and_after_a_restore) {
    std::string hash;
    for (const unsigned workers : {0u, 1u, 3u}) {
        World world = make_world({.solver = {.substeps = 10}}, CpuOptions{.workers = workers});
        world.add(table_cloth(21));
        world.add(make_table({0, -0.05f, 0}));
        for (int i = 0; i < 4; ++i)
            world.add(rubbed(make_box({0.05f, 0.05f, 0.05f}, 0.1f * static_cast<float>(i + 1),
                                      {0.2f * static_cast<float>(i) - 0.3f, 0.08f, 0.1f}, {.velocity = {1, 0, 0.5f}})));
        run(world, 0.4);
        const Snapshot middle = world.save();
        run(world, 0.4);
        const std::string end = world.state_hash();
        if (hash.empty()) hash = end;
        EXPECT_EQ(end, hash) << workers;
        ASSERT_TRUE(world.restore(*snapshot_from_bytes(to_bytes(middle))).ok());
        run(world, 0.4);
        EXPECT_EQ(world.state_hash(), hash) << workers;
    }
}

}  // namespace
}  // namespace weft::physical
