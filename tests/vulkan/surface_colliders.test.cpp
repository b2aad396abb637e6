// Mesh colliders as surfaces, on the device: the same bits as on the CPU.

#include "vulkan_fixture.h"

#include "mesh/procedural.h"
#include "weft/scene_world.h"

#include "files/surface_crossings.test.h"

namespace weft {
namespace {

SceneDesc sheet_over(TriangleMesh mesh, float speed) {
    SceneDesc scene;
    scene.solver.substeps = 5;
    SceneCloth& sheet = scene.cloths.emplace_back();
    sheet.mesh = GridDesc{.size = {0.5f, 0.5f}, .resolution = {14, 14}};
    sheet.transform = {.position = {0.02f, 0.3f, 0}, .rotation_degrees = {0, 20, 0}};
    sheet.velocity = {0, -speed, 0};
    sheet.self_collision = SelfCollision::exact;
    scene.colliders.push_back(
        ColliderDesc{.name = "surface",
                     .shape = SolidMeshDesc{.mesh = std::move(mesh), .resolution = 16, .contact = MeshContact::surface},
                     .friction = {0.3f, 0.2f}});
    return scene;
}

TriangleMesh bowl() {
    TriangleMesh mesh = make_sphere(0.2f, 2);
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        return mesh.positions[t[0]].y + mesh.positions[t[1]].y + mesh.positions[t[2]].y > 0;
    });
    return mesh;
}

void expect_same(const SceneDesc& scene, int frames, const char* what) {
    auto cpu = SceneWorld::create(scene, {.backend = "cpu"});
    auto vulkan = SceneWorld::create(scene, {.backend = "vulkan"});
    ASSERT_TRUE(cpu.ok()) << cpu.error().message();
    ASSERT_TRUE(vulkan.ok()) << vulkan.error().message();
    std::uint64_t contacts = 0;
    for (int i = 0; i < frames; ++i) {
        cpu->advance(), vulkan->advance();
        contacts += vulkan->world().summary().cloth_contacts.contacts;
        EXPECT_EQ(crossings_with_colliders(vulkan->world()), 0u) << what << ", frame " << i;
    }
    EXPECT_GT(contacts, 0u) << what;
    const auto a = cpu->world().frame().cloths[0].positions, b = vulkan->world().frame().cloths[0].positions;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t p = 0; p < a.size(); ++p) EXPECT_LT(length(a[p].xyz() - b[p].xyz()), 1e-3f) << what;
    if (vulkan->world().backend().device().find("llvmpipe") != std::string::npos) {
        EXPECT_EQ(vulkan->world().state_hash(), cpu->world().state_hash()) << what;
    }
}

// Labels: slow no-asan long
TEST(VulkanSurfaceColliders, have_the_bits_of_the_cpu) {
    expect_same(sheet_over(make_grid({1, 1}, {2, 2}, GridDiagonal::uniform), 10), 8, "plate");
    expect_same(sheet_over(bowl(), 2), 20, "bowl");
    SceneDesc turning = sheet_over(bowl(), 2);
    turning.colliders[0].motion = {{.time = 0, .rotation_degrees = {180, 0, 0}},
                                   {.time = 0.5f, .rotation_degrees = {150, 60, 0}}};
    expect_same(turning, 20, "turning bowl");
    SceneDesc other = sheet_over(bowl(), 2);
    other.cloths[0].self_collision = SelfCollision::off;
    auto solid = other;
    std::get<SolidMeshDesc>(solid.colliders[0].shape).contact = MeshContact::solid;
    auto one = SceneWorld::create(other, {.backend = "vulkan"}), two = SceneWorld::create(solid, {.backend = "vulkan"});
    ASSERT_TRUE(one.ok() && two.ok());
    for (int i = 0; i < 12; ++i) one->advance(), two->advance();
    EXPECT_EQ(one->world().state_hash(), two->world().state_hash()) << "other cloth meets the solid";
}

// Labels: slow no-asan long
TEST(VulkanSurfaceColliders, that_move_fast_carry_cloth_along) {
    SceneDesc scene = sheet_over(make_grid({0.3f, 0.3f}, {2, 2}, GridDiagonal::uniform), 0);
    scene.solver.substeps = 10;
    scene.colliders[0].motion = {{.time = 0, .position = {0, 0.15f, 0}, .rotation_degrees = {5, 20, 0}},
                                 {.time = 0.1f, .position = {0, 0.65f, 0}, .rotation_degrees = {25, 20, 0}}};
    expect_same(scene, 8, "plate at 5 m/s");
}

// Labels: slow no-asan long
TEST(VulkanSurfaceColliders, come_move_and_go_and_are_restored) {
    SceneDesc scene = sheet_over(bowl(), 2);
    scene.colliders.front().transform.rotation_degrees = {180, 0, 0};
    auto world = SceneWorld::create(scene, {.backend = "vulkan", .contact_forces = true});
    ASSERT_TRUE(world.ok()) << world.error().message();
    for (int i = 0; i < 4; ++i) {
        world->advance();
        EXPECT_EQ(crossings_with_colliders(world->world()), 0u) << i;
    }
    const ColliderId id = world->world().collider_id(0);
    world->move(id, {0, 0.03f, 0}, {180, 10, 0});
    world->set_friction(id, {0.5f, 0.5f});
    for (int i = 0; i < 4; ++i) {
        world->advance();
        EXPECT_EQ(crossings_with_colliders(world->world()), 0u)
            << i << ' ' << world->world().summary().cloth_contacts.tangled;
    }
    const Snapshot saved = world->world().save();
    for (int i = 0; i < 2; ++i) world->advance();
    const std::string expected = world->world().state_hash();
    ASSERT_TRUE(world->world().restore(saved).ok());
    for (int i = 0; i < 2; ++i) world->advance();
    EXPECT_EQ(world->world().state_hash(), expected);
    const std::uint64_t bytes = world->world().backend().device_bytes();
    world->remove(id);
    for (int i = 0; i < 2; ++i) world->advance();
    EXPECT_LT(world->world().backend().device_bytes(), bytes);
    EXPECT_TRUE(std::isfinite(world->world().frame().cloths[0].positions[0].y));
}

}  // namespace
}  // namespace weft
