// A view keeps no reference to the scene and no memory of removed cloths.

#include "scenes.h"

#include "cpu/cpu_backend.h"
#include "mesh/procedural.h"

#include <fstream>
#include <vector>

namespace weft {
namespace {

class SceneViewTest : public gpu::OnDevice {
  protected:
    void SetUp() override {
        OnDevice::SetUp();
        if (!HasFatalFailure()) open();
    }
};

TEST_F(SceneViewTest, draws_the_same_when_the_owner_of_the_scene_has_moved) {
    const std::filesystem::path file = std::filesystem::path(WEFT_BINARY_DIR) / "moved.json";
    std::ofstream(file) << scene_text({.name = "moved", .look = "\"satin\""});
    Options options;
    options.backend = "cpu";
    auto opened = open_scene(file, options);
    ASSERT_TRUE(opened.ok()) << opened.error().message();
    auto first = std::make_unique<SceneWorld>(std::move(*opened));
    auto view = SceneView::create(device, first->scene(), first->world(),
                                  {.width = 64, .height = 36, .samples = 1, .overlays = {}});
    ASSERT_TRUE(view.ok()) << view.error().message();
    const auto picture_of = [&](SceneWorld& session) {
        auto image = view->picture(session.scene(), session.world(), view->camera(session.scene(), session.world()));
        EXPECT_TRUE(image.ok()) << image.error().message();
        return image ? image->rgba : std::vector<std::uint8_t>{};
    };
    const auto before = picture_of(*first);
    SceneWorld second(std::move(*first));
    first.reset();
    EXPECT_EQ(picture_of(second), before);
    EXPECT_FALSE(before.empty());
}

TEST_F(SceneViewTest, frees_what_has_left_the_world) {
    constexpr int cloths = 1000, models = 40, balls = 40;
    const TriangleMesh mesh = make_grid({0.1f, 0.1f}, {9, 9}, GridDiagonal::alternating);
    std::vector<std::shared_ptr<const ClothModel>> kinds;  // each has a material of its own
    for (int i = 0; i < models; ++i) {
        auto model = build_cloth_model({.name = "cloth " + std::to_string(i), .mesh = mesh}, *build_topology(mesh));
        ASSERT_TRUE(model.ok());
        kinds.push_back(*model);
    }
    const SceneDesc scene;
    World world(std::move(*make_cpu_backend()), {});
    auto view =
        SceneView::create(device, scene, world, {.width = 16, .height = 16, .samples = 1, .overlays = {"strain"}});
    ASSERT_TRUE(view.ok()) << view.error().message();
    const auto used_after_a_picture = [&] {
        const auto image = view->picture(scene, world, {});
        EXPECT_TRUE(image.ok()) << image.error().message();
        return device->memory().used();
    };
    // The buffers of the frames grow with the largest image and are kept.
    std::vector<std::uint64_t> empty, full;
    for (int round = 0; round < 3; ++round) {
        std::vector<ClothId> ids;
        std::vector<ColliderId> solids;
        for (int i = 0; i < cloths; ++i) ids.push_back(world.add(kinds[static_cast<std::size_t>(i % models)]));
        for (int i = 0; i < balls; ++i)
            solids.push_back(world.add(make_collider({.name = std::to_string(i), .shape = SphereDesc{0.1f}})));
        (void)used_after_a_picture();
        full.push_back(used_after_a_picture());
        for (const ClothId id : ids) world.remove(id);
        for (const ColliderId id : solids) world.remove(id);
        empty.push_back(used_after_a_picture());
    }
    constexpr std::uint64_t least_of_a_cloth = 81 * (3 * sizeof(Vec4)) + 128 * sizeof(Triangle);
    for (std::size_t round = 0; round < empty.size(); ++round) {
        EXPECT_EQ(empty[round], empty[0]) << "round " << round;
        EXPECT_EQ(full[round], full[0]) << "round " << round;
        EXPECT_GT(full[round] - empty[round], cloths * least_of_a_cloth);
    }
}

}  // namespace
}  // namespace weft
