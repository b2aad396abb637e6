// Drawing from buffers of the simulating device and from host copies gives the same image.

#include "measure.h"
#include "scenes.h"

#include "mesh/procedural.h"
#include "solver/model/cut.test.h"
#include "vulkan/interop.h"
#include "vulkan/vulkan_backend.h"
#include "weft/backends.h"
#include "weft/drawing_device.h"

#include <fstream>

namespace weft {
namespace {

class VulkanPicturesOfSurfaces : public testing::Test {
  protected:
    /// Opens a scene on `backend` and simulates some frames.
    void open(const std::string& backend) {
        const std::filesystem::path file = std::filesystem::path(WEFT_BINARY_DIR) / ("surfaces_" + backend + ".json");
        std::ofstream(file) << scene_text({.name = "surfaces", .look = "\"denim\"", .content = PictureContent::hung});
        Options options;
        options.backend = backend;
        auto opened = open_scene(file, options);
        ASSERT_TRUE(opened.ok()) << opened.error().message();
        session.emplace(std::move(*opened));
        for (int i = 0; i < 8; ++i) session->advance();
    }
    Image8 drawn(const ViewSources& sources, bool two_passes = false) {
        auto device = drawing_device(session->world(), "");
        EXPECT_TRUE(device.ok());
        auto view = SceneView::create(*device, session->scene(), session->world(),
                                      {.width = 160, .height = 90, .two_passes = two_passes, .overlays = {}}, sources);
        EXPECT_TRUE(view.ok()) << view.error().message();
        if (!view) return {};
        auto image =
            view->picture(session->scene(), session->world(), view->camera(session->scene(), session->world()));
        EXPECT_TRUE(image.ok()) << image.error().message();
        return image ? std::move(*image) : Image8{};
    }

    std::optional<SceneWorld> session;
};

// Labels: no-asan
TEST_F(VulkanPicturesOfSurfaces, from_the_device_and_from_the_host_are_the_same) {
    open("vulkan");
    if (HasFatalFailure()) return;
    const auto surface = surfaces_on_device(session->world());
    ASSERT_TRUE(surface);
    const Image8 from_device = drawn({.surface = surface, .read_picture = {}, .read_light = {}}), from_host = drawn({});
    EXPECT_EQ(distance_of(from_device, from_host).worst, 0);
    EXPECT_LT(distance_of(from_device, from_host).mean, 0.01);

    open("cpu");
    if (HasFatalFailure()) return;
    EXPECT_FALSE(surfaces_on_device(session->world()));
    EXPECT_TRUE(alike(distance_of(from_device, drawn({})))) << "and so is the CPU's";
}

// Labels: no-asan long
TEST_F(VulkanPicturesOfSurfaces, in_one_pass_and_in_two_are_the_same) {
    open("vulkan");
    if (HasFatalFailure()) return;
    const PictureDistance distance = distance_of(drawn({}), drawn({}, true));
    EXPECT_LT(distance.worst, 0.5);
    EXPECT_LT(distance.mean, 0.01);
}

std::shared_ptr<const ClothModel> sheet_to_part() {
    constexpr std::uint32_t side = 17;
    TriangleMesh mesh = make_grid({1, 1}, {side, side}, GridDiagonal::alternating);
    ClothModelDesc desc{.name = "sheet", .reserve = {32, 128}};
    for (std::uint32_t p = 0; p < mesh.positions.size(); ++p) {
        Vec3& at = mesh.positions[p];
        if (at.z < -0.49f && std::abs(at.x) > 0.49f) desc.pins.particles.push_back(p);
        at = {at.x, -at.z, 0};
    }
    auto topology = build_topology(mesh, {.reorder = false});
    desc.mesh = std::move(mesh);
    auto built = build_cloth_model(std::move(desc), std::move(*topology));
    EXPECT_TRUE(built.ok());
    return *built;
}

// A view that has drawn the whole cloth draws the parts as a new view does.
// Labels: long
TEST(VulkanPictures, of_cloth_that_parts_are_those_of_a_new_view) {
    const std::vector<std::vector<std::string>> overlays = {
        {}, {"wireframe", "normals", "pins", "constraints"}, {"strain"}, {"bending"}, {"tension"}};
    for (const std::string backend : {"cpu", "vulkan"}) {
        Options options;
        options.backend = backend;
        auto made = make_backend(options);
        ASSERT_TRUE(made.ok()) << made.error().message();
        WorldSettings settings;
        settings.solver.substeps = 10;
        World world(std::move(*made), settings);
        const ClothId id = world.add(sheet_to_part());
        const SceneDesc scene;
        const Camera camera{.position = {0, 0, 3}, .target = {}, .fov = 40};
        auto device = drawing_device(world, "");
        ASSERT_TRUE(device.ok());
        const ViewSources sources{.surface = surfaces_on_device(world), .read_picture = {}, .read_light = {}};
        const auto new_view = [&](std::size_t i) {
            auto view = SceneView::create(*device, scene, world, {.width = 160, .height = 160, .overlays = overlays[i]},
                                          sources);
            EXPECT_TRUE(view.ok()) << view.error().message();
            return std::move(*view);
        };
        const auto picture = [&](SceneView& view) {
            auto image = view.picture(scene, world, camera);
            EXPECT_TRUE(image.ok()) << image.error().message();
            return image ? std::move(*image) : Image8{};
        };
        std::vector<SceneView> views;
        std::vector<Image8> whole;
        world.step(1.0 / 60);
        for (std::size_t i = 0; i < overlays.size(); ++i) {
            views.push_back(new_view(i));
            whole.push_back(picture(views[i]));
        }
        const ClothEdit edit = test::cut(
            *world.model(id), [](std::uint32_t p) { return p % 17 == 8; }, [](std::uint32_t p) { return p % 17 > 8; });
        ASSERT_TRUE(world.edit(id, edit).ok());
        const std::uint32_t corner = world.model(id)->triangles()[300][0];
        ASSERT_TRUE(world.edit(id, {.triangles = {{300, {corner, corner, corner}, 0}}}).ok());
        for (const int frames : {0, 1, 20}) {
            for (int i = 0; i < frames; ++i) world.step(1.0 / 60);
            for (std::size_t i = 0; i < overlays.size(); ++i) {
                SceneView fresh = new_view(i);
                const Image8 now = picture(views[i]);
                EXPECT_EQ(now.rgba, picture(fresh).rgba) << backend << ", overlays " << i << ", " << frames;
                EXPECT_NE(now.rgba, whole[i].rgba);
            }
        }
        EXPECT_EQ(world.frame().reports, report_none);
    }
}

}  // namespace
}  // namespace weft
