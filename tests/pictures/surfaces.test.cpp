// Drawing from buffers of the simulating device and from host copies gives the same image.

#include "measure.h"
#include "scenes.h"

#include "vulkan/interop.h"
#include "vulkan/vulkan_backend.h"
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

TEST_F(VulkanPicturesOfSurfaces, in_one_pass_and_in_two_are_the_same) {
    open("vulkan");
    if (HasFatalFailure()) return;
    const PictureDistance distance = distance_of(drawn({}), drawn({}, true));
    EXPECT_LT(distance.worst, 0.5);
    EXPECT_LT(distance.mean, 0.01);
}

}  // namespace
}  // namespace weft
