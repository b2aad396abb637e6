#include "weft/body_building.h"

#include "mesh/procedural.h"
#include "weft/scene_world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace weft {
namespace {

using testing::Contains;
using testing::HasSubstr;

SceneDesc scene_with(std::vector<ColliderDesc> colliders) {
    SceneDesc scene;
    scene.solver.substeps = 2;
    SceneCloth cloth;
    cloth.mesh = GridDesc{.size = {1, 1}, .resolution = {8, 8}};
    cloth.transform.position = {0, 3, 0};
    cloth.self_collision = SelfCollision::exact;
    scene.cloths = {cloth};
    for (ColliderDesc& collider : colliders) scene.colliders.push_back(std::move(collider));
    return scene;
}

SceneWorld opened(const SceneDesc& scene) {
    auto world = SceneWorld::create(scene, {.backend = "cpu", .field_cache = ""});
    EXPECT_TRUE(world.ok()) << world.error().message();
    return std::move(*world);
}

std::string error_of(const ColliderDesc& collider) {
    const auto world = SceneWorld::create(scene_with({{.name = "floor"}, collider}), {.backend = "cpu"});
    return world ? "none" : world.error().message();
}

// A bowl: half of a closed, thick shell of a box.
TriangleMesh tray(bool open) {
    TriangleMesh mesh = make_box({1, 0.5f, 1}, {3, 3, 3});
    if (open)
        std::erase_if(mesh.triangles, [&](const Triangle& t) {
            return std::ranges::all_of(t, [&](std::uint32_t v) { return mesh.positions[v].y > 0.2f; });
        });
    return mesh;
}

TEST(BodiesOfScenes, have_mass_and_features) {
    const SceneWorld world = opened(
        scene_with({{.name = "ball", .shape = SphereDesc{0.5f}, .body = BodyDesc{.mass = 2, .restitution = 0.5f}},
                    {.name = "stone", .shape = ConvexDesc{.mesh = tray(false), .radius = 0.1f}, .body = BodyDesc{}},
                    {.name = "rest", .shape = BoxDesc{}}}));
    const auto& colliders = world.world().colliders();
    ASSERT_TRUE(colliders[0].body);
    EXPECT_EQ(colliders[0].body->mass.mass, 2);
    EXPECT_NEAR(colliders[0].body->mass.inertia[0], 0.4f * 2 * 0.25f, 1e-6f);
    EXPECT_EQ(colliders[0].body->desc.restitution, 0.5f);
    EXPECT_EQ(colliders[0].features.points.size(), 1u);
    ASSERT_TRUE(colliders[1].body);
    EXPECT_GT(colliders[1].body->mass.mass, 500) << "with its rounding";
    EXPECT_EQ(colliders[1].features.points.size(), 8u);
    EXPECT_EQ(colliders[1].features.points[0].radius, 0.1f);
    EXPECT_FALSE(colliders[2].body);
    EXPECT_EQ(colliders[2].features.points.size(), 8u) << "bodies can touch what is at rest";
}

TEST(BodiesOfScenes, name_the_place_of_what_is_wrong) {
    EXPECT_EQ(error_of({.name = "a", .shape = SolidMeshDesc{.mesh = tray(true), .resolution = 16}, .body = BodyDesc{}}),
              "/colliders/1/motion/dynamic/mass: must be given: the mesh has holes, so it has no volume");
    EXPECT_THAT(error_of({.name = "a", .shape = SphereDesc{1e-9f}, .body = BodyDesc{}}),
                HasSubstr("/colliders/1/motion/dynamic: the body is too small"));
}

TEST(BodiesOfScenes, that_are_open_meshes_are_shells_and_solids) {
    const ColliderDesc open{.name = "tray", .shape = SolidMeshDesc{.mesh = tray(true), .resolution = 16}};
    ColliderDesc body = open;
    body.body = BodyDesc{.mass = 1};
    const SceneWorld at_rest = opened(scene_with({open})), moves = opened(scene_with({body}));
    EXPECT_TRUE(at_rest.world().colliders()[0].surface);
    EXPECT_FALSE(moves.world().colliders()[0].surface);
    EXPECT_THAT(moves.notes(), Contains("collider 'tray': the mesh has holes, so its center and moments of inertia are "
                                        "those of a shell"));
    EXPECT_THAT(moves.notes(), Contains("collider 'tray': other bodies meet the convex hull of the mesh, with 8 "
                                        "corners; cloth meets the mesh itself"));
    EXPECT_THAT(moves.notes(), Contains("collider 'tray': the mesh is open; its holes count as closed"));
    EXPECT_LT(moves.world().colliders()[0].body->mass.center.y, -0.01f);
}

TEST(BodiesOfScenes, that_are_meshes_have_features_of_a_hull_only_where_they_are_needed) {
    const SolidMeshDesc mesh{.mesh = tray(false), .resolution = 16};
    const SceneWorld world = opened(
        scene_with({{.name = "rests", .shape = mesh},
                    {.name = "keyed", .shape = mesh, .motion = {{.time = 0}, {.time = 1, .position = {1, 0, 0}}}},
                    {.name = "body", .shape = mesh, .body = BodyDesc{}}}));
    const auto& colliders = world.world().colliders();
    EXPECT_EQ(colliders[0].features, BodyFeatures{});
    EXPECT_EQ(colliders[1].features.points.size(), 8u);
    EXPECT_TRUE(colliders[1].features.edges.empty());
    EXPECT_EQ(colliders[2].features.points.size(), 8u);
    EXPECT_EQ(colliders[2].features.edges.size(), 12u);
    EXPECT_EQ(colliders[0].data, colliders[2].data);
}

TEST(BodiesOfScenes, lend_their_mass_to_equal_ones) {
    const ColliderDesc first{.name = "a",
                             .shape = SolidMeshDesc{.mesh = tray(false), .resolution = 16},
                             .body = BodyDesc{.mass = 3, .center = {0.1f, 0, 0}}};
    ColliderDesc faster = first, heavier = first;
    faster.name = "b", faster.body->velocity = {1, 0, 0};
    heavier.name = "c", heavier.body->mass = 4;
    const SceneWorld world = opened(scene_with({first, faster, heavier}));
    const auto& colliders = world.world().colliders();
    EXPECT_EQ(colliders[1].body->mass, colliders[0].body->mass);
    EXPECT_EQ(colliders[1].features, colliders[0].features);
    EXPECT_EQ(colliders[1].body->desc.velocity, (Vec3{1, 0, 0}));
    EXPECT_EQ(colliders[2].body->mass.mass, 4);
}

TEST(BodiesOfScenes, change_with_the_document) {
    SceneDesc scene = scene_with({{.name = "ball", .shape = SphereDesc{0.5f}, .body = BodyDesc{.mass = 2}}});
    SceneWorld world = opened(scene);
    for (int i = 0; i < 2; ++i) world.advance();
    const ColliderId before = world.world().collider_id(0);
    scene.colliders[0].friction = {0.9f, 0.8f};
    ASSERT_TRUE(world.change_to(scene).ok());
    EXPECT_EQ(world.world().collider_id(0), before);
    EXPECT_EQ(world.world().colliders()[0].friction[0], 0.9f);
    scene.colliders[0].body->mass = 5;
    ASSERT_TRUE(world.change_to(scene).ok());
    EXPECT_NE(world.world().collider_id(0), before);
    EXPECT_EQ(world.world().colliders()[0].body->mass.mass, 5);
    EXPECT_EQ(world.scene().colliders[0].body->mass, 5);
    scene.colliders[0].body.reset();
    ASSERT_TRUE(world.change_to(scene).ok());
    EXPECT_FALSE(world.world().colliders()[0].body);
}

}  // namespace
}  // namespace weft
