// Mesh colliders as surfaces: cloth with exact contact never passes through their triangles.

#include "files/surface_crossings.test.h"
#include "mesh/procedural.h"
#include "solver/measures/statistics.h"
#include "weft/scene_world.h"

#include <weft/weft.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace weft {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

// A square of two triangles in the plane y = 0.
TriangleMesh plate_mesh(float size) {
    return make_grid({size, size}, {2, 2}, GridDiagonal::uniform);
}

// The lower half of a sphere, open at the top.
TriangleMesh half_shell(float radius) {
    TriangleMesh mesh = make_sphere(radius, 3);
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        return mesh.positions[t[0]].y + mesh.positions[t[1]].y + mesh.positions[t[2]].y > 0;
    });
    return mesh;
}

// A cone on a disk: `sides` triangles that meet in the tip at the origin.
TriangleMesh spike(float radius, float height, std::uint32_t sides = 5) {
    TriangleMesh mesh;
    mesh.positions.push_back({0, 0, 0});
    for (std::uint32_t i = 0; i < sides; ++i) {
        const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(sides);
        mesh.positions.push_back({radius * std::cos(angle), -height, radius * std::sin(angle)});
    }
    for (std::uint32_t i = 0; i < sides; ++i) mesh.triangles.push_back({0, 1 + (i + 1) % sides, 1 + i});
    return mesh;
}

ColliderDesc surface_collider(TriangleMesh mesh, TransformDesc transform = {}) {
    return {.name = "surface",
            .shape = SolidMeshDesc{.mesh = std::move(mesh), .resolution = 16, .contact = MeshContact::surface},
            .transform = transform};
}

SceneCloth exact_sheet(float size, std::uint32_t side, TransformDesc transform, Vec3 velocity = {}) {
    SceneCloth sheet;
    sheet.mesh = GridDesc{.size = {size, size}, .resolution = {side, side}};
    sheet.transform = transform;
    sheet.velocity = velocity;
    sheet.self_collision = SelfCollision::exact;
    return sheet;
}

SceneDesc scene_of(SceneCloth sheet, ColliderDesc collider) {
    SceneDesc scene;
    scene.cloths.push_back(std::move(sheet));
    scene.colliders.push_back(std::move(collider));
    return scene;
}

SceneWorld made(const SceneDesc& scene, unsigned threads = 1, const std::string& backend = "cpu") {
    auto world = SceneWorld::create(scene, {.backend = backend, .threads = threads});
    EXPECT_TRUE(world.ok()) << world.error().message();
    return std::move(*world);
}

// Frames in which the cloth crosses the collider or is reported as tangled.
int frames_crossed(SceneWorld& world, int frames) {
    int crossed = 0;
    for (int i = 0; i < frames; ++i) {
        const Frame& frame = world.step();
        crossed += crossings_with_colliders(world.world()) > 0 || frame.cloth_contacts.tangled > 0;
        EXPECT_EQ(frame.reports & report_non_finite, 0u);
    }
    return crossed;
}

// Labels: slow no-asan
TEST(SurfaceColliders, stop_a_sheet_thrown_at_a_plate_flat_and_edge_on) {
    std::mt19937 random(7);
    const auto angle = [&] { return static_cast<float>(random() % 360); };
    for (const float speed : {20.0f, 50.0f}) {
        for (const std::uint32_t substeps : {10u, 20u}) {
            for (const bool edge_on : {false, true}) {
                const Vec3 rotation{edge_on ? 90.0f : static_cast<float>(random() % 20), angle(), 0};
                const TriangleMesh plate = substeps == 10 ? plate_mesh(1) : make_box({1, 0.002f, 1}, {2, 2, 2});
                SceneDesc scene = scene_of(
                    exact_sheet(0.5f, 24, {.position = {0, 0.6f, 0}, .rotation_degrees = rotation}, {0, -speed, 0}),
                    surface_collider(plate, {.rotation_degrees = {0, angle(), 0}}));
                scene.solver.substeps = substeps;
                SceneWorld world = made(scene);
                EXPECT_EQ(frames_crossed(world, 30), 0) << speed << " m/s, edge on: " << edge_on;
                float lowest = 1;
                for (const Vec4& x : world.world().frame().cloths[0].positions)
                    if (std::abs(x.x) + std::abs(x.z) < 0.5f) lowest = std::min(lowest, x.y);
                EXPECT_GT(lowest, 0) << speed << " m/s: nothing is below the plate";
            }
        }
    }
}

// Labels: no-asan
TEST(SurfaceColliders, hold_from_both_sides) {
    for (const float from : {1.0f, -1.0f}) {
        SceneDesc scene = scene_of(exact_sheet(0.5f, 20, {.position = {0, 0.05f * from, 0}}, {0, -3 * from, 0}),
                                   surface_collider(plate_mesh(1)));
        scene.gravity = {0, -9.81f * from, 0};
        SceneWorld world = made(scene);
        EXPECT_EQ(frames_crossed(world, 40), 0);
        for (const Vec4& x : world.world().frame().cloths[0].positions) {
            EXPECT_GT(x.y * from, 0);
            EXPECT_LT(x.y * from, 0.0015f) << "at half of its thickness";
        }
    }
}

TEST(SurfaceColliders, keep_half_of_the_thickness_of_the_cloth) {
    SceneDesc scene = scene_of(exact_sheet(0.4f, 16, {.position = {0, 0.01f, 0}}), surface_collider(plate_mesh(1)));
    SceneWorld world = made(scene);
    for (int i = 0; i < 60; ++i) world.step();
    double sum = 0;
    const auto positions = world.world().frame().cloths[0].positions;
    for (const Vec4& x : positions) sum += static_cast<double>(x.y);
    EXPECT_NEAR(sum / static_cast<double>(positions.size()), 0.001, 0.0001) << "the sheet is 2 mm thick";
}

// Labels: no-asan
TEST(SurfaceColliders, hold_on_thin_plates_shells_and_needles) {
    const struct {
        const char* name;
        TriangleMesh mesh;
        Vec3 rotation;
    } cases[] = {
        {"box of 2 mm", make_box({0.3f, 0.002f, 0.3f}, {2, 2, 2}), {20, 30, 0}},
        {"box of 2 mm on edge", make_box({0.3f, 0.002f, 0.3f}, {2, 2, 2}), {90, 0, 0}},
        {"half shell", half_shell(0.2f), {}},
        {"half shell upside down", half_shell(0.2f), {180, 0, 0}},
        {"half shell on its rim", half_shell(0.2f), {90, 0, 0}},
        {"spike", spike(0.02f, 0.3f), {}},
        {"needle", spike(0.002f, 0.3f, 3), {3, 0, 0}},
        {"corner", make_box({0.2f, 0.2f, 0.2f}, {2, 2, 2}), {45, 0, 35}},
    };
    for (const auto& [name, mesh, rotation] : cases) {
        for (const std::uint32_t side : {9u, 25u}) {
            SceneWorld world = made(
                scene_of(exact_sheet(0.5f, side, {.position = {0.013f, 0.25f, 0.007f}, .rotation_degrees = {0, 17, 0}}),
                         surface_collider(mesh, {.rotation_degrees = rotation})));
            EXPECT_EQ(frames_crossed(world, 60), 0) << name << ", " << side;
        }
    }
}

// Labels: no-asan
TEST(SurfaceColliders, that_turn_carry_cloth_along) {
    ColliderDesc turning = surface_collider(half_shell(0.2f), {});
    turning.friction = {1, 1};
    turning.motion = {{.time = 0, .rotation_degrees = {180, 0, 0}},
                      {.time = 1, .rotation_degrees = {180, 0, 0}},
                      {.time = 2, .rotation_degrees = {180, 90, 0}}};
    SceneCloth sheet = exact_sheet(0.5f, 25, {.position = {0, 0.21f, 0}});
    sheet.fabric.contact.friction[0] = sheet.fabric.contact.friction[1] = 1;
    SceneWorld world = made(scene_of(sheet, turning));
    EXPECT_EQ(frames_crossed(world, 60), 0);
    const auto corner = [&] { return world.world().frame().cloths[0].positions[0].xyz(); };
    const Vec3 before = corner();
    EXPECT_EQ(frames_crossed(world, 90), 0);
    const Vec3 after = corner();
    const float turned = std::atan2(before.z * after.x - before.x * after.z, before.x * after.x + before.z * after.z);
    EXPECT_NEAR(std::abs(turned) * 180 / std::numbers::pi_v<float>, 90, 8);
}

// Labels: no-asan
TEST(SurfaceColliders, that_move_take_cloth_with_them_and_stop) {
    SceneWorld world =
        made(scene_of(exact_sheet(0.4f, 16, {.position = {0, 0.01f, 0}}), surface_collider(plate_mesh(1))));
    EXPECT_EQ(frames_crossed(world, 10), 0);
    const ColliderId id = world.world().collider_id(0);
    for (int i = 1; i <= 20; ++i) {
        world.move(id, {0, 0.05f * static_cast<float>(i), 0}, {static_cast<float>(i), 0, 0});
        EXPECT_EQ(frames_crossed(world, 1), 0) << i;
    }
    EXPECT_EQ(frames_crossed(world, 5), 0);
    world.remove(id);
    for (int i = 0; i < 60; ++i) world.step();
    EXPECT_LT(world.world().frame().cloths[0].positions[40].y, -1) << "it falls without the collider";
    ASSERT_TRUE(world.add(surface_collider(plate_mesh(20), {.position = {0, -30, 0}})).ok());
    EXPECT_EQ(frames_crossed(world, 180), 0);
    EXPECT_GT(world.world().frame().cloths[0].positions[40].y, -30);
}

// A plate that hits a sheet at rest: by its face, or by its edge.
SceneDesc hit_scene(float speed, bool edge_on, float turn = 0) {
    ColliderDesc plate = surface_collider(plate_mesh(0.3f));
    const float tilt = edge_on ? 80.0f : 5.0f;
    plate.motion = {
        {.time = 0, .position = {0, -0.5f, 0}, .rotation_degrees = {tilt, 20, 0}},
        {.time = 1.5f / speed, .position = {0, 1, 0}, .rotation_degrees = {tilt + turn, 20, 0}},
    };
    return scene_of(exact_sheet(0.5f, 25, {.position = {0, 0, 0}}), plate);
}

// Labels: slow no-asan long
TEST(SurfaceColliders, that_move_fast_carry_cloth_along) {
    for (const float speed : {2.0f, 10.0f, 20.0f, 40.0f}) {
        for (const bool edge_on : {false, true}) {
            SceneWorld world = made(hit_scene(speed, edge_on));
            EXPECT_EQ(frames_crossed(world, 30), 0) << speed << " m/s, edge on: " << edge_on;
            double highest = -10;
            for (const Vec4& x : world.world().frame().cloths[0].positions)
                highest = std::max(highest, static_cast<double>(x.y));
            EXPECT_GT(highest, edge_on ? -10 : 0.2) << "it was hit";
        }
    }
}

// Labels: no-asan
TEST(SurfaceColliders, that_jump_within_a_frame_carry_cloth_along) {
    SceneDesc scene = scene_of(exact_sheet(0.5f, 14, {.position = {0.02f, 0.3f, 0}}, {0, -2, 0}),
                               surface_collider(half_shell(0.2f), {.rotation_degrees = {180, 0, 0}}));
    scene.solver.substeps = 5;
    SceneWorld world = made(scene);
    EXPECT_EQ(frames_crossed(world, 8), 0);
    world.move(world.world().collider_id(0), {0, 0.03f, 0}, {180, 10, 0});
    EXPECT_EQ(frames_crossed(world, 8), 0);
}

TEST(SurfaceColliders, meet_other_cloth_as_solids) {
    for (const SelfCollision kind : {SelfCollision::off, SelfCollision::fast}) {
        SceneCloth sheet = exact_sheet(0.4f, 16, {.position = {0, 0.21f, 0}});
        sheet.self_collision = kind;
        ColliderDesc ball = surface_collider(make_sphere(0.2f, 3));
        SceneDesc as_surface = scene_of(sheet, ball);
        std::get<SolidMeshDesc>(ball.shape).contact = MeshContact::solid;
        SceneWorld one = made(as_surface), two = made(scene_of(sheet, ball));
        for (int i = 0; i < 20; ++i) one.step(), two.step();
        EXPECT_EQ(one.world().state_hash(), two.world().state_hash());
    }
}

TEST(SurfaceColliders, are_the_default_for_meshes_with_holes) {
    const auto is_surface = [](TriangleMesh mesh, MeshContact contact) {
        ColliderDesc collider = surface_collider(std::move(mesh));
        std::get<SolidMeshDesc>(collider.shape).contact = contact;
        const SceneWorld world = made(scene_of(exact_sheet(0.4f, 4, {.position = {0, 2, 0}}), collider));
        return world.world().colliders()[0].surface != nullptr;
    };
    EXPECT_TRUE(is_surface(half_shell(0.2f), MeshContact::automatic));
    EXPECT_FALSE(is_surface(half_shell(0.2f), MeshContact::solid));
    EXPECT_FALSE(is_surface(make_sphere(0.2f, 2), MeshContact::automatic));
    EXPECT_TRUE(is_surface(make_sphere(0.2f, 2), MeshContact::surface));
}

TEST(SurfaceColliders, are_no_cloths_for_the_user) {
    SceneWorld world =
        made(scene_of(exact_sheet(0.4f, 16, {.position = {0, 0.01f, 0}}), surface_collider(half_shell(1))));
    world.step();
    EXPECT_EQ(world.world().cloth_count(), 1u);
    EXPECT_EQ(world.world().frame().cloths.size(), 1u);
    EXPECT_EQ(world.world().save().cloths.size(), 1u);
    EXPECT_EQ(world.world().island(0).size(), 1u);
}

// A sheet on a turning shell, and one that falls beside it and then onto it.
SceneDesc busy_scene() {
    ColliderDesc turning = surface_collider(half_shell(0.2f));
    turning.motion = {{.time = 0, .rotation_degrees = {180, 0, 0}}, {.time = 1, .rotation_degrees = {150, 90, 0}}};
    SceneDesc scene = scene_of(exact_sheet(0.5f, 25, {.position = {0, 0.22f, 0}}), turning);
    scene.cloths.push_back(exact_sheet(0.3f, 16, {.position = {0.1f, 0.6f, 0}}));
    scene.cloths.push_back(exact_sheet(0.3f, 16, {.position = {3, 0.6f, 0}}));
    scene.colliders.push_back(surface_collider(plate_mesh(8), {.position = {0, -0.3f, 0}}));
    scene.colliders.back().name = "floor";
    return scene;
}

// Labels: slow no-asan
TEST(SurfaceColliders, give_the_same_bits_for_any_number_of_threads) {
    for (const SceneDesc& scene : {busy_scene(), hit_scene(10, false), hit_scene(5, true, 40)}) {
        std::string first;
        for (const unsigned threads : {1u, 2u, 4u}) {
            SceneWorld world = made(scene, threads);
            EXPECT_EQ(frames_crossed(world, 30), 0);
            const std::string hash = world.world().state_hash();
            if (first.empty()) first = hash;
            EXPECT_EQ(hash, first) << threads;
        }
    }
}

// A blade of 30 cm that turns through a hanging sheet.
// Labels: no-asan
TEST(SurfaceColliders, that_turn_fast_carry_cloth_along) {
    for (const float turns : {1.0f, 5.0f}) {  // per second
        ColliderDesc blade = surface_collider(make_grid({0.6f, 0.06f}, {7, 2}, GridDiagonal::uniform));
        constexpr int quarters = 4;
        for (int k = 0; k <= quarters; ++k)
            blade.motion.push_back({.time = 0.25f * static_cast<float>(k) / turns,
                                    .position = {0, 0, 0},
                                    .rotation_degrees = {70, 90.0f * static_cast<float>(k), 0}});
        SceneCloth sheet = exact_sheet(0.4f, 20, {.position = {0.35f, 0, 0.02f}, .rotation_degrees = {90, 0, 0}});
        SceneDesc scene = scene_of(sheet, blade);
        scene.solver.substeps = 20;
        SceneWorld world = made(scene);
        EXPECT_EQ(frames_crossed(world, 20), 0) << turns << " turns a second";
    }
}

TEST(SurfaceColliders, are_measured_by_crossings_not_by_depth) {
    SceneDesc scene = scene_of(exact_sheet(0.2f, 12, {.position = {0, 0, 0}}), surface_collider(half_shell(0.2f)));
    SceneWorld inside = made(scene);
    for (int i = 0; i < 60; ++i) inside.step();
    EXPECT_EQ(measure_penetration(inside.world().frame(), inside.world().colliders()).max, 0)
        << "inside an open shell, but on a side of its triangles";
    EXPECT_EQ(count_intersections(inside.world().frame(), inside.world().colliders()).edges, 0u);
    scene.cloths[0].transform.position.y = -0.17f;
    EXPECT_GT(count_intersections(made(scene).world().frame(), made(scene).world().colliders()).edges, 0u);
    scene.cloths[0].self_collision = SelfCollision::off;
    const SceneWorld other = made(scene);
    EXPECT_EQ(count_intersections(other.world().frame(), other.world().colliders()).edges, 0u) << "it meets the solid";
    EXPECT_GT(measure_penetration(other.world().frame(), other.world().colliders()).max, 0.01);
}

TEST(SurfaceColliders, continue_with_the_same_bits_from_a_saved_state) {
    SceneWorld world = made(busy_scene());
    for (int i = 0; i < 30; ++i) world.step();
    const Snapshot saved = world.world().save();
    for (int i = 0; i < 15; ++i) world.step();
    const std::string expected = world.world().state_hash();
    ASSERT_TRUE(world.world().restore(saved).ok());
    for (int i = 0; i < 15; ++i) world.step();
    EXPECT_EQ(world.world().state_hash(), expected);
    SceneWorld other = made(busy_scene());
    ASSERT_TRUE(other.world().restore(saved).ok());
    for (int i = 0; i < 15; ++i) other.step();
    EXPECT_EQ(other.world().state_hash(), expected);
}

TEST(SurfaceColliders, report_cloth_that_starts_across_them_and_let_it_go) {
    SceneDesc scene = scene_of(exact_sheet(0.3f, 16, {.position = {0.42f, 0.001f, 0}, .rotation_degrees = {0, 0, 60}}),
                               surface_collider(plate_mesh(1)));
    SceneWorld world = made(scene);
    EXPECT_GT(world.step().cloth_contacts.tangled, 0u);
    EXPECT_TRUE(world.world().frame().tangled_at.has_value());
    int frames = 1;
    while (frames < 240 && crossings_with_colliders(world.world()) > 0) world.step(), ++frames;
    EXPECT_LT(frames, 240) << "it comes apart";
}

TEST(SurfaceColliders, of_degenerate_triangles_hold_or_say_why_not) {
    TriangleMesh odd = plate_mesh(1);
    odd.triangles.push_back(odd.triangles[0]);  // doubled
    odd.triangles.push_back({0, 0, 1});         // without an area
    odd.positions.push_back({0, -0.3f, 0});     // a third triangle at an edge
    odd.triangles.push_back({odd.triangles[0][0], odd.triangles[0][1], 4});
    SceneWorld world = made(scene_of(exact_sheet(0.4f, 16, {.position = {0, 0.02f, 0}}), surface_collider(odd)));
    EXPECT_EQ(frames_crossed(world, 40), 0);
    EXPECT_THAT(world.notes(), Contains(HasSubstr("1 doubled triangles left out")));
    TriangleMesh wrong = plate_mesh(1);
    wrong.triangles.push_back({0, 1, 9});
    const auto failed =
        SceneWorld::create(scene_of(exact_sheet(0.4f, 16, {}), surface_collider(wrong)), {.backend = "cpu"});
    ASSERT_FALSE(failed.ok());
    EXPECT_THAT(failed.error().message(), HasSubstr("/colliders/0"));
    EXPECT_THAT(failed.error().message(), HasSubstr("triangle 2"));
}

TEST(SurfaceColliders, have_the_friction_of_the_collider) {
    // On a slope of 20°, tan 20° = 0.36.
    const auto slid = [](float friction, bool later) {
        ColliderDesc slope = surface_collider(plate_mesh(6), {.rotation_degrees = {0, 0, 20}});
        slope.friction = {friction, friction};
        if (later) slope.friction = {4, 4};
        SceneCloth sheet = exact_sheet(0.3f, 12, {.position = {0, 0.003f, 0}, .rotation_degrees = {0, 0, 20}});
        sheet.fabric.contact.friction[0] = sheet.fabric.contact.friction[1] = 0.4f;
        SceneWorld world = made(scene_of(sheet, slope));
        if (later) world.set_friction(world.world().collider_id(0), {friction, friction});
        for (int i = 0; i < 60; ++i) world.step();
        return length(world.world().frame().cloths[0].positions[70].xyz() -
                      world.world().model(world.world().cloth_id(0))->rest_position(70));
    };
    EXPECT_LT(slid(0.8f, false), 0.02f) << "0.57 holds";
    EXPECT_GT(slid(0.1f, false), 0.3f) << "0.2 slides";
    EXPECT_GT(slid(0.1f, true), 0.3f) << "set while it runs";
}

}  // namespace
}  // namespace weft
