// Document and world agree after every change, and after every change that fails.
#include "weft/scene_world.h"

#include "scene/check.h"
#include "solver/world/backend_without_room.test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace weft {
namespace {

using testing::HasSubstr;

SceneCloth sheet(const std::string& name, Vec3 position, std::uint32_t side = 12) {
    SceneCloth cloth;
    cloth.name = name;
    cloth.mesh = GridDesc{.size = {1, 1}, .resolution = {side, side}};
    cloth.transform.position = position;
    cloth.pins = {{.select = VertexPins{{0}}}};
    return cloth;
}

SceneDesc two_sheets() {
    SceneDesc scene;
    scene.solver.substeps = 4;
    scene.cloths = {sheet("a", {0, 1, 0}), sheet("b", {0, 2, 0}, 33)};
    scene.cloths[1].pins[0].attach = "ball";
    scene.colliders = {ColliderDesc{.name = "ball", .shape = SphereDesc{0.2f}}, ColliderDesc{.name = "floor"}};
    scene.colliders[0].material = {.preset = "velvet", .values = find_material("velvet")->material};
    return scene;
}

SceneWorld open(const SceneDesc& scene, const MakeBackend& make = {}) {
    auto world = SceneWorld::create(scene, {.backend = "cpu"}, {}, make);
    EXPECT_TRUE(world.ok()) << world.error().message();
    return std::move(*world);
}

std::string hash_after(SceneWorld& world, int frames) {
    for (int i = 0; i < frames; ++i) world.advance();
    return world.world().state_hash();
}

/// Worlds that are built from the document are equal.
void expect_document_says_all(const SceneWorld& world, int frames = 4) {
    EXPECT_TRUE(check_scene(world.scene()).empty()) << check_scene(world.scene()).front().message();
    EXPECT_EQ(world.scene().cloths.size(), world.world().cloth_count());
    EXPECT_EQ(world.scene().colliders.size(), world.world().colliders().size());
    for (std::size_t i = 0; i < world.scene().cloths.size(); ++i)
        EXPECT_EQ(world.scene().cloths[i].name, world.world().model(world.world().cloth_id(i))->name);
    SceneWorld once = open(world.scene()), again = open(once.scene());
    EXPECT_EQ(hash_after(once, frames), hash_after(again, frames));
    EXPECT_TRUE(once.scene() == world.scene());
}

TEST(SceneWorld, starts_from_its_document_after_any_change) {
    SceneWorld world = open(two_sheets());
    expect_document_says_all(world);
    for (int i = 0; i < 3; ++i) world.advance();
    const ClothId a = world.world().cloth_id(0);
    const ColliderId ball = world.world().collider_id(0), floor = world.world().collider_id(1);
    const Fabric denim = find_fabric("denim")->fabric;
    ASSERT_TRUE(world.set_fabric(a, denim, "denim").ok());
    ASSERT_TRUE(world.set_pins(a, {{.select = VertexPins{{5}}}}).ok());
    world.move(floor, {0, -1, 0}, {0, 90, 0});
    world.set_friction(floor, {0.1f, 0.05f});
    world.set_gravity({0, -1, 0});
    world.set_air(AirDesc{.density = 2});
    ASSERT_TRUE(world.set_solver({.substeps = 3, .hierarchy = false}).ok());
    const SceneDesc& scene = world.scene();
    EXPECT_EQ(scene.cloths[0].fabric_name, "denim");
    EXPECT_TRUE(scene.cloths[0].fabric == denim);
    EXPECT_EQ(std::get<VertexPins>(scene.cloths[0].pins[0].select).vertices[0], 5u);
    EXPECT_EQ(std::get<GridDesc>(scene.cloths[0].mesh).resolution[0], 12u);
    EXPECT_EQ(scene.colliders[1].transform.rotation_degrees, (Vec3{0, 90, 0}));
    EXPECT_EQ(scene.colliders[1].friction[0], 0.1f);
    EXPECT_EQ(scene.gravity, (Vec3{0, -1, 0}));
    EXPECT_EQ(scene.air->density, 2);
    EXPECT_EQ(scene.solver.substeps, 3u);
    expect_document_says_all(world);

    world.remove(ball);
    EXPECT_EQ(scene.cloths[1].pins[0].attach, "") << "what is gone carries nothing";
    expect_document_says_all(world);
    world.remove(a);
    ASSERT_TRUE(world.add(sheet("c", {1, 1, 1})).ok());
    ASSERT_TRUE(world.add(ColliderDesc{.name = "box", .shape = BoxDesc{}}).ok());
    EXPECT_EQ(scene.cloths[1].name, "c");
    expect_document_says_all(world);
}

TEST(SceneWorld, takes_all_of_a_change_or_nothing) {
    int room = 100;
    SceneWorld world = open(two_sheets(), [&](const Options& options) -> Result<std::unique_ptr<Backend>> {
        auto inner = make_backend(options);
        if (!inner) return inner.errors();
        return std::unique_ptr<Backend>(std::make_unique<BackendWithoutRoom>(std::move(*inner), room));
    });
    SceneWorld same = open(two_sheets());
    hash_after(world, 3), hash_after(same, 3);

    SolverDesc coarse = world.scene().solver;
    coarse.hierarchy = false;
    room = 1;  // the model of the second sheet fails
    const auto set = world.set_solver(coarse);
    ASSERT_FALSE(set.ok());
    EXPECT_THAT(set.error().message(), HasSubstr("has no room"));
    EXPECT_TRUE(world.scene() == same.scene());
    EXPECT_TRUE(world.world().settings().solver.hierarchy);
    EXPECT_EQ(hash_after(world, 5), hash_after(same, 5)) << "a query changes no state";

    room = 3;  // calls 0, 1, 2: first sheet set, second failed, first set back
    EXPECT_FALSE(world.set_fabric(world.world().cloth_id(0), find_fabric("silk")->fabric, "silk").ok());
    EXPECT_TRUE(world.scene() == same.scene());
    EXPECT_EQ(hash_after(world, 5), hash_after(same, 5));
    EXPECT_FALSE(world.set_pins(world.world().cloth_id(0), {{.select = BoxPins{{{8, 8, 8}, {9, 9, 9}}}}}).ok());
    EXPECT_TRUE(world.scene() == same.scene());
    EXPECT_EQ(hash_after(world, 5), hash_after(same, 5));
}

TEST(SceneWorld, follows_another_document_and_back) {
    SceneWorld world = open(two_sheets());
    const SceneDesc before = world.scene();
    SceneDesc next = before;
    next.name = "next";
    next.gravity = {0, -2, 0};
    next.solver.hierarchy = false;
    next.air = AirDesc{};
    next.cloths[0].fabric = find_fabric("silk")->fabric;
    next.cloths[0].fabric_name = "silk";
    next.cloths[0].tethers = Tethers::on;
    next.cloths[1].mesh = GridDesc{.size = {1, 1}, .resolution = {5, 5}};
    next.cloths.push_back(sheet("c", {3, 0, 0}));
    next.colliders[0].shape = BoxDesc{};
    next.colliders[1].friction = {0, 0};
    next.cloths[0].material = {.preset = "satin", .values = find_material("satin")->material};
    next.colliders[1].material = next.cloths[0].material;
    hash_after(world, 2);
    const ClothId a = world.world().cloth_id(0), b = world.world().cloth_id(1);
    const float height = world.world().frame().cloths[0].positions[143].y;
    ASSERT_TRUE(world.change_to(next).ok());
    EXPECT_TRUE(world.world().contains(a)) << "it goes on as it was";
    EXPECT_EQ(world.world().frame().cloths[0].positions[143].y, height);
    EXPECT_FALSE(world.world().contains(b));
    EXPECT_EQ(world.scene().cloths.size(), 3u);
    for (const SceneCloth& cloth : next.cloths)
        EXPECT_TRUE(*std::ranges::find(world.scene().cloths, cloth.name, &SceneCloth::name) == cloth);
    for (const SceneCollider& collider : next.colliders)
        EXPECT_TRUE(*std::ranges::find(world.scene().colliders, collider.name, &SceneCollider::name) == collider);
    expect_document_says_all(world);
    EXPECT_EQ(world.world().settings().gravity.y, -2);

    ASSERT_TRUE(world.change_to(before).ok());
    EXPECT_EQ(world.scene().cloths.size(), 2u);
    EXPECT_TRUE(world.scene().cloths == before.cloths);
    EXPECT_TRUE(world.world().contains(a));
    EXPECT_FALSE(world.scene().cloths[0].material);
    expect_document_says_all(world);
}

TEST(SceneWorld, starts_a_cloth_again_with_another_velocity) {
    SceneWorld world = open(two_sheets());
    hash_after(world, 2);
    const SceneDesc before = world.scene();
    SceneDesc next = before;
    next.cloths[0].velocity = {0, -15, 0};
    const ClothId a = world.world().cloth_id(0), b = world.world().cloth_id(1);
    ASSERT_TRUE(world.change_to(next).ok());
    EXPECT_FALSE(world.world().contains(a)) << "it is replaced, as with another transform";
    EXPECT_EQ(world.world().cloth_id(1), b) << "the order is that of the document";
    const ClothFrame& replaced = world.world().frame().cloths[0];
    EXPECT_EQ(replaced.velocities[0].xyz(), Vec3{}) << "it is pinned";
    EXPECT_EQ(replaced.velocities[1].xyz(), (Vec3{0, -15, 0}));
    expect_document_says_all(world);

    // Changes that build another model keep the velocity of the document.
    ASSERT_TRUE(world.set_solver({.substeps = 4, .hierarchy = false}).ok());
    EXPECT_EQ(world.scene().cloths[0].velocity, (Vec3{0, -15, 0}));
    EXPECT_EQ(world.world().model(world.world().cloth_id(0))->start_velocity, (Vec3{0, -15, 0}));
}

TEST(SceneWorld, changes_self_collision_of_a_moving_cloth) {
    SceneWorld world = open(two_sheets());
    hash_after(world, 2);
    const ClothId a = world.world().cloth_id(0);
    const auto in_model = [&] { return world.world().model(a)->collision.with_cloth; };
    EXPECT_EQ(in_model(), SelfCollision::off);
    const float height = world.world().frame().cloths[0].positions[143].y;
    SceneDesc next = world.scene();
    next.cloths[0].self_collision = SelfCollision::exact;
    next.cloths[0].fabric.body.density = 0.3f;
    ASSERT_TRUE(world.change_to(next).ok());
    EXPECT_TRUE(world.world().contains(a)) << "it goes on as it was";
    EXPECT_EQ(world.world().frame().cloths[0].positions[143].y, height);
    EXPECT_EQ(in_model(), SelfCollision::exact);
    EXPECT_EQ(world.world().model(a)->fabric.body.density, 0.3f);
    EXPECT_EQ(world.scene().cloths[0].self_collision, SelfCollision::exact);
    expect_document_says_all(world);

    // Other changes keep it, whether they build a model or not.
    ASSERT_TRUE(world.set_fabric(a, find_fabric("denim")->fabric, "denim").ok());
    EXPECT_EQ(in_model(), SelfCollision::exact);
    ASSERT_TRUE(world.set_pins(a, {{.select = VertexPins{{5}}}}).ok());
    EXPECT_EQ(in_model(), SelfCollision::exact);
    ASSERT_TRUE(world.set_solver({.substeps = 3, .hierarchy = false}).ok());
    EXPECT_EQ(in_model(), SelfCollision::exact);
    expect_document_says_all(world);

    next = world.scene();
    next.cloths[0].collision_group = 3;
    next.cloths[0].collision_mask = 6;
    next.cloths[0].layer = 2;
    ASSERT_TRUE(world.change_to(next).ok());
    EXPECT_TRUE(world.world().contains(a));
    EXPECT_EQ(world.world().model(a)->collision.filter, (CollisionFilter{.groups = 8, .mask = 6}));
    EXPECT_EQ(world.world().model(a)->collision.layer, 2u);
    expect_document_says_all(world);

    next = world.scene();
    next.cloths[0].self_collision = SelfCollision::off;
    ASSERT_TRUE(world.change_to(next).ok());
    EXPECT_EQ(in_model(), SelfCollision::off);
    expect_document_says_all(world);
}

TEST(SceneWorld, keeps_to_its_document_where_another_is_wrong) {
    SceneWorld world = open(two_sheets());
    const SceneDesc before = world.scene();
    SceneDesc next = before;
    next.cloths[0].name = "b";
    next.gravity.x = 1e9f;
    const auto refused = world.change_to(next);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.errors().size(), 2u);
    EXPECT_TRUE(world.scene() == before);
    // The checks do not find this problem; building the cloth does.
    next = before;
    next.colliders.clear();
    next.cloths[1].pins[0].attach.clear();
    next.cloths.push_back(sheet("c", {}));
    next.cloths[2].mesh = MeshFileDesc{.file = "none.obj"};
    EXPECT_FALSE(world.change_to(next).ok());
    EXPECT_TRUE(world.scene() == before);
    expect_document_says_all(world);
    ASSERT_TRUE(world.change_to({}).ok()) << "a world may be empty";
    EXPECT_EQ(world.world().cloth_count(), 0u);
}

}  // namespace
}  // namespace weft
