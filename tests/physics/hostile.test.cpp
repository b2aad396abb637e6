// Input that no cloth could follow: the result is finite, the report says what happened.

#include "sheet.h"

#include <limits>

namespace weft::physical {
namespace {

class Hostile : public testing::Test {
  protected:
    void step_and_check(World& world, double dt, int frames = 20) {
        for (int i = 0; i < frames; ++i) {
            reports |= world.step(dt).reports;
            ASSERT_TRUE(all_finite(world.frame())) << "frame " << i;
            for (const Vec4& n : world.frame().cloths[0].normals) ASSERT_TRUE(finite(n.xyz()));
        }
    }
    std::uint32_t reports = 0;
};

const SheetDesc hung{.pinned = [](Vec3 p) { return p.z < -0.49f; }};

TEST_F(Hostile, absurd_time_steps) {
    for (const double dt : {1e-9, 1e-3, 1.0, 10.0, 1e6}) {
        World world = make_world({.substeps = 20}, hung);
        world.add(make_collider({.name = "ball", .shape = SphereDesc{0.3f}, .transform = {}}));
        step_and_check(world, dt);
    }
}

TEST_F(Hostile, enormous_gravity) {
    World world = make_world({.gravity = {0, -1e6f, 0}}, hung);
    step_and_check(world, 1.0 / 60);
    EXPECT_TRUE(reports & report_speed_capped);
}

TEST_F(Hostile, gravity_that_is_no_number_is_caught_and_named) {
    for (const float g : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        World world = make_world({.gravity = {0, g, 0}}, hung);
        const auto before = world.state_hash();
        step_and_check(world, 1.0 / 60, 3);
        EXPECT_TRUE(reports & report_non_finite);
        EXPECT_EQ(world.state_hash(), before) << "the cloth is where it was";
        EXPECT_EQ(world.frame().cloths[0].detail, "gravity is not finite");
    }
}

TEST_F(Hostile, a_collider_that_is_no_number_is_named) {
    World world = make_world({}, hung);
    world.add(make_collider({.name = "ghost", .shape = SphereDesc{std::numeric_limits<float>::quiet_NaN()}}));
    Collider lost = make_collider({.name = "lost", .shape = SphereDesc{0.1f}});
    lost.pose.position.x = std::numeric_limits<float>::quiet_NaN();
    world.add(lost);
    step_and_check(world, 1.0 / 60, 3);
}

TEST_F(Hostile, everything_pinned_and_nothing_pinned) {
    World all = make_world({}, {.pinned = [](Vec3) { return true; }});
    const auto before = all.state_hash();
    step_and_check(all, 1.0 / 60);
    EXPECT_EQ(all.state_hash(), before);
    World nothing = make_world({}, {.fabric = {}});
    step_and_check(nothing, 1.0 / 60);
}

TEST_F(Hostile, extreme_fabrics) {
    for (const float density : {1e-6f, 1e4f}) {
        for (const float stiffness : {0.0f, 1e-6f, 1e9f}) {
            Fabric fabric;
            fabric.body.density = density;
            fabric.stretch = {.stretch = {stiffness, stiffness}, .compression = {stiffness, 0}, .shear = stiffness};
            fabric.bend = {.bend = {stiffness, 0, stiffness}};
            World world = make_world({}, {.fabric = fabric, .pinned = hung.pinned});
            world.add(
                make_collider({.name = "ball", .shape = SphereDesc{0.3f}, .transform = {.position = {0, -0.1f, 0}}}));
            step_and_check(world, 1.0 / 60);
        }
    }
}

TEST(Model, refuses_values_that_no_simulation_could_follow) {
    const TriangleMesh mesh = make_grid({1, 1}, {3, 3}, GridDiagonal::uniform);
    for (const float density : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN(), 1e-44f}) {
        ClothModelDesc desc{.name = "x", .mesh = mesh};
        desc.fabric.body.density = density;
        EXPECT_FALSE(build_cloth_model(desc, *build_topology(mesh)).ok()) << density;
    }
    ClothModelDesc desc{.name = "x", .mesh = mesh, .fabric = {}, .pins = {.particles = {9}}};
    EXPECT_FALSE(build_cloth_model(desc, *build_topology(mesh)).ok());
}

}  // namespace
}  // namespace weft::physical
