// Draws a Drawing: from buffers on the device into a picture there, the same way for a file and for a window.
#pragma once

#include "base/image.h"
#include "gpu/device.h"
#include "look/material.h"
#include "render/drawing.h"

#include <memory>

namespace weft::render {

/// Texels across the map of the sun's shadows: 1.5 mm each over 3 m.
inline constexpr std::uint32_t shadow_map_side = 2048;

struct RendererOptions {
    /// A pixel: 1, 2 or 4 at once, if the device has so many; more, up to 256, by drawing the picture again and again.
    std::uint32_t samples = 4;
};

/// What a picture is put into.
struct Target {
    VkImageView view = VK_NULL_HANDLE;
    VkFormat format = VK_FORMAT_R8G8B8A8_SRGB;  ///< of those that don't encode sRGB, colors are encoded here
    std::uint32_t width = 0, height = 0;
    VkImageLayout after = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;  ///< as it is left; what was in it is gone
};

class Renderer {
  public:
    /// Fails where the device's queue does not draw, or it lacks what drawing needs.
    static Result<Renderer> create(std::shared_ptr<gpu::Device> device, const RendererOptions& options = {});
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;
    ~Renderer();

    const std::shared_ptr<gpu::Device>& device() const;
    /// Pictures that it names are read by the caller; without, it is as if it named none.
    Result<MaterialId> add(const Material& material, const Image8* color_map = nullptr,
                           const Image8* normal_map = nullptr);
    /// Nothing under way may be drawn with it. Its number is given out again.
    void remove(MaterialId material);
    /// What is around from now on, and what it lights. Waits for the frames under way.
    Result<Done> surround(const Lighting& light, const ImageF* environment = nullptr);

    /// Records and submits; returns the value that the device's timeline reaches when the picture is there. Waits for
    /// the frame before the last one, whose buffers it writes again. `window`: those of a window's image.
    Result<std::uint64_t> draw(const Drawing& drawing, const Target& target, gpu::BinarySemaphores window = {});
    /// Draws, waits and reads back. Colors of a transparent picture are not multiplied by alpha.
    Result<Image8> picture(const Drawing& drawing, std::uint32_t width, std::uint32_t height);

  private:
    struct Impl;
    explicit Renderer(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace weft::render
