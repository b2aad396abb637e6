// Colliders made from meshes: what they do to cloth, and what malformed ones say.

#include "base/temporary_folder.test.h"
#include "files/open_scene.h"
#include "mesh/procedural.h"
#include "solver/measures/statistics.h"

#include <weft/weft.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

namespace weft {
namespace {

using testing::HasSubstr;

constexpr float ball_radius = 0.25f;

// A sheet that falls on the collider, which is moved to `place`. 0.7 s.
Result<SceneWorld> drape_on(ColliderDesc collider, const std::string& backend = "cpu", int frames = 42) {
    SceneDesc scene;
    SceneCloth& sheet = scene.cloths.emplace_back();
    sheet.mesh = GridDesc{.size = {0.8f, 0.8f}, .resolution = {28, 28}};
    sheet.transform = {.position = {0.1f, 0.62f, 0.05f}};
    collider.transform = {.position = {0.1f, 0.3f, 0.05f}, .rotation_degrees = {20, 30, 40}};
    scene.colliders.push_back(collider);
    auto world = SceneWorld::create(scene, {.backend = backend});
    for (int i = 0; world && i < frames; ++i) world->advance();
    return world;
}

double depth_in_ball(const SceneWorld& world) {
    double most = 0;
    for (const Vec4& x : world.world().frame().cloths[0].positions)
        most = std::max(most, double{ball_radius} - static_cast<double>(length(x.xyz() - Vec3{0.1f, 0.3f, 0.05f})));
    return most;
}

SolidMeshDesc ball_mesh() {
    return {.mesh = make_sphere(ball_radius, 4), .resolution = 48};
}

// Labels: slow no-asan
TEST(MeshColliders, hold_cloth_as_the_shape_does_that_they_are_made_from) {
    const auto on_ball = drape_on({.shape = SphereDesc{ball_radius}});
    for (const ColliderDesc& collider :
         {ColliderDesc{.shape = ball_mesh()}, ColliderDesc{.shape = ConvexDesc{.mesh = make_sphere(ball_radius, 2)}}}) {
        const auto on_mesh = drape_on(collider);
        ASSERT_TRUE(on_mesh.ok()) << on_mesh.error().message();
        EXPECT_LT(depth_in_ball(*on_mesh), 0.008) << "the facets of a hull with 162 corners lie 8 mm deep";
        EXPECT_GT(depth_in_ball(*on_mesh), -0.003) << "it touches";
        EXPECT_NEAR(kinetic_energy(on_mesh->world().frame()), kinetic_energy(on_ball->world().frame()), 0.02);
    }
}

TEST(MeshColliders, with_holes_and_flipped_triangles_hold_cloth_too) {
    SolidMeshDesc torn = ball_mesh();
    for (std::size_t t = 0; t < torn.mesh.triangles.size(); t += 7)
        std::swap(torn.mesh.triangles[t][0], torn.mesh.triangles[t][1]);
    torn.mesh.triangles.resize(torn.mesh.triangles.size() - 200);  // of 5120
    const auto world = drape_on({.shape = torn});
    ASSERT_TRUE(world.ok()) << world.error().message();
    EXPECT_LT(depth_in_ball(*world), 0.01);
    EXPECT_THAT(world->notes(), testing::Contains(HasSubstr("open")));
    EXPECT_THAT(world->notes(), testing::Contains(HasSubstr("turned around")));
}

TEST(MeshColliders, share_the_data_of_equal_shapes) {
    SceneDesc scene;
    scene.cloths.emplace_back();
    for (int i = 0; i < 3; ++i) scene.colliders.push_back(ColliderDesc{.shape = ball_mesh()});
    std::get<SolidMeshDesc>(scene.colliders[2].shape).resolution = 24;
    auto world = SceneWorld::create(scene, {.backend = "cpu"});
    ASSERT_TRUE(world.ok()) << world.error().message();
    const auto& colliders = world->world().colliders();
    EXPECT_EQ(colliders[0].data, colliders[1].data);
    EXPECT_NE(colliders[0].data, colliders[2].data);
}

TEST(MeshColliders, that_are_malformed_are_named_with_their_place) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    TriangleMesh flat = make_grid({1, 1}, {4, 4}, GridDiagonal::uniform), not_finite = make_sphere(1, 1), line, huge;
    not_finite.positions[5].y = nan;
    line.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    line.triangles = {{0, 1, 2}};
    const struct {
        decltype(ColliderDesc::shape) shape;
        const char* message;
    } cases[] = {
        {ConvexDesc{.mesh = flat}, "in one plane"},
        {ConvexDesc{.mesh = line}, "/colliders/0"},
        {ConvexDesc{.mesh = not_finite}, "point 5"},
        {ConvexDesc{.mesh = {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}},
         "/colliders/0: points: a convex hull needs at least 4 points, got 3"},
        {ConvexDesc{.mesh = {.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}}}, "on one line"},
        {ConvexDesc{.file = "no such stone.obj"}, "no such stone.obj"},
        {SolidMeshDesc{.mesh = not_finite}, "vertex 5"},
        {SolidMeshDesc{.mesh = line}, "/colliders/0"},
        {SolidMeshDesc{.mesh = make_box({1, 1, 1}, {3, 3, 3}), .resolution = 1024}, "use at most about"},
        {SolidMeshDesc{.file = "no such bunny.obj"}, "no such bunny.obj"},
    };
    for (const auto& [shape, message] : cases) {
        const auto world = drape_on({.shape = shape}, "cpu", 0);
        ASSERT_FALSE(world.ok()) << message;
        EXPECT_THAT(world.error().message(), HasSubstr(message));
        EXPECT_THAT(world.error().message(), HasSubstr("/colliders/0"));
    }
    auto simulation = Simulation::create({}, {.backend = "cpu"});
    ASSERT_TRUE(simulation.ok());
    EXPECT_FALSE(simulation->add(ColliderDesc{.shape = ConvexDesc{}}).ok());
    EXPECT_FALSE(simulation->add(ColliderDesc{.shape = SolidMeshDesc{.mesh = flat, .resolution = 3}}).ok());
    EXPECT_FALSE(simulation->add(ColliderDesc{.shape = ConvexDesc{.mesh = make_sphere(1, 1), .radius = -1}}).ok());
    EXPECT_FALSE(
        simulation->add(ColliderDesc{.shape = ConvexDesc{.scale = {1, 0, 1}, .mesh = make_sphere(1, 1)}}).ok());
    EXPECT_FALSE(
        simulation->add(ColliderDesc{.shape = SolidMeshDesc{.scale = {0, 1, 1}, .mesh = make_sphere(1, 1)}}).ok());
    EXPECT_TRUE(simulation->colliders().empty()) << "nothing is left behind";
}

// Ground is often a sheet. It holds cloth of any kind on the side that it faces.
TEST(MeshColliders, that_are_sheets_hold_cloth_on_the_side_that_they_face) {
    TriangleMesh ground = make_grid({2, 2}, {41, 41}, GridDiagonal::uniform);
    for (Vec3& p : ground.positions) p.y = 0.05f * std::sin(5 * p.x) * std::cos(4 * p.z);
    SceneDesc scene;
    SceneCloth& sheet = scene.cloths.emplace_back();
    sheet.mesh = GridDesc{.size = {0.8f, 0.8f}, .resolution = {28, 28}};
    sheet.transform = {.position = {0.1f, 0.1f, 0.05f}};
    SceneCollider& collider = scene.colliders.emplace_back();
    collider.name = "ground", collider.shape = SolidMeshDesc{.mesh = ground};
    auto world = SceneWorld::create(scene, {.backend = "cpu"});
    ASSERT_TRUE(world.ok()) << world.error().message();
    EXPECT_THAT(world->notes(), testing::Contains(HasSubstr("m behind the side that its triangles face")));
    for (int i = 0; i < 60; ++i) world->advance();
    double lowest = 1;
    for (const Vec4& x : world->world().frame().cloths[0].positions)
        lowest = std::min(lowest, double{x.y} - 0.05 * std::sin(5 * double{x.x}) * std::cos(4 * double{x.z}));
    EXPECT_GT(lowest, -0.003) << "the facets of the ground lie up to 2 mm below the waves";
    EXPECT_LT(measure_penetration(world->world().frame(), world->world().colliders()).max, 0.001);
}

TEST(MeshColliders, in_memory_are_written_beside_a_saved_scene) {
    TemporaryFolder folder;
    auto simulation = Simulation::create({}, {.backend = "cpu"});
    ASSERT_TRUE(simulation.ok());
    ASSERT_TRUE(simulation->add(ClothDesc{.mesh = GridDesc{.resolution = {8, 8}}}).ok());
    ASSERT_TRUE(simulation->add(ColliderDesc{.shape = ball_mesh()}).ok());
    ASSERT_TRUE(simulation->add(ColliderDesc{.shape = ConvexDesc{.mesh = make_sphere(0.2f, 2), .radius = 0.01f}}).ok());
    const auto path = folder.path() / "saved.json";
    const auto saved = simulation->save_scene(path);
    ASSERT_TRUE(saved.ok()) << saved.error().message();
    auto loaded = Simulation::load(path, {.backend = "cpu"});
    ASSERT_TRUE(loaded.ok()) << loaded.error().message();
    for (int i = 0; i < 5; ++i) simulation->step(), loaded->step();
    EXPECT_EQ(loaded->state_hash(), simulation->state_hash());
}

}  // namespace
}  // namespace weft
