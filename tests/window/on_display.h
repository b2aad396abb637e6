// For tests of windows: a display without a screen, and a device with validation layers.
#pragma once

#include "gpu/test_device.h"
#include "render/window.h"

#include "user_input.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>

namespace weft::render {

class OnDisplay : public gpu::OnDevice {
  protected:
    void SetUp() override {
        auto opened = Display::open();
        ASSERT_TRUE(opened.ok()) << opened.error().message();
        display = *opened;
        surface_extensions = display->surface_extensions();
        ASSERT_FALSE(surface_extensions.empty());
        OnDevice::SetUp();
        if (!instance) return;
        // The driver of a GPU may not support a display without a screen.
        for (const gpu::DeviceInfo& one : instance->devices())
            if (one.type == gpu::DeviceType::cpu && one.usable()) info = one;
        open(device_options);
    }
    void TearDown() override {
        input.reset();
        window.reset();
        OnDevice::TearDown();
        display.reset();
    }

    bool show_window(const gpu::SwapchainOptions& images = {}) {
        if (!device) return false;
        auto made =
            Window::create(display, device, {.title = "weft test", .width = 320, .height = 200, .images = images});
        EXPECT_TRUE(made.ok()) << made.error().message();
        if (!made) return false;
        window.emplace(std::move(*made));
        input.emplace("weft test");
        return true;
    }

    gpu::SwapchainImage next() {
        auto image = window->next();
        EXPECT_TRUE(image.ok()) << image.error().message();
        return image ? *image : gpu::SwapchainImage{};
    }

    /// Processes events until the condition holds. False after a timeout.
    bool until(const std::function<bool()>& so) {
        for (int i = 0; i < 1000; ++i) {
            if (so()) return true;
            (void)window->input(0.02);
        }
        return false;
    }
    /// Whether this pixel of the window takes this color, ± 1 per channel, before a timeout.
    bool shown(const std::array<int, 3>& bytes, int x, int y) {
        return until([&] {
            const auto color = input->color(x, y);
            for (std::size_t i = 0; i < 3; ++i)
                if (std::abs(color[i] - bytes[i]) > 1) return false;
            return true;
        });
    }

    gpu::DeviceOptions device_options;
    std::shared_ptr<const Display> display;
    std::optional<Window> window;
    std::optional<UserInput> input;
};

}  // namespace weft::render
