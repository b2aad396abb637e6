// Shapes with data on the device.

#include "vulkan_fixture.h"

#include "mesh/procedural.h"
#include "weft/scene_world.h"

namespace weft {
namespace {

SceneDesc sheet_on(std::vector<ColliderDesc> colliders) {
    SceneDesc scene;
    scene.solver.substeps = 5;
    SceneCloth& sheet = scene.cloths.emplace_back();
    sheet.mesh = GridDesc{.size = {0.8f, 0.8f}, .resolution = {16, 16}};
    sheet.transform = {.position = {0, 0.27f, 0}};
    for (ColliderDesc& collider : colliders) {
        collider.transform.rotation_degrees = {20, 30, 40};
        scene.colliders.push_back(std::move(collider));
    }
    return scene;
}

// Labels: slow
TEST(VulkanMeshColliders, have_the_bits_of_the_cpu) {
    const ColliderDesc shapes[] = {
        {.shape = SolidMeshDesc{.mesh = make_sphere(0.25f, 3), .resolution = 24}},
        {.shape = ConvexDesc{.mesh = make_box({0.4f, 0.5f, 0.3f}, {2, 2, 2}), .radius = 0.02f}},
        {.shape = TaperedCapsuleDesc{{0.2f, 0.1f}, 0.1f}},
    };
    for (const ColliderDesc& shape : shapes) {
        auto cpu = SceneWorld::create(sheet_on({shape}), {.backend = "cpu"});
        auto vulkan = SceneWorld::create(sheet_on({shape}), {.backend = "vulkan"});
        ASSERT_TRUE(cpu.ok() && vulkan.ok());
        for (int i = 0; i < 20; ++i) cpu->advance(), vulkan->advance();
        const auto a = cpu->world().frame().cloths[0].positions, b = vulkan->world().frame().cloths[0].positions;
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t p = 0; p < a.size(); ++p) EXPECT_LT(length(a[p].xyz() - b[p].xyz()), 1e-3f);
        if (vulkan->world().backend().device().find("llvmpipe") != std::string::npos) {
            EXPECT_EQ(vulkan->world().state_hash(), cpu->world().state_hash());
        }
    }
}

// Uploads and frees data while frames run.
TEST(VulkanMeshColliders, come_and_go) {
    auto world = SceneWorld::create(sheet_on({}), {.backend = "vulkan"});
    ASSERT_TRUE(world.ok());
    world->advance();
    const std::uint64_t before = world->world().backend().device_bytes();
    for (int i = 0; i < 3; ++i) {
        const auto added =
            world->add(ColliderDesc{.shape = SolidMeshDesc{.mesh = make_sphere(0.25f, 3), .resolution = 24}});
        ASSERT_TRUE(added.ok());
        for (int k = 0; k < 2; ++k) world->advance();
        EXPECT_GT(world->world().backend().device_bytes(), before);
        world->remove(*added);
        for (int k = 0; k < 2; ++k) world->advance();
    }
    EXPECT_LE(world->world().backend().device_bytes(), before);
}

}  // namespace
}  // namespace weft
