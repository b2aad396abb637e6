// Keyed motion of colliders, pins and pins on colliders; and tethers.

#include "sheet.h"

namespace weft::physical {
namespace {

TEST(Keys, run_straight_between_and_stay_at_the_ends) {
    const Collider drum = make_collider({.name = "drum",
                                         .shape = CapsuleDesc{},
                                         .transform = {.position = {9, 9, 9}},
                                         .motion = {{1, {0, 0, 0}, {0, 0, 0}}, {3, {2, 4, 6}, {0, 180, 0}}}});
    EXPECT_EQ(drum.pose.position, Vec3(0, 0, 0)) << "keys stand in place of the transform, before the first too";
    EXPECT_EQ(pose_at(drum, 0.5).position, Vec3(0, 0, 0));
    EXPECT_EQ(pose_at(drum, 2).position, Vec3(1, 2, 3));
    EXPECT_EQ(pose_at(drum, 2).rotation, rotation_from_degrees({0, 90, 0}));
    EXPECT_EQ(pose_at(drum, 3).position, Vec3(2, 4, 6));
    EXPECT_EQ(pose_at(drum, 99).rotation, rotation_from_degrees({0, 180, 0}));
    const OffsetKey keys[] = {{0, {}}, {1, {0, 1, 0}}};
    EXPECT_EQ(offset_at(keys, 0.25), Vec3(0, 0.25f, 0));
    EXPECT_EQ(offset_at({}, 0.25), Vec3());
}

TEST(Shapes, signed_distance_is_that_of_the_true_surface) {
    const auto at = [](const ColliderDesc& desc, Vec3 p) { return signed_distance(make_collider(desc), p); };
    const ColliderDesc box{.shape = BoxDesc{{1, 2, 3}},
                           .transform = {.position = {10, 0, 0}, .rotation_degrees = {0, 90, 0}}};
    // Turned by 90° about y, its z extent lies along x.
    EXPECT_NEAR(at(box, {14, 0, 0}), 1, 1e-6) << "face";
    EXPECT_NEAR(at(box, {16, 6, 0}), 5, 1e-6) << "edge: 3 and 4 away";
    EXPECT_NEAR(at(box, {14, 4, 3}), 3, 1e-6) << "corner: 1, 2 and 2 away";
    EXPECT_NEAR(at(box, {10, 0, 0}), -1, 1e-6) << "from the middle the nearest face is out";
    const ColliderDesc capsule{.shape = CapsuleDesc{0.5f, 1}};
    EXPECT_NEAR(at(capsule, {2, 0.9f, 0}), 1.5, 1e-6);
    EXPECT_NEAR(at(capsule, {3, 5, 0}), 4.5, 1e-6) << "round end: 3 and 4 from its center";
    EXPECT_NEAR(at(capsule, {0, 0.2f, 0}), -0.5, 1e-6);
    const ColliderDesc tapered{.shape = TaperedCapsuleDesc{{1.1f, 0.5f}, 0.5f}};
    EXPECT_NEAR(at(tapered, {0, -3, 0}), 1.4, 1e-6) << "the ball at -y";
    EXPECT_NEAR(at(tapered, {0, 3, 0}), 2, 1e-6) << "the ball at +y";
    EXPECT_NEAR(at(tapered, {1.6f, 0.7f, 0}), 0.9, 1e-6) << "2 from the center at -y, along the normal of the cone";
}

// A sheet on a table that starts to move at walking speed. Static friction moves it along; without friction it stays
// behind.
double carried(float friction) {
    Fabric fabric;
    fabric.contact.friction[0] = fabric.contact.friction[1] = friction;
    World world = make_world({.solver = {.substeps = 20}});
    world.add(make_collider({.shape = BoxDesc{{5, 0.5f, 5}},
                             .transform = {.position = {0, -0.5f, 0}},
                             .friction = {friction, friction},
                             .motion = {{0, {0, -0.5f, 0}, {}}, {2, {1, -0.5f, 0}, {}}}}));
    world.add(make_sheet({.size = {0.3f, 0.3f}, .position = {0, 0.001f, 0}, .fabric = fabric}));
    run(world, 2);
    EXPECT_LT(measure_penetration(world.frame(), world.colliders()).max, 1e-6);
    return center_of_mass(world.frame().cloths[0]).x;
}

// Labels on Vulkan: long
TEST(MovingCollider, carries_what_rests_on_it_by_friction_alone) {
    EXPECT_NEAR(carried(0.5f), 1, 0.03) << "it lags by the little that it slips while it is brought up to speed";
    EXPECT_NEAR(carried(0), 0, 1e-4);
}

// Labels on Vulkan: long
TEST(MovingCollider, pushes_cloth_ahead_and_does_not_tunnel) {
    World world = make_world({.solver = {.substeps = 20}});
    world.add(make_collider({.shape = SphereDesc{0.2f}, .motion = {{0, {0, 0, -1}, {}}, {0.5f, {0, 0, 1}, {}}}}));
    world.add(make_sheet(
        {.resolution = {25, 25}, .rotation_degrees = {90, 0, 0}, .pinned = [](Vec3 p) { return p.z < -0.49f; }}));
    double deepest = 0;
    for (int i = 0; i < 30; ++i) {
        world.step(1.0 / 60);
        deepest = std::max(deepest, measure_penetration(world.frame(), world.colliders()).max);
    }
    EXPECT_LT(deepest, 0.006) << "4 m/s: a chord's sag between particles, no more";
    EXPECT_GT(center_of_mass(world.frame().cloths[0]).z, 0.2f) << "it went along";
}

KinematicTargets target_all(const ClothModel& model, TargetMotion motion, const Pose& frame) {
    KinematicTargets targets{.motions = {std::move(motion)}, .particles = {}};
    for (std::uint32_t p = 0; p < model.particle_count; ++p) {
        if (model.start[p].w == 0) targets.particles.push_back({p, 0, to_local(frame, model.rest_position(p))});
    }
    return targets;
}

const SheetDesc upright_by_edge{
    .resolution = {17, 17}, .rotation_degrees = {90, 0, 0}, .pinned = [](Vec3 p) { return p.z < -0.49f; }};

// Labels: slow no-asan
TEST(Pins, follow_their_offsets_and_take_the_cloth_along) {
    for (const unsigned workers : {0u, 2u}) {
        World world = make_world({.solver = {.substeps = 20}}, {.workers = workers});
        const auto model = make_sheet(upright_by_edge);
        world.add(model, target_all(*model, {.offsets = {{0, {}}, {1, {0, 0.5f, 0.3f}}}}, {}));
        run(world, 0.5);
        const ClothFrame& cloth = world.frame().cloths[0];
        for (std::uint32_t p = 0; p < 17; ++p) {
            const Vec3 from = model->rest_position(p);
            EXPECT_LT(length(cloth.positions[p].xyz() - from - Vec3{0, 0.25f, 0.15f}), 1e-6f);
            EXPECT_LT(length(cloth.velocities[p].xyz() - Vec3{0, 0.5f, 0.3f}), 1e-2f) << "they know how fast they go";
        }
        run(world, 3.5);
        EXPECT_NEAR(center_of_mass(world.frame().cloths[0]).y, 0.5, 0.02);
        for (std::uint32_t p = 0; p < 17; ++p)
            EXPECT_EQ(length(cloth.velocities[p].xyz()), 0) << "and stand at the end";
    }
}

TEST(Pins, ride_on_a_turning_collider) {
    World world = make_world({.solver = {.substeps = 20}});
    world.add(make_collider({.shape = SphereDesc{0.01f},
                             .transform = {.position = {0, 0.5f, 0}},
                             .motion = {{0, {0, 0.5f, 0}, {}}, {1, {0, 0.5f, 0}, {0, 90, 0}}}}));
    const auto model = make_sheet(upright_by_edge);
    world.add(model, target_all(*model, {.collider = world.collider_id(0)}, world.colliders()[0].pose));
    run(world, 1);
    // The upper hem lay along x through the collider's center; a quarter turn lays it along -z.
    const ClothFrame& cloth = world.frame().cloths[0];
    for (std::uint32_t p = 0; p < 17; ++p) {
        const Vec3 from = model->rest_position(p);
        EXPECT_LT(length(cloth.positions[p].xyz() - Vec3{from.z, from.y, -from.x}), 1e-5f) << p;
    }
}

double hanging_stretch(bool tethers) {
    Fabric fabric;
    fabric.stretch.inextensible = true;
    fabric.tether = {.use = tethers ? Tethers::on : Tethers::off};
    World world =
        make_world({.solver = {.substeps = 10}},
                   {.resolution = {49, 49}, .rotation_degrees = {90, 0, 0}, .fabric = fabric, .pinned = [](Vec3 p) {
                        return p.z < -0.49f && std::abs(p.x) > 0.49f;
                    }});
    run(world, 3);
    return measure_strain(world.frame()).stretch.mean;
}

// Labels: slow no-asan
TEST(Tethers, cut_what_the_solver_leaves_of_stretch) {
    const double without = hanging_stretch(false), with = hanging_stretch(true);
    EXPECT_GT(without, 0.01);
    EXPECT_LT(with, without / 3);
}

TEST(Tethers, come_by_themselves_where_cloth_cannot_stretch_and_hangs_by_few_places) {
    const auto rows = [](bool inextensible, int places, bool hierarchy) {
        Fabric fabric;
        fabric.stretch.inextensible = inextensible;
        const SheetDesc sheet{.resolution = {49, 49},
                              .fabric = fabric,
                              .layout = {.lines = true, .hierarchy = hierarchy},
                              .pinned = [places](Vec3 p) {
                                  const auto column = static_cast<int>(std::lround((p.x + 0.5f) * 48));
                                  return p.z < -0.49f && column % 2 == 0 && column / 2 < places;
                              }};
        return make_sheet(sheet)->table(ConstraintKind::tether).rows;
    };
    EXPECT_EQ(rows(true, 1, true), 49u * 49 - 1);
    EXPECT_GT(rows(true, 16, true), 0u);
    EXPECT_EQ(rows(true, 17, true), 0u) << "many places";
    EXPECT_EQ(rows(true, 0, true), 0u) << "held nowhere";
    EXPECT_EQ(rows(false, 1, true), 0u) << "cotton stretches";
    EXPECT_EQ(rows(true, 1, false), 0u) << "no coarse levels";
}

TEST(Tethers, do_not_pull_cloth_through_an_obstacle) {
    Fabric fabric;
    fabric.tether.use = Tethers::on;
    World world = make_world({.solver = {.substeps = 20}});
    world.add(make_collider({.shape = CapsuleDesc{0.15f, 1}, .transform = {.rotation_degrees = {90, 0, 0}}}));
    world.add(make_sheet({.resolution = {33, 33}, .position = {0.4f, 0.16f, 0}, .fabric = fabric, .pinned = [](Vec3 p) {
                              return p.x < -0.49f;
                          }}));
    run(world, 2);
    for (const Vec4& p : world.frame().cloths[0].positions) {
        EXPECT_GT(signed_distance(world.colliders()[0], p.xyz()), p.w > 0 ? 0.001 - 1e-5 : -1.0);
    }
}

}  // namespace
}  // namespace weft::physical
