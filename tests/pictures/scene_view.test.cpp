// A view keeps no reference to the scene and no memory of removed cloths.

#include "scenes.h"

#include "collide/distance_field.h"
#include "cpu/cpu_backend.h"
#include "mesh/procedural.h"

#include <array>
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

// Labels: no-asan
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

// Labels: long no-asan
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

// The surface of a field takes the place of the collider's mesh, follows its pose, and leaves with it.
// Labels: no-asan
TEST_F(SceneViewTest, draws_and_frees_distance_fields) {
    const TriangleMesh mesh = make_sphere(0.2f, 4);
    auto field = build_distance_field(mesh.positions, mesh.triangles, {.cells = 24, .threads = 1});
    ASSERT_TRUE(field.ok());
    field->data.surface = mesh;
    const auto data = std::make_shared<const ShapeData>(std::move(field->data));
    const SceneDesc scene;
    World world(std::move(*make_cpu_backend()), {});
    const ViewOptions options{.width = 64, .height = 64, .samples = 1, .overlays = {"distance_fields"}};
    auto view = SceneView::create(device, scene, world, options);
    ASSERT_TRUE(view.ok()) << view.error().message();
    const auto picture = [&] {
        const auto image = view->picture(scene, world, {.position = {0, 0, 2}, .target = {}, .fov = 40});
        EXPECT_TRUE(image.ok()) << image.error().message();
        return image ? image->rgba : std::vector<std::uint8_t>{};
    };
    // Red, green and blue in the middle row.
    const auto at = [](const std::vector<std::uint8_t>& rgba, std::size_t x) {
        const std::uint8_t* p = &rgba.at(4 * (32 * 64 + x));
        return std::array<int, 3>{p[0], p[1], p[2]};
    };
    std::vector<std::uint64_t> empty;
    for (int round = 0; round < 3; ++round) {
        const auto nothing = picture();
        const ColliderId id = world.add(make_collider({.name = "ball", .shape = SolidMeshDesc{}}, data));
        const auto there = picture();
        const std::uint64_t with_field = device->memory().used();
        EXPECT_NE(at(there, 32), at(nothing, 32));
        EXPECT_EQ(at(there, 62), at(nothing, 62));
        view->set_overlays({});
        EXPECT_NE(picture(), there) << "its own material";
        view->set_overlays({find_overlay("distance_fields").value()});
        world.move(id, {{}, {0.7f, 0, 0}});
        world.step(1.0 / 60);
        EXPECT_NE(at(picture(), 62), at(nothing, 62)) << "moved";
        world.remove(id);
        picture();
        empty.push_back(device->memory().used());
        EXPECT_GT(with_field, empty.back() + mesh.positions.size() * sizeof(Vec3));
        EXPECT_EQ(empty.back(), empty.front());
    }
}

}  // namespace
}  // namespace weft
