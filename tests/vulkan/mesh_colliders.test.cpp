// Shapes with data on the device.

#include "vulkan_fixture.h"

#include "mesh/procedural.h"
#include "solver/measures/statistics.h"
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

Vec3 center_of(std::span<const Vec4> positions) {
    Vec3 sum{};
    for (const Vec4& p : positions) sum = sum + p.xyz();
    return sum * (1.0f / static_cast<float>(positions.size()));
}

// Labels: slow no-asan
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
        if (rounds_like_the_cpu(vulkan->world())) {
            EXPECT_EQ(vulkan->world().state_hash(), cpu->world().state_hash());
        }
        // Folds grow from differences in rounding: on a GPU single particles are up to 3 cm apart, the sheet is not.
        EXPECT_LT(length(center_of(a) - center_of(b)), 2e-3f);
        const double depth = measure_penetration(vulkan->world().frame(), vulkan->world().colliders()).max;
        EXPECT_LT(depth, measure_penetration(cpu->world().frame(), cpu->world().colliders()).max + 1e-3);
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
