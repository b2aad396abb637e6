// Spheres that stick to the nearest points of a falling sheet. The points are searched in every frame.

#include "sheet.h"

#include <cmath>
#include <limits>

namespace weft::physical {
namespace {

constexpr float radius = 0.06f, reach = 0.01f;

Collider sticky(Vec3 position, float compliance = 0) {
    Collider sphere =
        make_collider({.name = "sphere", .shape = SphereDesc{radius}, .transform = {.position = position}});
    sphere.adhesion = Adhesion{reach, compliance};
    return sphere;
}

struct Fall {
    World world;
    std::vector<ColliderId> spheres;
};

// A sheet of a meter that falls flat onto nine spheres.
Fall make_fall(World world, float compliance = 0, std::uint32_t side = 33) {
    Fall fall{std::move(world), {}};
    for (int i = 0; i < 9; ++i) {
        const float x = 0.3f * static_cast<float>(i % 3 - 1), z = 0.3f * static_cast<float>(i / 3 - 1);
        fall.spheres.push_back(fall.world.add(sticky({x, 0, z}, compliance)));
    }
    fall.world.add(make_sheet({.resolution = {side, side}, .position = {0.013f, radius + 0.05f, 0.007f}}));
    return fall;
}

// The constraints that the next frame must find, from distances in double precision.
std::uint64_t expected_rows(const World& world) {
    std::uint64_t rows = 0;
    for (const ClothFrame& cloth : world.frame().cloths) {
        const double half = 0.5 * cloth.model->fabric.contact.thickness;
        for (const Vec4& p : cloth.positions) {
            if (!(p.w > 0)) continue;
            for (const Collider& collider : world.colliders())
                rows += collider.adhesion && signed_distance(collider, p.xyz()) - half < collider.adhesion->distance;
        }
    }
    return rows;
}

// Labels on Vulkan: long
TEST(Adhesion, finds_the_nearest_points_anew_in_every_frame) {
    Fall fall = make_fall(make_world({.solver = {.substeps = 10}}), 1.0f);
    std::uint64_t most = 0;
    for (int i = 0; i < 40; ++i) {
        const std::uint64_t expected = expected_rows(fall.world);
        fall.world.step(1.0 / 60);
        EXPECT_EQ(fall.world.frame().lists.rows, expected) << "frame " << i;
        most = std::max(most, expected);
    }
    EXPECT_GT(most, 20u);
    EXPECT_EQ(fall.world.frame().reports, report_none);
}

// Labels on Vulkan: no-asan long
TEST(Adhesion, carries_the_sheet_along_with_the_spheres) {
    Fall fall = make_fall(make_world({.solver = {.substeps = 10}}));
    run(fall.world, 0.4);
    const Vec3 before = center_of_mass(fall.world.frame().cloths[0]);
    for (int i = 1; i <= 30; ++i) {
        for (std::size_t s = 0; s < fall.spheres.size(); ++s) {
            Pose pose = fall.world.collider(fall.spheres[s]).pose;
            pose.position += Vec3{0.01f, 0.005f, 0};
            fall.world.move(fall.spheres[s], pose);
        }
        fall.world.step(1.0 / 60);
        ASSERT_GT(fall.world.frame().lists.rows, 0u);
    }
    const Vec3 after = center_of_mass(fall.world.frame().cloths[0]);
    EXPECT_NEAR(after.x - before.x, 0.3f, 0.03f);
    EXPECT_NEAR(after.y - before.y, 0.15f, 0.03f);
}

// Labels on Vulkan: no-asan long
TEST(Adhesion, holds_a_sheet_from_above_and_soft_springs_let_it_go) {
    for (const float compliance : {0.0f, 1.0f}) {
        World world = make_world({.solver = {.substeps = 10}});
        for (const float x : {-0.3f, 0.3f})
            for (const float z : {-0.3f, 0.3f}) world.add(sticky({x, radius + 0.002f, z}, compliance));
        world.add(make_sheet({.resolution = {33, 33}}));
        run(world, 0.75);
        const float y = center_of_mass(world.frame().cloths[0]).y;
        if (compliance == 0) {
            EXPECT_GT(y, -0.3f);
            EXPECT_GT(world.frame().lists.rows, 4u);
        } else {
            EXPECT_LT(y, -1.0f);
            EXPECT_EQ(world.frame().lists.rows, 0u);
        }
    }
}

TEST(Adhesion, leaves_pinned_particles_alone) {
    World world = make_world({.solver = {.substeps = 5}});
    world.add(sticky({0, radius, 0}));
    SheetDesc sheet{.resolution = {17, 17}};
    sheet.pinned = [](Vec3) { return true; };
    world.add(make_sheet(sheet));
    world.step(1.0 / 60);
    EXPECT_EQ(world.frame().lists.rows, 0u);
}

// A full list costs time, but loses no constraint and changes no bit of the result.
// Labels on Vulkan: no-asan long
TEST(Adhesion, has_the_same_bits_however_long_the_list_is) {
    std::string expected;
    for (const Projection projection : {Projection::automatic, Projection::jacobi}) {
        std::string of_projection;
        for (const std::uint32_t capacity : {1u, 2'000u}) {
            const ClothLayout layout{.lines = projection == Projection::automatic, .hierarchy = true};
            World world =
                make_world({.solver = {.substeps = 5, .iterations = 2, .projection = projection, .hierarchy = true},
                            .list_capacity = capacity});
            Fall fall = make_fall(std::move(world), 0, 25);
            fall.world.add(make_sheet({.resolution = {25, 25}, .position = {0, 0.2f, 0}, .layout = layout}));
            std::uint64_t repeats = 0;
            for (int i = 0; i < 12; ++i) {  // until both have met the spheres
                fall.world.step(1.0 / 60);
                repeats += fall.world.frame().lists.repeats;
            }
            EXPECT_EQ(repeats > 0, capacity == 1);
            EXPECT_LE(fall.world.frame().lists.rows, fall.world.frame().lists.capacity);
            const std::string hash = fall.world.state_hash();
            if (of_projection.empty()) of_projection = hash;
            EXPECT_EQ(hash, of_projection) << capacity;
        }
        EXPECT_NE(of_projection, expected);
        expected = of_projection;
    }
}

// Labels on Vulkan: long
TEST(Adhesion, goes_on_with_the_same_bits_after_a_restore) {
    const auto begin = [] { return make_fall(make_world({.solver = {.substeps = 5}, .list_capacity = 1})); };
    Fall fall = begin();
    run(fall.world, 0.3);
    const Snapshot snapshot = fall.world.save();
    run(fall.world, 0.3);
    Fall other = begin();
    ASSERT_TRUE(other.world.restore(snapshot).ok());
    run(other.world, 0.3);
    EXPECT_EQ(other.world.state_hash(), fall.world.state_hash());
}

// Labels on Vulkan: no-asan long
TEST(Adhesion, of_two_cloths_in_an_island_is_that_of_each) {
    std::uint64_t rows[2] = {};
    for (const bool tied : {false, true}) {
        Fall fall = make_fall(make_world({.solver = {.substeps = 5}}), 0, 25);
        SheetDesc far_away{.resolution = {9, 9}, .position = {10, 0, 0}};
        const ClothId second = fall.world.add(make_sheet(far_away));
        // A spring so soft that it does nothing.
        if (tied)
            fall.world.add(
                {Stitch{fall.world.cloth_id(0), second, {.particles = {0, 0, 0}}, {.particles = {0, 0, 0}}, 0, 1e12f}});
        run(fall.world, 0.25);
        rows[tied] = fall.world.frame().lists.rows;
    }
    EXPECT_GT(rows[0], 0u);
    EXPECT_EQ(rows[1], rows[0]);
}

// Labels on Vulkan: long
TEST(Adhesion, with_a_frame_that_is_not_finite_goes_back_to_where_it_began) {
    Fall fall = make_fall(make_world({.solver = {.substeps = 5}, .list_capacity = 1}));
    run(fall.world, 0.3);
    const std::string before = fall.world.state_hash();
    Pose nowhere = fall.world.collider(fall.spheres[4]).pose;
    const Pose there = nowhere;
    nowhere.position.x = std::numeric_limits<float>::quiet_NaN();
    fall.world.move(fall.spheres[4], nowhere);
    fall.world.step(1.0 / 60);
    EXPECT_TRUE(fall.world.frame().reports & report_non_finite);
    EXPECT_EQ(fall.world.state_hash(), before);
    fall.world.move(fall.spheres[4], there);
}

#ifdef WEFT_VULKAN
// Labels: slow no-asan long
TEST(Adhesion, is_the_same_on_both_backends) {
    Fall cpu = make_fall(make_world({.solver = {.substeps = 5, .iterations = 2}, .list_capacity = 1}, CpuOptions{}));
    for (const char* execution : {"streamed", "grouped", "fused"}) {
        if (std::string_view(execution) != "streamed" && !std::getenv("WEFT_LONG_TESTS")) continue;
        Fall device = make_fall(World(checked_vulkan_backend({.execution = execution}),
                                      {.solver = {.substeps = 5, .iterations = 2}, .list_capacity = 1}));
        if (device.world.backend().device().find("llvmpipe") == std::string::npos)
            GTEST_SKIP() << "equal bits are promised where a device rounds divisions and roots as IEEE 754 says";
        if (cpu.world.index() == 0) run(cpu.world, 0.3);
        run(device.world, 0.3);
        EXPECT_EQ(device.world.state_hash(), cpu.world.state_hash()) << execution;
        EXPECT_EQ(device.world.frame().lists.rows, cpu.world.frame().lists.rows);
    }
}
#endif

}  // namespace
}  // namespace weft::physical
