// Adding, removing and changing objects while the world runs; saving and restoring it.

#include "sheet.h"

namespace weft::physical {
namespace {

SheetDesc small(Vec3 position) {
    return {.size = {0.4f, 0.4f}, .resolution = {9, 9}, .position = position};
}

World lively_world(unsigned workers = 0) {
    World world = make_world({.solver = {.substeps = 6, .iterations = 2},
                              .air = AirDesc{.wind = {{.velocity = {1, 0, 0.3f}, .turbulence = {.strength = 0.5f}}}}},
                             {.workers = workers});
    world.add(make_collider(
        {.name = "ball", .shape = SphereDesc{0.2f}, .motion = {{0, {}, {}}, {2, {0, 0.3f, 0}, {90, 0, 0}}}}));
    world.add(make_collider({.name = "ground", .shape = PlaneDesc{{0, 1, 0}, -0.4f}}));
    world.add(make_sheet(small({0, 0.25f, 0})));
    SheetDesc pinned = small({0, 0.5f, 0});
    pinned.pinned = [](Vec3 p) { return p.x < -0.19f; };
    world.add(make_sheet(pinned));
    return world;
}

TEST(Snapshot, brings_back_the_same_bits) {
    World world = lively_world();
    run(world, 0.5);
    const Snapshot kept = world.save();
    const std::string then = world.state_hash();
    const Residual residual = world.stretch_residual();
    run(world, 0.5);
    const std::string later = world.state_hash();
    ASSERT_NE(then, later);

    for (World* target : {&world}) {
        ASSERT_TRUE(target->restore(kept).ok());
        EXPECT_EQ(target->state_hash(), then);
        EXPECT_EQ(target->stretch_residual().mean, residual.mean);
        EXPECT_EQ(target->frame().index, 30u);
        run(*target, 0.5);
        EXPECT_EQ(target->state_hash(), later);
    }
    // In another world with the same settings and other threads.
    World other = lively_world(2);
    ASSERT_TRUE(other.restore(kept).ok());
    run(other, 0.5);
    EXPECT_EQ(other.state_hash(), later);
}

TEST(World, starts_a_cloth_with_its_velocity) {
    constexpr Vec3 velocity{2, 5, -1};
    SheetDesc flying = small({0, 1, 0});
    flying.velocity = velocity;
    World world = make_world({.gravity = {}}, flying);
    for (const Vec4& v : world.frame().cloths[0].velocities) EXPECT_EQ(v.xyz(), velocity);
    run(world, 0.5);
    const ClothFrame& cloth = world.frame().cloths[0];
    const Vec3 center = center_of_mass(cloth);
    EXPECT_NEAR(center.x, 1, 1e-5);
    EXPECT_NEAR(center.y, 3.5, 1e-5);
    EXPECT_NEAR(center.z, -0.5, 1e-5);
    EXPECT_LT(measure_strain(world.frame()).stretch.max, 1e-4) << "all particles fly alike";

    // Another model keeps the velocities of the particles.
    ASSERT_TRUE(world.set_model(world.cloth_id(0), make_sheet(small({0, 1, 0})), {}).ok());
    for (const Vec4& v : world.frame().cloths[0].velocities) EXPECT_NEAR(v.y, velocity.y, 1e-3);
}

TEST(World, starts_pinned_particles_at_rest) {
    SheetDesc sheet = small({0, 1, 0});
    sheet.velocity = {0, -3, 0};
    sheet.pinned = [](Vec3 p) { return p.x < -0.19f; };
    World world = make_world({.gravity = {}}, sheet);
    const auto count_moved = [&] {
        const ClothFrame& cloth = world.frame().cloths[0];
        int moved = 0;
        for (std::uint32_t p = 0; p < cloth.model->particle_count; ++p) {
            const bool pinned = !(cloth.positions[p].w > 0);
            EXPECT_EQ(cloth.velocities[p].xyz() == Vec3{}, pinned) << p;
            if (pinned) {
                EXPECT_EQ(cloth.positions[p].xyz(), cloth.model->rest_position(p)) << p;
            }
            moved += cloth.positions[p].y < 1;
        }
        return moved;
    };
    EXPECT_EQ(count_moved(), 0);
    run(world, 1.0 / 60);
    EXPECT_EQ(count_moved(), 9 * 8);
}

TEST(World, is_measured_as_its_frame_is) {
    World world = lively_world();
    run(world, 0.25);
    const auto near = [](double a, double b) { EXPECT_NEAR(a, b, 1e-5 * b); };
    const ClothMeasures there = world.measure(), here = measure(world.frame());
    near(there.strain.stretch.mean, here.strain.stretch.mean);
    near(there.strain.stretch.max, here.strain.stretch.max);
    near(there.strain.shear.mean, here.strain.shear.mean);
    near(there.strain.shear.max, here.strain.shear.max);
    near(there.kinetic_energy, here.kinetic_energy);
    near(there.max_speed, here.max_speed);
    EXPECT_GT(there.residual.mean, 0);
    EXPECT_TRUE(there.finite);
    EXPECT_EQ(world.stretch_residual().max, there.residual.max) << "the same every time";
}

TEST(Snapshot, survives_being_written_and_read) {
    World world = lively_world();
    run(world, 0.25);
    const std::vector<std::byte> bytes = to_bytes(world.save());
    const std::string then = world.state_hash();
    run(world, 0.25);
    const auto read = snapshot_from_bytes(bytes);
    ASSERT_TRUE(read.ok());
    ASSERT_TRUE(world.restore(*read).ok());
    EXPECT_EQ(world.state_hash(), then);
}

TEST(Snapshot, that_is_damaged_is_refused) {
    World world = lively_world();
    const std::vector<std::byte> bytes = to_bytes(world.save());
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{3}, std::size_t{12}, std::size_t{40}, bytes.size() - 1}) {
        EXPECT_FALSE(snapshot_from_bytes(std::span(bytes).first(size)).ok()) << size;
    }
    for (std::size_t at = 0; at < bytes.size(); at += 97) {
        std::vector<std::byte> changed = bytes;
        changed[at] ^= std::byte{0x10};
        EXPECT_FALSE(snapshot_from_bytes(changed).ok()) << at;
    }
    std::vector<std::byte> longer = bytes;
    longer.resize(bytes.size() + 4);
    EXPECT_FALSE(snapshot_from_bytes(longer).ok());
}

TEST(Snapshot, of_another_world_is_refused_and_changes_nothing) {
    World world = lively_world();
    run(world, 0.1);
    const std::string before = world.state_hash();
    World fewer = make_world({}, small({}));
    EXPECT_EQ(world.restore(fewer.save()).error().message(), "state: has 1 cloths, here there are 2");
    World larger = lively_world();
    larger.remove(larger.frame().cloths[1].id);
    larger.add(make_sheet({.resolution = {20, 20}}));
    EXPECT_FALSE(world.restore(larger.save()).ok());
    EXPECT_EQ(world.state_hash(), before);
}

TEST(World, forgets_what_is_removed_and_never_takes_one_id_for_another) {
    World world = make_world({});
    const ClothId first = world.add(make_sheet(small({}))), second = world.add(make_sheet(small({1, 0, 0})));
    EXPECT_NE(first, second);
    EXPECT_TRUE(first);
    EXPECT_FALSE(ClothId{});
    world.step(1.0 / 60);
    world.remove(first);
    EXPECT_FALSE(world.contains(first));
    EXPECT_TRUE(world.contains(second));
    ASSERT_EQ(world.frame().cloths.size(), 1u);
    EXPECT_EQ(world.frame().cloths[0].id, second);
    const ClothId third = world.add(make_sheet(small({2, 0, 0})));
    EXPECT_NE(third, first) << "the place may be the same, the id is not";
    EXPECT_FALSE(world.contains(first));
    world.step(1.0 / 60);
    EXPECT_NEAR(world.frame().cloths[0].positions[0].x, 0.8f, 1e-5f);
    EXPECT_NEAR(world.frame().cloths[1].positions[0].x, 1.8f, 1e-5f);
    EXPECT_FALSE(world.contains(ClothId{77, 1}));
}

TEST(World, runs_one_cloth_as_if_the_others_were_not_there) {
    World both = make_world({}), alone = make_world({});
    const ClothId other = both.add(make_sheet(small({5, 0, 0})));
    both.add(make_sheet(small({})));
    alone.add(make_sheet(small({})));
    run(both, 0.2), run(alone, 0.2);
    both.remove(other);
    EXPECT_EQ(both.state_hash(), alone.state_hash());
}

TEST(World, changes_material_and_pins_while_cloth_moves) {
    SheetDesc desc = small({0, 0, 0});
    World world = make_world({}, desc);
    const ClothId id = world.frame().cloths[0].id;
    run(world, 0.2);
    const Vec4 before = world.frame().cloths[0].positions[3], velocity = world.frame().cloths[0].velocities[3];
    desc.fabric.body.density = 1;
    desc.pinned = [](Vec3 p) { return p.x < -0.19f; };
    ASSERT_TRUE(world.set_model(id, make_sheet(desc), {}));
    EXPECT_EQ(world.frame().cloths[0].positions[3].xyz(), before.xyz());
    EXPECT_EQ(world.frame().cloths[0].velocities[3].xyz(), velocity.xyz());
    const Vec3 corner = world.frame().cloths[0].positions[0].xyz();
    float lowest = corner.y;
    for (int i = 0; i < 30; ++i) {
        world.step(1.0 / 60);
        lowest = std::min(lowest, world.frame().cloths[0].positions[8].y);
    }
    EXPECT_EQ(world.frame().cloths[0].positions[0].xyz(), corner) << "held where it was when it was pinned";
    EXPECT_LT(lowest, corner.y - 0.3f) << "the other side swings down";
    EXPECT_LT(measure_strain(world.frame()).stretch.max, 0.1);
}

// Labels on Vulkan: long
TEST(World, takes_cloth_along_with_a_collider_that_is_moved) {
    SheetDesc desc = small({0, 0.002f, 0});
    desc.fabric.contact.friction[0] = desc.fabric.contact.friction[1] = 2;
    World world = make_world({}, desc);
    const ColliderId table = world.add(make_collider(
        {.shape = BoxDesc{{0.5f, 0.5f, 0.5f}}, .transform = {.position = {0, -0.5f, 0}}, .friction = {2, 2}}));
    run(world, 0.3);
    Pose pose = world.collider(table).pose;
    for (int i = 0; i < 60; ++i) {
        pose.position.x += 0.004f;
        world.move(table, pose);
        world.step(1.0 / 60);
        EXPECT_EQ(world.collider(table).pose, pose);
    }
    EXPECT_NEAR(center_of_mass(world.frame().cloths[0]).x, 0.24f, 0.02f);
    const float y = center_of_mass(world.frame().cloths[0]).y;
    run(world, 0.2);
    EXPECT_EQ(world.collider(table).pose, pose) << "it stays where it was put";
    world.remove(table);
    run(world, 0.3);
    EXPECT_LT(center_of_mass(world.frame().cloths[0]).y, y - 0.3f) << "nothing to stand on";
}

// Labels on Vulkan: long
TEST(World, keeps_pins_where_their_collider_left_them) {
    const auto model = make_sheet({.size = {0.2f, 0.2f}, .resolution = {3, 3}, .pinned = [](Vec3) { return true; }});
    World world = make_world({});
    const ColliderId ball =
        world.add(make_collider({.shape = SphereDesc{0.01f}, .motion = {{0, {}, {}}, {1, {0, 1, 0}, {}}}}));
    const ColliderId other =
        world.add(make_collider({.shape = SphereDesc{0.01f}, .transform = {.position = {9, 9, 9}}}));
    KinematicTargets targets{.motions = {{.collider = ball}}, .particles = {}};
    for (std::uint32_t p = 0; p < 9; ++p) targets.particles.push_back({p, 0, model->rest_position(p)});
    world.add(model, targets);
    run(world, 0.5);
    EXPECT_NEAR(world.frame().cloths[0].positions[4].y, 0.5f, 0.01f);
    const Vec4 there = world.frame().cloths[0].positions[4];
    world.remove(ball);
    run(world, 0.5);
    EXPECT_EQ(world.frame().cloths[0].positions[4].xyz(), there.xyz());
    EXPECT_TRUE(world.contains(other));
}

TEST(World, takes_new_settings_between_steps) {
    World world = make_world({}, small({}));
    run(world, 0.2);
    WorldSettings settings = world.settings();
    settings.gravity = {};
    settings.solver.substeps = 3;
    settings.solver.projection = Projection::jacobi;
    world.configure(settings);
    const float v = world.frame().cloths[0].velocities[0].y;
    run(world, 0.2);
    EXPECT_NEAR(world.frame().cloths[0].velocities[0].y, v, 1e-3f) << "nothing pulls any more";
    EXPECT_EQ(world.plan().substeps, 3u);
}

}  // namespace
}  // namespace weft::physical
