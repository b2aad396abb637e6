// Forces of cloth on colliders: weights, conservation of momentum, and when results are available.

#include "solver/state/contact_forces.test.h"
#include "sheet.h"

#include <array>
#include <limits>

namespace weft::physical {
namespace {

constexpr double frame_seconds = 1.0 / 60, gravity = 9.81;

double mass_of(const World& world) {
    double mass = 0;
    for (const ClothFrame& cloth : world.summary().cloths)
        for (const float m : cloth.model->mass) mass += m;
    return mass;
}

// Of particles that move.
Vec3 momentum_of(const World& world) {
    double x = 0, y = 0, z = 0;
    for (const ClothFrame& cloth : world.frame().cloths) {
        for (std::size_t p = 0; p < cloth.positions.size(); ++p) {
            if (!(cloth.positions[p].w > 0)) continue;
            const double m = cloth.model->mass[p];
            x += m * cloth.velocities[p].x, y += m * cloth.velocities[p].y, z += m * cloth.velocities[p].z;
        }
    }
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

SheetDesc small(Vec3 position) {
    return {.size = {0.4f, 0.4f}, .resolution = {9, 9}, .position = position};
}

Collider ground(float height = 0) {
    return make_collider({.name = "ground", .shape = PlaneDesc{{0, 1, 0}, height}});
}

Collider table(Vec3 position, Vec3 half_extents = {0.3f, 0.5f, 0.3f}) {
    return make_collider(
        {.shape = BoxDesc{half_extents}, .transform = {.position = position}, .friction = {0.5f, 0.4f}});
}

void expect_near(Vec3 value, Vec3 expected, double tolerance, const char* what) {
    EXPECT_NEAR(value.x, expected.x, tolerance) << what;
    EXPECT_NEAR(value.y, expected.y, tolerance) << what;
    EXPECT_NEAR(value.z, expected.z, tolerance) << what;
}

TEST(ContactForces, of_a_sheet_at_rest_is_its_weight) {
    for (const std::uint32_t iterations : {1u, 3u}) {
        World world = make_world({.solver = {.substeps = 10, .iterations = iterations}, .contact_forces = true});
        const ColliderId floor = world.add(ground());
        const ClothId sheet = world.add(make_sheet(small({0, 0.001f, 0})));
        run(world, 0.2);
        const ContactForces& forces = world.contact_forces();
        EXPECT_EQ(forces.frame, 12u);
        ASSERT_EQ(forces.colliders.size(), 1u);
        const ColliderForce& load = forces.colliders[0];
        const auto weight = static_cast<float>(mass_of(world) * gravity);
        EXPECT_EQ(load.collider, floor);
        expect_near(load.force, {0, -weight, 0}, 1e-4 * weight, "force");
        expect_near(load.impulse, {0, -weight / 60, 0}, 1e-4 * weight / 60, "impulse");
        expect_near(load.torque, {}, 1e-4 * weight * 0.2, "torque about the middle");
        EXPECT_EQ(load.contacts, 81u) << "it lies flat";
        ASSERT_EQ(forces.contacts.size(), 81u);
        Vec3 sum;
        for (std::uint32_t i = 0; i < 81; ++i) {
            const Contact& contact = forces.contacts[i];
            EXPECT_EQ(contact.cloth, sheet);
            EXPECT_EQ(contact.collider, floor);
            EXPECT_EQ(contact.vertex, i) << "in order";
            EXPECT_EQ(contact.point, world.frame().cloths[0].positions[i].xyz());
            EXPECT_LT(contact.impulse.y, 0) << "downwards";
            sum += contact.impulse;
        }
        expect_near(sum, load.impulse, 1e-6 * weight / 60, "sum over the contacts");
    }
}

// Labels on Vulkan: long
TEST(ContactForces, of_a_draped_sheet_is_its_weight_on_the_mean) {
    World world = make_world({.solver = {.substeps = 10}, .contact_forces = true});
    world.add(make_collider({.shape = SphereDesc{0.2f}, .friction = {1, 1}}));
    SheetDesc sheet{.size = {0.4f, 0.4f}, .resolution = {13, 13}, .position = {0, 0.202f, 0}};
    sheet.fabric.body.damping = 0.05f;
    world.add(make_sheet(sheet));
    run(world, 2);
    Vec3 force, torque;
    for (int i = 0; i < 30; ++i) {
        world.step(frame_seconds);
        force += world.contact_forces().colliders[0].force / 30;
        torque += world.contact_forces().colliders[0].torque / 30;
    }
    const double weight = mass_of(world) * gravity;
    expect_near(force, {0, static_cast<float>(-weight), 0}, 0.03 * weight, "force");
    expect_near(torque, {}, 0.03 * weight * 0.2, "torque");
    EXPECT_GT(world.contact_forces().contacts.size(), 20u);
}

TEST(ContactForces, of_free_fall_is_none) {
    World world = make_world({.solver = {.substeps = 5}, .contact_forces = true});
    world.add(ground(-9));
    world.add(make_sheet(small({})));
    for (int i = 0; i < 10; ++i) {
        world.step(frame_seconds);
        const ContactForces& forces = world.contact_forces();
        EXPECT_TRUE(forces.contacts.empty());
        ASSERT_EQ(forces.colliders.size(), 1u);
        EXPECT_EQ(forces.colliders[0].impulse, Vec3());
        EXPECT_EQ(forces.colliders[0].torque, Vec3());
        EXPECT_EQ(forces.colliders[0].contacts, 0u);
    }
}

// Labels on Vulkan: long
TEST(ContactForces, of_two_tables_adds_up_to_the_weight) {
    World world = make_world({.solver = {.substeps = 10}, .contact_forces = true});
    const ColliderId left = world.add(table({-0.16f, -0.5f, 0}, {0.1f, 0.5f, 0.3f}));
    const ColliderId right = world.add(table({0.16f, -0.5f, 0}, {0.1f, 0.5f, 0.3f}));
    world.add(make_sheet(small({0, 0.001f, 0})));
    run(world, 1);
    const double weight = mass_of(world) * gravity;
    Vec3 force;
    for (int i = 0; i < 30; ++i) {
        world.step(frame_seconds);
        for (const ColliderForce& load : world.contact_forces().colliders) force += load.force / 30;
    }
    EXPECT_NEAR(force.y, -weight, 0.02 * weight);
    EXPECT_NEAR(force.x, 0, 0.02 * weight) << "what pulls one of them, pulls the other back";
    const auto& loads = world.contact_forces().colliders;
    EXPECT_EQ(loads[0].collider, left);
    EXPECT_EQ(loads[1].collider, right);
    EXPECT_NEAR(loads[0].force.y, loads[1].force.y, 0.1 * weight) << "alike from both sides";
}

TEST(ContactForces, of_a_weight_on_a_lever_is_a_torque) {
    World world = make_world({.solver = {.substeps = 10}, .contact_forces = true});
    world.add(table({0, -0.5f, 0}, {2, 0.5f, 2}));
    world.add(make_sheet(small({1, 0.001f, 0.5f})));
    run(world, 0.2);
    const double weight = mass_of(world) * gravity;
    const Vec3 torque = world.contact_forces().colliders[0].torque;
    // (1, 0.5, 0.5) × (0, -W, 0)
    expect_near(torque, {static_cast<float>(0.5 * weight), 0, static_cast<float>(-weight)}, 1e-3 * weight, "torque");
}

// In each frame the momentum that the cloth gains, without that from gravity, is the opposite of what the colliders
// gain: falling, landing, dragged along and turned. The tolerance is rounding: one ulp of a position, 3e-8 m, is
// 1.4e-5 m/s in such a substep.
// Labels on Vulkan: long
TEST(ContactForces, balances_the_momentum_of_the_cloth) {
    for (const Projection projection : {Projection::lines, Projection::jacobi}) {
        World world =
            make_world({.solver = {.substeps = 8, .iterations = 2, .projection = projection}, .contact_forces = true});
        world.add(make_collider({.shape = BoxDesc{{0.3f, 0.1f, 0.3f}},
                                 .friction = {0.6f, 0.5f},
                                 .motion = {{0, {0, -0.1f, 0}, {}}, {1, {0.4f, 0.1f, 0}, {0, 60, 20}}}}));
        world.add(ground(-0.15f));
        world.add(make_sheet(small({0.05f, 0.1f, 0})));
        const double mass = mass_of(world);
        Vec3 before = momentum_of(world);
        float hardest = 0, sideways = 0;
        for (int i = 0; i < 40; ++i) {
            world.step(frame_seconds);
            Vec3 lost;
            for (const ColliderForce& load : world.contact_forces().colliders) lost += load.impulse;
            const Vec3 now = momentum_of(world);
            const Vec3 gained = now - before - Vec3{0, static_cast<float>(-mass * gravity * frame_seconds), 0};
            expect_near(lost, -gained, 1.4e-5 * mass, "momentum");
            hardest = std::max(hardest, -lost.y), sideways = std::max(sideways, std::abs(lost.x));
            before = now;
        }
        EXPECT_GT(hardest, 5 * mass * gravity * frame_seconds) << "it did land";
        EXPECT_GT(sideways, 0.2 * mass * gravity * frame_seconds) << "and was dragged along";
    }
}

TEST(ContactForces, of_a_ball_without_friction_turns_nothing) {
    Fabric smooth;
    smooth.contact.friction[0] = smooth.contact.friction[1] = 0;
    World world = make_world({.solver = {.substeps = 10}, .contact_forces = true});
    world.add(make_collider({.shape = SphereDesc{0.2f}, .transform = {.position = {0.1f, 0, 0}}}));
    SheetDesc sheet = small({0, 0.25f, 0});
    sheet.fabric = smooth;
    world.add(make_sheet(sheet));
    double most = 0;
    for (int i = 0; i < 30; ++i) {
        world.step(frame_seconds);
        const ColliderForce& load = world.contact_forces().colliders[0];
        most = std::max(most, double{length(load.force)});
        // A particle that touches on its way is noted where it ends, up to 1 mm farther along the plane.
        EXPECT_LT(length(load.torque), 1e-3 * length(load.force) + 1e-7);
    }
    EXPECT_GT(most, mass_of(world) * gravity) << "it did hit the ball";
}

TEST(ContactForces, of_what_is_pinned_is_none) {
    World world = make_world({.solver = {.substeps = 5, .iterations = 2}, .contact_forces = true});
    world.add(ground());
    SheetDesc sheet = small({0, -0.1f, 0});
    sheet.pinned = [](Vec3) { return true; };
    world.add(make_sheet(sheet));
    world.step(frame_seconds);
    EXPECT_TRUE(world.contact_forces().contacts.empty());
    EXPECT_EQ(world.contact_forces().colliders[0].force, Vec3());
}

TEST(ContactForces, is_of_the_frame_before_until_somebody_waits) {
    World world = make_world({.solver = {.substeps = 5}, .contact_forces = true});
    world.add(ground());
    world.add(make_sheet(small({0, 0.001f, 0})));
    EXPECT_EQ(world.contact_forces().frame, 0u) << "none yet";
    EXPECT_TRUE(world.contact_forces().colliders.empty());
    for (std::uint64_t frame = 1; frame < 5; ++frame) {
        world.advance(frame_seconds);
        EXPECT_EQ(world.index(), frame);
        EXPECT_EQ(world.contact_forces().frame, frame - 1);
        EXPECT_EQ(world.contact_forces().contacts.size(), frame == 1 ? 0u : 81u);
    }
    EXPECT_EQ(world.summary().index, 4u);
    EXPECT_EQ(world.contact_forces().frame, 4u);
    world.advance(frame_seconds);
    (void)world.frame();
    EXPECT_EQ(world.contact_forces().frame, 5u);
    world.advance(frame_seconds);
    world.advance(frame_seconds);
    EXPECT_EQ(world.contact_forces().frame, 6u) << "no query between the two frames";
    world.add(ground(-1));
    EXPECT_EQ(world.contact_forces().frame, 7u) << "a change waits";
    EXPECT_EQ(world.contact_forces().colliders.size(), 1u) << "but was not there then";
    EXPECT_EQ(world.contact_forces().contacts.size(), 81u);
}

// Labels on Vulkan: long
TEST(ContactForces, changes_nothing_and_may_come_and_go) {
    const auto play = [](bool ever, std::vector<std::uint32_t>* contacts) {
        World world = make_world({.solver = {.substeps = 5, .iterations = 2}});
        const ColliderId floor = world.add(ground());
        const ClothId sheet = world.add(make_sheet(small({0, 0.001f, 0})));
        const auto set = [&](bool on) {
            WorldSettings settings = world.settings();
            settings.contact_forces = on && ever;
            world.configure(settings);
        };
        const auto step = [&] {
            world.step(frame_seconds);
            if (contacts) contacts->push_back(static_cast<std::uint32_t>(world.contact_forces().contacts.size()));
        };
        step();
        set(true);
        step();
        const ColliderId ball =
            world.add(make_collider({.shape = SphereDesc{0.05f}, .transform = {.position = {0, 0.02f, 0}}}));
        step();
        if (ever) {
            EXPECT_EQ(world.contact_forces().colliders.size(), 2u);
        }
        if (ever) {
            EXPECT_GT(world.contact_forces().colliders[1].contacts, 0u);
        }
        world.remove(floor);
        step();
        if (ever) {
            EXPECT_EQ(world.contact_forces().colliders.size(), 1u);
        }
        if (ever) {
            EXPECT_EQ(world.contact_forces().colliders[0].collider, ball);
        }
        set(false);
        EXPECT_EQ(world.contact_forces().frame, 0u);
        step();
        set(true);
        world.add(ground());
        const ClothId other = world.add(make_sheet(small({0.5f, 0.001f, 0})));
        step();
        world.remove(sheet);
        step();
        if (ever) {
            EXPECT_EQ(world.contact_forces().contacts.back().cloth, other);
        }
        world.remove(ball);
        world.remove(other);
        step();
        if (ever) {
            EXPECT_EQ(world.contact_forces().colliders.size(), 1u);
        }
        const ClothId third = world.add(make_sheet(small({0, 0.001f, 0})));
        EXPECT_TRUE(world.set_model(third, make_sheet(small({0, 0.001f, 0})), {}).ok());
        step();
        return world.state_hash();
    };
    std::vector<std::uint32_t> contacts;
    EXPECT_EQ(play(true, &contacts), play(false, nullptr));
    ASSERT_EQ(contacts.size(), 9u);
    EXPECT_EQ(contacts[0], 0u) << "off";
    EXPECT_EQ(contacts[1], 81u);
    EXPECT_GT(contacts[2], 81u);
    EXPECT_GT(contacts[3], 0u) << "on the ball alone";
    EXPECT_EQ(contacts[4], 0u) << "off again";
    EXPECT_GT(contacts[5], 81u);
    EXPECT_EQ(contacts[6], 81u);
    EXPECT_EQ(contacts[7], 0u) << "no cloth";
    EXPECT_EQ(contacts[8], 81u);
}

TEST(ContactForces, of_a_frame_that_is_not_finite_is_none) {
    World world = make_world({.solver = {.substeps = 5}, .contact_forces = true});
    world.add(ground());
    world.add(make_sheet(small({0, 0.001f, 0})));
    run(world, 0.05);
    EXPECT_EQ(world.contact_forces().contacts.size(), 81u);
    WorldSettings settings = world.settings();
    settings.gravity.y = std::numeric_limits<float>::quiet_NaN();
    world.configure(settings);
    EXPECT_EQ(world.step(frame_seconds).reports, report_non_finite);
    EXPECT_EQ(world.contact_forces().frame, world.index());
    EXPECT_TRUE(world.contact_forces().contacts.empty());
    EXPECT_EQ(world.contact_forces().colliders[0].impulse, Vec3());
    EXPECT_EQ(world.contact_forces().colliders[0].contacts, 0u);
    settings.gravity.y = -9.81f;
    world.configure(settings);
    EXPECT_EQ(world.step(frame_seconds).reports, report_none);
    EXPECT_EQ(world.contact_forces().contacts.size(), 81u);
    EXPECT_NEAR(world.contact_forces().colliders[0].force.y, -mass_of(world) * gravity,
                1e-3 * mass_of(world) * gravity);
}

// The island is restored as a whole, so contacts of its finite cloths do not count either.
TEST(ContactForces, of_an_island_with_a_cloth_that_is_not_finite_are_none) {
    World world = make_world({.solver = {.substeps = 5}, .contact_forces = true});
    world.add(ground());
    SheetDesc pinned = small({0.5f, 0.001f, 0});
    pinned.pinned = [](Vec3 p) { return p.x > 0.19f && p.z > 0.19f; };
    const auto model = make_sheet(pinned);
    std::uint32_t pin = 0;
    while (model->start[pin].w != 0) ++pin;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const ClothId broken = world.add(
        model, {.motions = {{.offsets = {{0, {}}, {0.1f, {}}, {0.2f, {nan, 0, 0}}}}}, .particles = {{pin, 0, {}}}});
    const ClothId finite = world.add(make_sheet(small({0, 0.001f, 0})));
    world.add(std::vector<Stitch>{{broken, finite, {.particles = {0, 0, 0}}, {.particles = {8, 0, 0}}, 0.1f, 1e-3f}});
    run(world, 0.09);
    EXPECT_EQ(world.frame().reports, report_none);
    EXPECT_GT(world.contact_forces().contacts.size(), 81u);
    world.step(frame_seconds), world.step(frame_seconds);
    EXPECT_TRUE(world.frame().reports & report_non_finite);
    EXPECT_TRUE(world.contact_forces().contacts.empty());
    EXPECT_EQ(world.contact_forces().colliders[0].contacts, 0u);
}

TEST(ContactForces, is_forgotten_where_another_state_is_restored) {
    World world = make_world({.solver = {.substeps = 5}, .contact_forces = true});
    world.add(ground());
    world.add(make_sheet(small({0, 0.001f, 0})));
    run(world, 0.1);
    const Snapshot then = world.save();
    world.step(frame_seconds);
    const std::vector<std::uint32_t> forces = bits_of(world.contact_forces());
    ASSERT_TRUE(world.restore(then).ok());
    EXPECT_EQ(world.contact_forces().frame, 0u);
    world.step(frame_seconds);
    EXPECT_EQ(bits_of(world.contact_forces()), forces) << "and comes again to the bit";
}

// Each shape with several cloths. All threads share large cloths; small ones run side by side.
// Labels on Vulkan: long
TEST(ContactForces, has_the_same_bits_on_any_number_of_threads_and_lanes) {
    const auto forces = [](const CpuOptions& options) {
        World world = make_world({.solver = {.substeps = 4, .iterations = 2}, .contact_forces = true}, options);
        world.add(ground(-0.1f));
        world.add(make_collider({.shape = SphereDesc{0.1f}}));
        world.add(make_collider({.shape = CapsuleDesc{0.05f, 0.1f}, .transform = {.position = {0.3f, 0, 0}}}));
        world.add(make_collider({.shape = BoxDesc{{0.1f, 0.1f, 0.1f}},
                                 .motion = {{0, {-0.3f, 0, 0}, {}}, {1, {-0.1f, 0.1f, 0}, {0, 40, 0}}}}));
        for (const float x : {-0.3f, 0.0f, 0.3f}) world.add(make_sheet(small({x, 0.12f, 0})));
        std::vector<std::uint32_t> bits;
        for (int i = 0; i < 20; ++i) {
            world.step(frame_seconds);
            const auto more = bits_of(world.contact_forces());
            bits.insert(bits.end(), more.begin(), more.end());
        }
        for (const ColliderForce& load : world.contact_forces().colliders) EXPECT_GT(load.contacts, 0u);
        return bits;
    };
    const std::vector<std::uint32_t> expected = forces({});
    EXPECT_EQ(forces({.workers = 1}), expected) << "side by side";
    EXPECT_EQ(forces({.workers = 2}), expected);
    EXPECT_EQ(forces({.workers = 4}), expected) << "all together on each";
    for (const std::string_view isa : cpu_instruction_sets())
        EXPECT_EQ(forces({.isa = std::string(isa)}), expected) << isa;
}

}  // namespace
}  // namespace weft::physical
