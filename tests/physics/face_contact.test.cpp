// Colliders against the triangles of cloth: the nearest point of a triangle, tips between particles, and what moves
// fast.

#include "sheet.h"

#include "physics/testing.h"
#include "solver/measures/passages.h"
#include "solver/measures/penetration.h"
#include "solver/world/collider_solid.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace weft::physical {
namespace {

double least_by_sampling(const reference::Solid& solid, const reference::Corners& x) {
    constexpr int parts = 60;
    double least = 1e9;
    for (int i = 0; i <= parts; ++i) {
        for (int j = 0; i + j <= parts; ++j) {
            const double u = double(i) / parts, v = double(j) / parts;
            least = std::min(least, face_point(solid, x, reference::vec3(u, v, 1 - u - v)).distance);
        }
    }
    return least;
}

// Triangles of any size, in and around the shape: how much nearer than what is found another point is, in longest
// edges.
TEST(LeastOnFace, is_found_on_all_shapes) {
    const ColliderDesc shapes[] = {{.shape = PlaneDesc{}},
                                   {.shape = SphereDesc{0.1f}},
                                   {.shape = CapsuleDesc{0.03f, 0.1f}},
                                   {.shape = TaperedCapsuleDesc{{0.06f, 0.01f}, 0.1f}},
                                   {.shape = BoxDesc{{0.1f, 0.03f, 0.06f}}},
                                   {.shape = TaperedCapsuleDesc{{0.001f, 0.02f}, 0.1f}},
                                   {.shape = BoxDesc{{0.1f, 0.002f, 0.06f}}}};
    for (const ColliderDesc& desc : shapes) {
        const reference::Solid solid = solid_of(make_collider(desc));
        testing_kernels::Random random(7);
        std::vector<double> misses;
        for (int i = 0; i < 2000; ++i) {
            const double size = std::pow(10.0, random.number(-2.5, -0.5));
            const reference::vec3 at = random.vector(0.15);
            const reference::Corners x{at + random.vector(size), at + random.vector(size), at + random.vector(size)};
            const auto center = face_point(solid, x, reference::center_weights());
            const auto found = least_on_face(solid, x, center, 1e9);
            const double longest = longest_of(x.b - x.a, x.c - x.b, x.a - x.c);
            misses.push_back((found.distance - least_by_sampling(solid, x)) / longest);
            // It is a point of the triangle.
            EXPECT_GE(std::min({found.weights.x, found.weights.y, found.weights.z}), -1e-9);
            EXPECT_NEAR(found.weights.x + found.weights.y + found.weights.z, 1, 1e-9);
        }
        std::sort(misses.begin(), misses.end());
        EXPECT_LT(misses[1980], 0.0005) << "99 of 100, shape " << solid.kind;
        EXPECT_LT(misses.back(), 0.003) << "shape " << solid.kind;
    }
}

// The least distance on the border of this triangle leads to the rod's end, which is through its middle. The search
// from there begins along the border.
TEST(LeastOnFace, leaves_the_border_for_the_end_of_a_rod) {
    const reference::Solid rod = solid_of(make_collider({.shape = CapsuleDesc{0.002f, 0.10546344f}}));
    const reference::Corners x{{-0.0186055079, -0.113847375, -0.0338912606},
                               {0.00570610957, -0.110174753, 0.0110635543},
                               {0.00483530387, -0.0597463623, 0.0162095651}};
    const auto found = least_on_face(rod, x, face_point(rod, x, reference::center_weights()), 0.007);
    EXPECT_LT(found.distance, least_by_sampling(rod, x) + 2e-5);
    EXPECT_LT(found.distance, -0.0013);
}

bool on_rim(Vec3 p) {
    return std::abs(p.x) > 0.499f || std::abs(p.z) > 0.499f;
}

// 3 cm wide, 60 m/s, from above.
Collider shot(float x, float z) {
    return make_collider({.shape = SphereDesc{0.015f},
                          .motion = {{0, {x, 0.2f, z}, {}}, {0.005f, {x, -0.1f, z}, {}}, {1, {x, -0.1f, z}, {}}}});
}

struct Watched {
    double deepest = 0;  ///< m, at the end of any frame
    Passages passages;
};
Watched watch(World& world, int frames, double seconds = 1.0 / 60) {
    Watched found;
    PassageWatch passages;
    PenetrationSearch penetration;
    passages.add(world.frame(), world.colliders());
    for (int i = 0; i < frames; ++i) {
        world.step(seconds);
        passages.add(world.frame(), world.colliders());
        found.deepest = std::max(found.deepest, double{penetration.measure(world.frame(), world.colliders()).max});
    }
    found.passages = passages.passages();
    return found;
}

TEST(FaceContact, stops_a_shot_wherever_it_hits) {
    for (const std::uint32_t side : {21u, 64u}) {
        for (const auto& [x, z] : {std::pair(0.0f, 0.0f), {0.013f, 0.007f}, {0.025f, 0.0f}, {0.0205f, -0.0091f}}) {
            World world = make_world({.solver = {.substeps = 20}});
            world.add(shot(x, z));
            world.add(make_sheet({.resolution = {side, side}, .layout = world.settings().layout(), .pinned = on_rim}));
            const Watched found = watch(world, 4);
            EXPECT_EQ(found.passages.count, 0u) << side << ", " << x << ", " << z;
            EXPECT_LT(found.deepest, 1e-3) << side << ", " << x << ", " << z;
        }
    }
}

// 1 cm thick, turns 20 times a second across the sheet.
ColliderDesc fan_blade() {
    ColliderDesc fan{.shape = BoxDesc{{0.4f, 0.005f, 0.06f}}};
    for (int quarter = 0; quarter <= 12; ++quarter) {
        const auto number = static_cast<float>(quarter);
        fan.motion.push_back({0.0125f * number, {0, 0.25f, 0}, {0, 0, 90 * number}});
    }
    return fan;
}

TEST(FaceContact, keeps_a_sheet_on_its_side_of_the_blade_of_a_fan) {
    // Frames are as long as a substep, because in longer ones the straight way between two frames may pass where the
    // cloth did not.
    World world = make_world({.solver = {.substeps = 1}});
    world.add(make_collider(fan_blade()));
    world.add(make_sheet(
        {.resolution = {21, 21}, .layout = world.settings().layout(), .pinned = [](Vec3 p) { return p.z < -0.499f; }}));
    const Watched found = watch(world, 180, 1.0 / 1200);
    EXPECT_EQ(found.passages.points, 0u);
    EXPECT_LT(found.deepest, 1e-4);
}

// 2 mm thick, 40 m/s, from above. The cloth bends around it until its faces lie along its way.
ColliderDesc swung_rod(float tilt, float half_height) {
    const Vec3 rotation{0, 0, 90 - tilt};
    return {.shape = CapsuleDesc{0.001f, half_height},
            .motion = {{0, {0, 0.3f, 0}, rotation}, {0.015f, {0, -0.3f, 0}, rotation}, {1, {0, -0.3f, 0}, rotation}}};
}

TEST(FaceContact, keeps_a_sheet_on_its_side_of_a_swung_rod) {
    for (const float tilt : {0.0f, 15.0f}) {
        for (const bool along : {true, false}) {
            World world = make_world({.solver = {.substeps = 1}});
            world.add(make_collider(swung_rod(tilt, along ? 0.8f : 0.3f)));
            world.add(make_sheet({.resolution = {21, 21},
                                  .layout = world.settings().layout(),
                                  .pinned = [along](Vec3 p) { return std::abs(along ? p.z : p.x) > 0.499f; }}));
            const Watched found = watch(world, 60, 1.0 / 1200);
            EXPECT_EQ(found.passages.points, 0u) << tilt << (along ? ", pinned along it" : ", pinned across it");
        }
    }
}

// Its triangles are stretched to several times their length, and meet the rod farther from their particles than they
// could at rest.
TEST(FaceContact, keeps_a_fine_sheet_on_its_side_of_a_swung_rod) {
    World world = make_world({.solver = {.substeps = 1}});
    world.add(make_collider(swung_rod(0, 0.8f)));
    world.add(make_sheet({.resolution = {64, 64}, .layout = world.settings().layout(), .pinned = [](Vec3 p) {
                              return std::abs(p.z) > 0.499f;
                          }}));
    const Watched found = watch(world, 60, 1.0 / 1200);
    EXPECT_EQ(found.passages.points, 0u);
    EXPECT_GT(measure_strain(world.frame()).stretch.max, 1);
}

// By its own weight on what fits between its particles, 5 cm apart.
TEST(FaceContact, holds_tips_between_particles) {
    const ColliderDesc blunt{.shape = TaperedCapsuleDesc{{0.05f, 0.001f}, 0.1f},
                             .transform = {.position = {0, -0.101f, 0}}};
    const std::pair<const char*, ColliderDesc> tips[] = {
        {"ball", {.shape = SphereDesc{0.005f}}},
        {"corner of a box",
         {.shape = BoxDesc{{0.1f, 0.1f, 0.1f}},
          .transform = {.position = {0, -0.1732f, 0}, .rotation_degrees = {45, 0, 35.2644f}}}},
        {"needle", {.shape = CapsuleDesc{0.0025f, 0.1f}, .transform = {.position = {0, -0.1025f, 0}}}},
        {"blunt tip", blunt},
    };
    for (const auto& [name, desc] : tips) {
        for (const auto& [x, z] : {std::pair(0.0f, 0.0f), {0.025f, 0.0f}, {0.017f, 0.011f}}) {
            World world = make_world({.solver = {.substeps = 20}});
            world.add(make_collider(desc));
            world.add(make_sheet({.size = {0.5f, 0.5f},
                                  .resolution = {11, 11},
                                  .position = {x, 0.008f, z},
                                  .layout = world.settings().layout()}));
            const Watched found = watch(world, 20);
            // Around a tip under a particle, the sheet hangs down on all sides, and its faces push one another.
            const bool under_a_particle = desc.shape.index() == blunt.shape.index() && x == 0 && z == 0;
            EXPECT_LE(found.passages.count, under_a_particle ? 2u : 0u) << name << ", " << x << ", " << z;
            EXPECT_LT(found.deepest, under_a_particle ? 1.5e-3 : 1e-3) << name << ", " << x << ", " << z;
            EXPECT_LT(measure_strain(world.frame()).stretch.max, 0.2) << name << ", " << x << ", " << z;
        }
    }
}

// Corners of triangles on the far side of a tip are behind the plane in which it touches. They stay there.
TEST(FaceContact, on_a_tip_does_not_tear_the_sheet_about) {
    const std::pair<ColliderDesc, double> tips[] = {
        {{.shape = BoxDesc{{0.1f, 0.1f, 0.1f}},
          .transform = {.position = {0, 0.0268f, 0}, .rotation_degrees = {45, 0, 35.2644f}}},
         1e-3},
        {{.shape = TaperedCapsuleDesc{{0.1f, 0.0005f}, 0.1f}, .transform = {.position = {0, 0.0995f, 0}}}, 2e-3}};
    for (const auto& [desc, deepest] : tips) {
        for (const auto& [x, z] : {std::pair(0.0f, 0.0f), {0.025f, 0.0f}, {0.017f, 0.011f}}) {
            World world = make_world({.solver = {.substeps = 20}});
            world.add(make_collider(desc));
            world.add(
                make_sheet({.resolution = {21, 21}, .position = {x, 0.25f, z}, .layout = world.settings().layout()}));
            PenetrationSearch penetration;
            for (int frame = 0; frame < 40; ++frame) {
                world.step(1.0 / 60);
                const Strain strain = measure_strain(world.frame());
                EXPECT_LT(std::max(strain.stretch.max, strain.shear.max), 0.2) << frame << ", " << x << ", " << z;
                EXPECT_LT(penetration.measure(world.frame(), world.colliders()).max, deepest)
                    << frame << ", " << x << ", " << z;
            }
        }
    }
}

// A sheet over the corner of a box, which a shot hits.
void add_corner_and_shot(World& world) {
    world.add(make_collider({.shape = BoxDesc{{0.1f, 0.1f, 0.1f}},
                             .transform = {.position = {0, -0.1732f, 0}, .rotation_degrees = {45, 0, 35.2644f}}}));
    world.add(shot(0.2f, 0.1f));
    world.add(make_sheet({.resolution = {60, 60}, .position = {0, 0.004f, 0}, .layout = world.settings().layout()}));
}

TEST(FaceContact, has_the_same_bits_on_any_number_of_threads) {
    std::string expected;
    for (const unsigned workers : {0u, 1u, 2u, 4u}) {
        World world = make_world({.solver = {.substeps = 10}}, {.workers = workers});
        add_corner_and_shot(world);
        for (int i = 0; i < 8; ++i) world.step(1.0 / 60);
        if (workers == 0) expected = world.state_hash();
        EXPECT_EQ(world.state_hash(), expected) << workers;
    }
}

// Labels on Vulkan: long
TEST(FaceContact, goes_on_from_a_saved_state) {
    World world = make_world({.solver = {.substeps = 10}});
    add_corner_and_shot(world);
    for (int i = 0; i < 4; ++i) world.step(1.0 / 60);
    const Snapshot snapshot = world.save();
    for (int i = 0; i < 4; ++i) world.step(1.0 / 60);
    const std::string expected = world.state_hash();
    ASSERT_TRUE(world.restore(snapshot).ok());
    for (int i = 0; i < 4; ++i) world.step(1.0 / 60);
    EXPECT_EQ(world.state_hash(), expected);
}

}  // namespace
}  // namespace weft::physical
