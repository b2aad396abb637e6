// Windows, by GLFW. All of this is used from the program's first thread.
#pragma once

#include "gpu/swapchain.h"
#include "render/window_input.h"

#include <weft/result.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace weft::render {

/// Where windows can be opened.
class Display {
  public:
    /// Fails where there is none. It is one for all who have it.
    static Result<std::shared_ptr<const Display>> open();
    ~Display();
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;

    /// For gpu::InstanceOptions. Empty where Vulkan has nothing to do with windows.
    std::vector<std::string> surface_extensions() const;

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
    /// The device's instance was made with the display's extensions.
    static Result<Window> create(std::shared_ptr<const Display> display, std::shared_ptr<gpu::Device> device,
                                 const WindowOptions& options = {});
    Window(Window&&) noexcept;
    Window& operator=(Window&&) noexcept;
    ~Window();

    /// Hears what happened since the last call; of other windows too, which say it when they are asked. `patience`: how
    /// long it waits for something to happen, s.
    WindowInput input(double patience = 0);
    /// Somebody wants it closed; it stays until it is destroyed.
    bool closed() const;
    void close();
    void set_title(const std::string& title);
    /// Pixels; 0 while it is minimized.
    VkExtent2D extent() const;

    /// Those of its next image; another surface, after one is lost, may have others.
    VkFormat format() const;
    bool encodes_srgb() const;
    VkPresentModeKHR mode() const;
    /// What is drawn next: `image`, or `nothing`, as while it is minimized.
    Result<gpu::SwapchainImage> next();
    /// `done`: what the submit returned that draws it.
    Result<Done> show(const gpu::SwapchainImage& image, std::uint64_t done);

  private:
    struct Impl;
    explicit Window(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace weft::render
