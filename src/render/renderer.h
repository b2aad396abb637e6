// Draws a Drawing from device buffers into an image on the device, in the same way for files and windows.
#pragma once

#include "base/image.h"
#include "gpu/device.h"
#include "look/material.h"
#include "render/drawing.h"

#include <memory>

namespace weft::render {

/// Width of the sun's shadow map in texels: 1.5 mm each over 3 m; and that of drafts.
inline constexpr std::uint32_t shadow_map_side = 2048, draft_shadow_map_side = 1024;

struct RendererOptions {
    /// Samples per pixel, 1…256. 1, 2 or 4 in one pass, if the device supports them; more by drawing the image
    /// repeatedly.
    std::uint32_t samples = 4;
    /// Less work per pixel, for images that must be ready soon: hard shadows from a smaller map, no ambient occlusion,
    /// no threads, reflections without detail, no transparent background.
    bool draft = false;
};

/// The image that a drawing is written to.
struct Target {
    VkImageView view = VK_NULL_HANDLE;
    VkFormat format = VK_FORMAT_R8G8B8A8_SRGB;  ///< if it does not encode sRGB, the shader does
    std::uint32_t width = 0, height = 0;
    VkImageLayout after = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;  ///< final layout; the old content is lost
};

class Renderer {
  public:
    /// Fails if the device's queue does not support drawing, or the device lacks a required feature.
    static Result<Renderer> create(std::shared_ptr<gpu::Device> device, const RendererOptions& options = {});
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;
    ~Renderer();

    const std::shared_ptr<gpu::Device>& device() const;
    /// The caller reads the maps that the material names. Null: the material has no such map.
    Result<MaterialId> add(const Material& material, const Image8* color_map = nullptr,
                           const Image8* normal_map = nullptr);
    /// Changes the numbers of a material; its weave and its maps stay. No frame in flight may use it.
    Result<void> change(MaterialId id, const Material& material);
    /// No frame in flight may use the material. Its number is reused.
    void remove(MaterialId material);
    /// Sets the surroundings and their light. Waits for the frames in flight.
    Result<void> surround(const Lighting& light, const ImageF* environment = nullptr);

    /// Records and submits a frame. Returns the value that the device's timeline reaches when the image is done. Waits
    /// for the frame before the last one, whose buffers it overwrites. `window`: semaphores of a window's image.
    Result<std::uint64_t> draw(const Drawing& drawing, const Target& target, gpu::BinarySemaphores window = {});
    /// Draws, waits and reads back. Colors of a transparent image are not multiplied by alpha.
    Result<Image8> picture(const Drawing& drawing, std::uint32_t width, std::uint32_t height);

  private:
    struct Impl;
    explicit Renderer(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace weft::render
