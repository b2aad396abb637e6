// Windows, with GLFW. Use everything here from the main thread only.
#pragma once

#include "gpu/swapchain.h"
#include "render/window_events.h"
#include "render/window_input.h"

#include <weft/result.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace weft::render {

/// The display that windows open on.
class Display {
  public:
    /// Fails if there is no display. All callers share one object.
    static Result<std::shared_ptr<const Display>> open();
    ~Display();
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;

    /// For gpu::InstanceOptions. Empty if Vulkan does not support windows here.
    std::vector<std::string> surface_extensions() const;
    /// s: the clock of events.
    double now() const;
    /// Ends a wait for events, or the next one. Any thread may call this.
    void wake() const;

  private:
    Display() = default;
};

struct WindowOptions {
    std::string title = "weft";
    std::uint32_t width = 1280, height = 720;  ///< in the window system's units
    gpu::SwapchainOptions images = {};
};

class Window {
  public:
    /// The device's instance must have been made with the display's extensions.
    static Result<Window> create(std::shared_ptr<const Display> display, std::shared_ptr<gpu::Device> device,
                                 const WindowOptions& options = {});
    Window(Window&&) noexcept;
    Window& operator=(Window&&) noexcept;
    ~Window();

    /// Returns the events since the last call, in their order. `patience`: longest time to wait for the first one, s;
    /// infinity: until an event or Display::wake(). Use either this or input().
    std::vector<WindowEvent> events(double patience = 0);
    /// Returns the user input since the last call. Also collects events of other windows, which their own calls return.
    /// `patience`: longest time to wait for an event, s.
    WindowInput input(double patience = 0);
    /// Whether the user or close() asked to close the window. It stays open until it is destroyed.
    bool closed() const;
    void close();
    /// Takes back a request to close.
    void keep_open();
    void set_title(const std::string& title);
    void set_cursor(CursorShape shape);
    /// UTF-8; empty if the clipboard has no text.
    std::string clipboard() const;
    void set_clipboard(const std::string& text);
    /// The scale that the system asks for: 1 for 96 pixels per inch.
    float content_scale() const;
    /// Pixels per unit of the positions in events.
    float pixels_per_unit() const;
    /// Pixels; 0 while it is minimized.
    VkExtent2D extent() const;

    /// Properties of the next image. They may change if the surface is lost and made again.
    VkFormat format() const;
    bool encodes_srgb() const;
    VkPresentModeKHR mode() const;
    /// The next image to draw. Its state is `image` or `nothing`, for example while the window is minimized.
    Result<gpu::SwapchainImage> next();
    /// Presents the image. `done`: result of the submission that draws it.
    Result<void> show(const gpu::SwapchainImage& image, std::uint64_t done);

  private:
    struct Impl;
    explicit Window(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace weft::render
