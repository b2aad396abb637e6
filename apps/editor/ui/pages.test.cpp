// Images of the page with every widget, drawn without a window.
#include "editor/ui/ui_renderer.h"
#include "editor/ui/widget_page.test.h"

#include "gpu/test_device.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <optional>
#include <utility>

namespace weft::editor {
namespace {

class PagesTest : public gpu::OnDevice {
  protected:
    void SetUp() override {
        OnDevice::SetUp();
        open();
        if (!device) return;
        auto made = UiRenderer::create(device);
        ASSERT_TRUE(made.ok()) << made.error().message();
        renderer.emplace(std::move(*made));
    }
    void TearDown() override {
        renderer.reset();
        OnDevice::TearDown();
    }
    Image8 picture(Ui& ui, WidgetPage& page, float width, float height, int frames = 4) {
        const ImDrawData* data = nullptr;
        for (int i = 0; i < frames; ++i) {
            ui.begin(width, height, clock += 0.02);
            if (ui.take_new_fonts()) {
                EXPECT_TRUE(renderer->set_fonts(*ImGui::GetIO().Fonts).ok());
            }
            page.build(ui);
            data = &ui.end();
        }
        auto drawn = renderer->picture(*data, ui.theme().colors.background);
        EXPECT_TRUE(drawn.ok()) << drawn.error().message();
        return drawn ? std::move(*drawn) : Image8{};
    }
    // For a person who looks at it: WEFT_UI_PICTURES names a folder.
    static void keep(const Image8& image, const std::string& name) {
        const char* folder = std::getenv("WEFT_UI_PICTURES");
        if (!folder) return;
        std::ofstream out(std::string(folder) + "/" + name + ".ppm", std::ios::binary);
        out << "P6\n" << image.width << " " << image.height << "\n255\n";
        for (std::size_t i = 0; i < image.rgba.size(); i += 4)
            out.write(reinterpret_cast<const char*>(&image.rgba[i]), 3);
    }

    std::optional<UiRenderer> renderer;
    double clock = 0;
};

TEST_F(PagesTest, every_widget_in_both_appearances_and_at_two_scales) {
    if (!renderer) return;
    WidgetPage page;
    page.view = renderer->add_image();
    Image8 gradient{64, 36, std::vector<std::uint8_t>(64 * 36 * 4, 255)};
    for (std::uint32_t y = 0; y < 36; ++y)
        for (std::uint32_t x = 0; x < 64; ++x) {
            gradient.at(x, y)[0] = static_cast<std::uint8_t>(x * 4);
            gradient.at(x, y)[1] = static_cast<std::uint8_t>(y * 7);
        }
    ASSERT_TRUE(renderer->update(page.view, gradient).ok());
    for (const Appearance appearance : {Appearance::dark, Appearance::light}) {
        for (const float scale : {1.0f, 2.0f}) {
            Ui ui({.appearance = appearance, .scale = scale});
            const Image8 image = picture(ui, page, 1280 * scale, 720 * scale);
            ASSERT_EQ(image.width, static_cast<std::uint32_t>(1280 * scale));
            keep(image, std::string(appearance == Appearance::dark ? "dark" : "light") + (scale > 1 ? "_200" : "_100"));
        }
    }
}

// A frame of one function on a black ground.
class DrawTest : public PagesTest {
  protected:
    Image8 drawn(const std::function<void(ImDrawList&)>& content) {
        ui.begin(64, 48, clock += 0.02);
        if (ui.take_new_fonts()) {
            EXPECT_TRUE(renderer->set_fonts(*ImGui::GetIO().Fonts).ok());
        }
        content(*ImGui::GetForegroundDrawList());
        auto image = renderer->picture(ui.end(), ImVec4(0, 0, 0, 1));
        EXPECT_TRUE(image.ok()) << image.error().message();
        return image ? std::move(*image) : Image8{64, 48, std::vector<std::uint8_t>(64 * 48 * 4)};
    }
    static std::array<int, 3> at(const Image8& image, std::uint32_t x, std::uint32_t y) {
        const std::uint8_t* pixel = image.at(x, y);
        return {pixel[0], pixel[1], pixel[2]};
    }
    Ui ui;
};

using Bytes = std::array<int, 3>;

TEST_F(DrawTest, colors_arrive_as_they_are_and_blend_encoded) {
    if (!renderer) return;
    const Image8 image = drawn([](ImDrawList& list) {
        list.AddRectFilled(ImVec2(8, 8), ImVec2(24, 24), IM_COL32(10, 100, 200, 255));
        list.AddRectFilled(ImVec2(32, 8), ImVec2(40, 24), IM_COL32(255, 255, 255, 128));
    });
    EXPECT_EQ(at(image, 16, 16), (Bytes{10, 100, 200}));
    EXPECT_EQ(at(image, 4, 4), (Bytes{0, 0, 0}));
    EXPECT_EQ(at(image, 36, 16), (Bytes{128, 128, 128})) << "half of white is gray 128, not light gray";
    EXPECT_EQ(image.at(36, 16)[3], 255);
}

TEST_F(DrawTest, clips_to_the_pixel) {
    if (!renderer) return;
    const Image8 image = drawn([](ImDrawList& list) {
        list.PushClipRect(ImVec2(10, 12), ImVec2(20, 22));
        list.AddRectFilled(ImVec2(-100, -100), ImVec2(200, 200), IM_COL32(255, 0, 0, 255));
        list.PopClipRect();
        list.PushClipRect(ImVec2(50, 40), ImVec2(500, 400));  // beyond the image
        list.AddRectFilled(ImVec2(0, 0), ImVec2(900, 900), IM_COL32(0, 255, 0, 255));
        list.PopClipRect();
        list.PushClipRect(ImVec2(-50, -40), ImVec2(-5, -4));
        list.AddRectFilled(ImVec2(-90, -90), ImVec2(900, 900), IM_COL32(0, 0, 255, 255));
        list.PopClipRect();
    });
    EXPECT_EQ(at(image, 10, 12), (Bytes{255, 0, 0}));
    EXPECT_EQ(at(image, 19, 21), (Bytes{255, 0, 0}));
    for (const auto& [x, y] : {std::pair{9u, 12u}, {10u, 11u}, {20u, 21u}, {19u, 22u}})
        EXPECT_EQ(at(image, x, y), (Bytes{0, 0, 0}));
    EXPECT_EQ(at(image, 63, 47), (Bytes{0, 255, 0}));
}

TEST_F(DrawTest, images_are_exact_and_are_replaced) {
    if (!renderer) return;
    const UiImage id = renderer->add_image(), empty = renderer->add_image();
    const auto show = [&] {
        return drawn([&](ImDrawList& list) {
            list.AddImage(texture_id(id), ImVec2(8, 8), ImVec2(16, 16));
            list.AddImage(texture_id(empty), ImVec2(32, 8), ImVec2(40, 16));  // has no content yet
        });
    };
    EXPECT_EQ(at(show(), 10, 10), (Bytes{0, 0, 0}));
    Image8 content{8, 8, std::vector<std::uint8_t>(256, 255)};
    for (int version = 0; version < 5; ++version) {
        for (std::uint32_t i = 0; i < 64; ++i) {
            content.rgba[4 * i] = static_cast<std::uint8_t>(i * 3 + static_cast<unsigned>(version));
            content.rgba[4 * i + 1] = static_cast<std::uint8_t>(200 - i);
        }
        ASSERT_TRUE(renderer->update(id, Image8{8, 8, std::vector<std::uint8_t>(256, 7)}).ok());  // never shown
        ASSERT_TRUE(renderer->update(id, content).ok());
        const Image8 image = show();
        for (std::uint32_t y = 0; y < 8; ++y)
            for (std::uint32_t x = 0; x < 8; ++x) {
                const std::uint8_t* want = content.at(x, y);
                ASSERT_EQ(at(image, 8 + x, 8 + y), (Bytes{want[0], want[1], want[2]})) << x << ", " << y;
            }
    }
    EXPECT_EQ(at(show(), 10, 10)[2], 255) << "it stays";
    ASSERT_TRUE(renderer->update(id, Image8{2, 2, std::vector<std::uint8_t>(16, 99)}).ok());
    EXPECT_EQ(at(show(), 12, 12), (Bytes{99 * 99 / 255, 99 * 99 / 255, 99 * 99 / 255})) << "another size, transparent";
    renderer->remove(id);
    EXPECT_EQ(at(show(), 12, 12), (Bytes{0, 0, 0}));
    EXPECT_TRUE(renderer->update(id, content).ok());
}

TEST_F(DrawTest, many_vertices_find_room) {
    if (!renderer) return;
    for (const int count : {10, 100000, 10}) {
        const Image8 image = drawn([&](ImDrawList& list) {
            for (int i = 0; i < count; ++i) list.AddRectFilled(ImVec2(0, 0), ImVec2(1, 1), IM_COL32(9, 9, 9, 255));
            list.AddRectFilled(ImVec2(60, 40), ImVec2(64, 48), IM_COL32(1, 2, 3, 255));
        });
        EXPECT_EQ(at(image, 62, 44), (Bytes{1, 2, 3})) << "after " << count;
    }
}

VolkDeviceTable intact;
bool lost = false;
VKAPI_ATTR VkResult VKAPI_CALL submit_or_lose(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos,
                                              VkFence fence) {
    return lost ? VK_ERROR_DEVICE_LOST : intact.vkQueueSubmit(queue, count, infos, fence);
}

TEST_F(DrawTest, a_lost_device_is_an_error_that_says_so) {
    if (!device) return;
    renderer.reset();
    device.reset();
    lost = false;
    open({.intercept = [](VolkDeviceTable& table) {
        intact = table;
        table.vkQueueSubmit = submit_or_lose;
    }});
    auto made = UiRenderer::create(device);
    ASSERT_TRUE(made.ok());
    renderer.emplace(std::move(*made));
    (void)drawn([](ImDrawList&) {});
    lost = true;
    ui.begin(64, 48, 1);
    const auto image = renderer->picture(ui.end(), ImVec4(0, 0, 0, 1));
    lost = false;
    ASSERT_FALSE(image.ok());
    EXPECT_NE(image.error().what.find("VK_ERROR_DEVICE_LOST"), std::string::npos) << image.error().what;
    EXPECT_EQ(image.error().fault, Fault::machine);
}

}  // namespace
}  // namespace weft::editor
