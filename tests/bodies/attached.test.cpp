// Cloth that is attached to bodies pulls on them.
#include "attached_worlds.h"

namespace weft::physical {
namespace {

Fabric soft_cotton() {
    Fabric soft = find_fabric("cotton")->fabric;
    soft.stretch = {.stretch = {40, 40}, .compression = {40, 40}, .shear = 10};
    soft.bend = {};
    return soft;
}

// Errors of momentum in parts of what the heavier body had at first, for angular momentum at a distance of 1 m.
struct MomentumErrors {
    double linear = 0, angular = 0;
    double energy = 0;  ///< the largest, in parts of that at the start
};

enum class Pinned { when_built, later };

// A sheet between two boxes that fly apart and turn, without gravity. Coarse levels do not act on cloth as soft as
// soft_cotton(). They do not know pins that were set later.
MomentumErrors fly_apart(float mass, float compliance, Method method, const Fabric& fabric,
                         Pinned pinned = Pinned::when_built) {
    WorldSettings settings{.gravity = {}, .solver = {.substeps = 10}};
    settings.solver.method = method;
    World world = make_world(settings);
    const ColliderId left = world.add(
        make_box({0.05f, 0.04f, 0.3f}, 1, {-0.55f, 0, 0}, {.velocity = {-1, 0.4f, 0.2f}, .spin = {20, 40, 10}}));
    const ColliderId right =
        world.add(make_box({0.05f, 0.04f, 0.3f}, mass, {0.55f, 0, 0}, {.velocity = {1, -0.2f, 0}, .spin = {60, 0, 0}}));
    const SheetDesc sheet{.resolution = {17, 9}, .fabric = fabric, .layout = {.lines = true, .hierarchy = true}};
    const ClothId cloth = add_attached(world, sheet,
                                       {{left, [](Vec3 p) { return p.x < -0.49f; }, compliance},
                                        {right, [](Vec3 p) { return p.x > 0.49f; }, compliance}});
    if (pinned == Pinned::later) {
        const KinematicTargets targets = world.kinematic_targets(cloth);
        const std::vector<std::uint32_t> particles = world.pinned(cloth);
        world.remove(cloth);
        EXPECT_TRUE(world.set_pins(world.add(make_sheet(sheet)), particles, targets).ok());
    }
    world.step(1.0 / 6000);  // the bodies take the masses of the particles
    const Momentum start = momentum_with_attached(world);
    const double heavier = std::max(1.0, double{mass});
    MomentumErrors errors;
    for (int frame = 0; frame < 120; ++frame) {
        world.step(1.0 / 60);
        const Momentum now = momentum_with_attached(world);
        errors.linear = std::max(errors.linear, distance_between(now.linear, start.linear) / heavier);
        errors.angular = std::max(errors.angular, distance_between(now.angular, start.angular) / heavier);
        errors.energy = std::max(errors.energy, now.energy / start.energy);
    }
    const float apart = length(world.collider(left).pose.position - world.collider(right).pose.position);
    EXPECT_LT(apart, 3) << "the sheet holds them together";
    return errors;
}

void expect_momentum(Method method, const Fabric& fabric, double linear, double angular, double energy) {
    for (const float mass : {0.02f, 1.0f, 50.0f}) {
        for (const float compliance : {0.0f, 1e-3f}) {
            const MomentumErrors errors = fly_apart(mass, compliance, method, fabric);
            EXPECT_LT(errors.linear, linear) << mass << ' ' << compliance;
            EXPECT_LT(errors.angular, angular) << mass << ' ' << compliance;
            EXPECT_LT(errors.energy, energy) << mass << ' ' << compliance;
        }
    }
}

// What is left is rounding: an attached point of a heavy body moves by few of the smallest steps of a float.
TEST(AttachedCloth, and_its_bodies_exchange_momentum) {
    expect_momentum(Method::pbd, soft_cotton(), 3e-3, 5e-3, 1.01);
}

TEST(AttachedCloth, exchanges_momentum_with_its_bodies_by_coarse_levels) {
    const Fabric cotton = find_fabric("cotton")->fabric;
    expect_momentum(Method::pbd, cotton, 1e-2, 5e-3, 1.01);
    // What levels would move of particles that were pinned later is lost.
    const MomentumErrors errors = fly_apart(1, 0, Method::pbd, cotton, Pinned::later);
    EXPECT_LT(errors.linear, 0.1);
    EXPECT_LT(errors.angular, 0.05);
    EXPECT_LT(errors.energy, 1.01);
}

// Taut edges add masses that differ by particle (taut.md).
TEST(AttachedCloth, and_its_bodies_keep_most_of_their_momentum_where_it_is_taut) {
    expect_momentum(Method::xpbd, soft_cotton(), 1.6e-2, 1.2e-2, 1.01);
    expect_momentum(Method::xpbd, find_fabric("cotton")->fabric, 5e-2, 2e-2, 1.01);
}

// A sheet whose upper edge is pinned, and a crate that hangs by its lower edge.
struct Hanging {
    double extension = 0;  ///< of the sheet, in parts of that of elastic cloth under the load
    double speed = 0;      ///< m/s
};

Hanging hang(float mass, std::uint32_t side, std::uint32_t substeps, float compliance) {
    WorldSettings settings{.solver = {.substeps = substeps}, .air = AirDesc{}};
    World world = make_world(settings);
    const ColliderId crate =
        world.add(make_box({0.5f, 0.1f, 0.1f}, mass, {0, -1.1f, 0}, {.damping = 3, .spin_damping = 3}));
    const Fabric fabric = find_fabric("cotton")->fabric;
    const ClothId cloth = add_attached(world,
                                       {.resolution = {side, side},
                                        .rotation_degrees = {90, 0, 0},
                                        .position = {0, -0.5f, 0},
                                        .fabric = fabric,
                                        .layout = {.lines = true, .hierarchy = true},
                                        .pinned = [](Vec3 p) { return p.z < -0.49f; }},
                                       {{crate, [](Vec3 p) { return p.z > 0.49f; }, compliance}});
    run(world, 8);
    double weight = double{mass} + 0.5 * double{fabric.body.density};
    const double expected = weight * 9.81 / double{fabric.stretch.stretch[1]};
    const auto& x = world.frame().cloths[0].positions;
    const std::uint32_t low = world.model(cloth)->particle_count - side / 2 - 1;
    Hanging hanging;
    hanging.extension = (-1 - double{x[low].y}) / expected;
    hanging.speed = double{speed_of(world.body(crate))};
    return hanging;
}

TEST(AttachedCloth, a_sheet_bears_a_crate) {
    for (const float mass : {1.0f, 20.0f}) {
        for (const float compliance : {0.0f, 1e-4f}) {
            const Hanging hanging = hang(mass, 17, 20, compliance);
            EXPECT_NEAR(hanging.extension, 1, 0.05) << mass << ' ' << compliance;
            EXPECT_LT(hanging.speed, 1e-3) << mass << ' ' << compliance;
        }
    }
}

// The center of mass of a pole and its flag falls freely.
TEST(AttachedCloth, falls_with_its_body_as_one) {
    World world = make_world({.solver = {.substeps = 10}});
    const ColliderId pole = world.add(make_box({0.02f, 0.8f, 0.02f}, 0.3f, {-0.52f, 0, 0}, {.spin = {0, 30, 50}}));
    add_attached(world,
                 {.resolution = {17, 17},
                  .rotation_degrees = {90, 0, 0},
                  .fabric = find_fabric("silk")->fabric,
                  .layout = {.lines = true, .hierarchy = false}},
                 {{pole, [](Vec3 p) { return p.x < -0.49f; }}});
    world.step(1.0 / 6000);
    const Momentum start = momentum_with_attached(world);
    const double mass = double{world.body(pole).own.mass} + 0.0625;
    EXPECT_GT(world.body(pole).mass.mass, world.body(pole).own.mass);
    for (int frame = 0; frame < 60; ++frame) world.step(1.0 / 60);
    const Momentum end = momentum_with_attached(world);
    EXPECT_NEAR(end.linear[1] - start.linear[1], -9.81 * mass, 1e-3 * 9.81 * mass);
    EXPECT_NEAR(end.linear[0], start.linear[0], 1e-3 * 9.81 * mass);
}

// A weight on a strip of cotton of 1 m that is released level with its other end: its largest energy over 4 s above the
// lowest point, in parts of that at the start.
double swings_with(std::array<std::uint32_t, 2> resolution, float mass, std::uint32_t substeps) {
    World world = make_world({.solver = {.substeps = substeps}, .air = AirDesc{}});
    const ColliderId weight = world.add(make_box({0.05f, 0.05f, 0.05f}, mass, {0.55f, 0, 0}));
    add_attached(world,
                 {.size = {1, 0.1f},
                  .resolution = resolution,
                  .fabric = find_fabric("cotton")->fabric,
                  .layout = {.lines = true, .hierarchy = true},
                  .pinned = [](Vec3 p) { return p.x < -0.49f; }},
                 {{weight, [](Vec3 p) { return p.x > 0.49f; }}});
    const auto energy = [&] {
        const BodyState& state = world.body(weight).state;
        const double speed = double{speed_of(world.body(weight))}, length = 1.05;
        return double{mass} * (9.81 * (double{state.place.y} + length) + speed * speed / 2);
    };
    const double start = energy();
    double most = start;
    for (int frame = 0; frame < 240; ++frame) {
        world.step(1.0 / 60);
        most = std::max(most, energy());
    }
    return most / start;
}

// Taut edges must not give back more than the weight has put into them (taut.md).
TEST(AttachedCloth, gives_a_weight_that_swings_no_energy) {
    EXPECT_LT(swings_with({41, 5}, 0.5f, 10), 1.05);
    EXPECT_LT(swings_with({81, 9}, 2, 20), 1.1);
    EXPECT_LT(swings_with({161, 17}, 0.5f, 20), 1.3);
}

// A panel of which all particles are attached is blown along with its body: rho C_D A u²/2. The air acts on triangles
// of their own mass, which is a little less in long substeps.
TEST(AttachedCloth, hands_on_what_the_air_gives_it) {
    AirDesc air;
    air.wind.push_back({.velocity = {0, 0, 5}});
    World world = make_world({.gravity = {}, .solver = {.substeps = 100}, .air = air});
    const ColliderId box = world.add(make_box({0.2f, 0.2f, 0.01f}, 1000, {0, 0, 0.5f}));
    add_attached(world, {.resolution = {9, 9}, .rotation_degrees = {90, 0, 0}, .fabric = find_fabric("cotton")->fabric},
                 {{box, [](Vec3) { return true; }}});
    run(world, 1);
    const double force = 0.5 * 1.225 * 1.28 * 25, mass = double{world.body(box).mass.mass};
    EXPECT_NEAR(double{world.body(box).state.velocity.z}, force / mass, 0.01 * force / mass);
}

TEST(AttachedCloth, follows_its_collider_when_that_becomes_a_body_and_ceases_to_be_one) {
    World world = make_world({.solver = {.substeps = 10}});
    const ColliderId post =
        world.add(make_collider({.name = "post", .shape = BoxDesc{.half_extents = {0.05f, 0.5f, 0.05f}}}));
    const Collider as_body = make_box({0.05f, 0.5f, 0.05f}, 2, {});
    add_attached(world,
                 {.resolution = {9, 9},
                  .rotation_degrees = {90, 0, 0},
                  .position = {0.55f, 0, 0},
                  .fabric = find_fabric("cotton")->fabric,
                  .layout = {.lines = true, .hierarchy = true}},
                 {{post, [](Vec3 p) { return p.x < -0.49f; }}});
    const auto at_post = [&] {
        const Vec3 local = to_local(world.collider(post).pose, world.frame().cloths[0].positions[0].xyz());
        return distance_between({double{local.x}, double{local.y}, double{local.z}}, {0.05, 0.5, 0});
    };
    run(world, 0.5);
    EXPECT_LT(at_post(), 1e-5);
    ASSERT_TRUE(world.set_body(post, as_body.body, as_body.features).ok());
    run(world, 0.2);
    EXPECT_LT(world.collider(post).pose.position.y, -0.1f) << "it falls";
    EXPECT_LT(at_post(), 1e-5);
    const Snapshot saved = world.save();
    run(world, 0.2);
    const std::string expected = world.state_hash();
    ASSERT_TRUE(world.restore(*snapshot_from_bytes(to_bytes(saved))).ok());
    run(world, 0.2);
    EXPECT_EQ(world.state_hash(), expected);
    ASSERT_TRUE(world.set_body(post, std::nullopt, {}).ok());
    const float height = world.collider(post).pose.position.y;
    run(world, 0.5);
    EXPECT_EQ(world.collider(post).pose.position.y, height);
    EXPECT_LT(at_post(), 1e-5);
}

TEST(AttachedCloth, has_the_same_bits_on_any_number_of_threads) {
    std::string hash;
    for (const unsigned workers : {0u, 1u, 3u}) {
        World world = make_world({.solver = {.substeps = 8}}, CpuOptions{.workers = workers});
        add_bodies_in_nets(world, SelfCollision::exact);
        run(world, 1);
        if (hash.empty()) hash = world.state_hash();
        EXPECT_EQ(world.state_hash(), hash) << workers;
    }
}

TEST(AttachedCloth, does_not_move_a_body_without_reaction) {
    World world = make_world({.gravity = {}, .solver = {.substeps = 8}});
    const ColliderId box =
        world.add(make_box({0.1f, 0.1f, 0.5f}, 0.01f, {-0.6f, 0, 0}, {.velocity = {-1, 0, 0}, .reaction = false}));
    add_attached(world, {.resolution = {9, 9}, .fabric = find_fabric("cotton")->fabric},
                 {{box, [](Vec3 p) { return p.x < -0.49f; }}});
    run(world, 1);
    EXPECT_EQ(world.body(box).state.velocity.x, -1);
    EXPECT_EQ(world.body(box).mass, world.body(box).own);
}

// Two at one place, one that turns 1000 times a second, masses of 1e-4 and 1e6 times the cloth's.
TEST(AttachedCloth, stays_finite_whatever_it_hangs_on) {
    for (const float mass : {1e-5f, 0.1f, 1e5f}) {
        World world = make_world({.solver = {.substeps = 8}});
        const ColliderId one = world.add(make_box({0.1f, 0.1f, 0.1f}, mass, {0, 0, 0}, {.spin = {0, 360'000, 0}}));
        const ColliderId two = world.add(make_ball(0.1f, 1, {0, 0, 0}));
        add_attached(world, {.resolution = {9, 9}, .fabric = find_fabric("denim")->fabric},
                     {{one, [](Vec3 p) { return p.x < -0.1f; }}, {two, [](Vec3 p) { return p.x > 0.3f; }, 1e-6f}});
        run(world, 1);
        EXPECT_EQ(world.frame().reports & report_non_finite, 0u) << mass;
        EXPECT_TRUE(is_finite(world.body(one).state)) << mass;
    }
}

}  // namespace
}  // namespace weft::physical
