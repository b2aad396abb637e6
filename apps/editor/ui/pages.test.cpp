// Images of the page with every widget, drawn without a window.
#include "editor/ui/ui_renderer.h"
#include "editor/ui/widget_page.test.h"

#include "gpu/test_device.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>

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

}  // namespace
}  // namespace weft::editor
