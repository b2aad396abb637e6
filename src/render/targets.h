// The pictures that a frame is made in, of one size.
#pragma once

#include "gpu/graphics_pipeline.h"
#include "gpu/image.h"
#include "gpu/render_pass.h"

#include <cstdint>

namespace weft::render {

/// The passes of a frame, whatever its size. In the order in which they run.
struct Passes {
    gpu::RenderPass shadow;     ///< depth as the sun sees it
    gpu::RenderPass depth;      ///< depth as the eye sees it, a sample a pixel
    gpu::RenderPass occlusion;  ///< what is left of the light around, and the depth
    gpu::RenderPass lit;        ///< all that is solid
    gpu::RenderPass sheer;      ///< what is not: sums, optical depth
    gpu::RenderPass first;      ///< samples to colors for a screen
    gpu::RenderPass further;    ///< likewise, added to those that are there
    gpu::RenderPass top;        ///< and what is on top of all

    static Result<Passes> create(const gpu::Device& device, std::uint32_t samples, VkFormat display);
};

inline constexpr VkFormat light_format = VK_FORMAT_R16G16B16A16_SFLOAT, depth_format = VK_FORMAT_D32_SFLOAT,
                          occlusion_format = VK_FORMAT_R16G16_SFLOAT;

/// For what is sheer; most scenes have nothing.
struct SheerTargets {
    gpu::Image sum, depth;
    gpu::Framebuffer frame;

    explicit operator bool() const { return static_cast<bool>(sum); }
};

struct Targets {
    std::uint32_t width = 0, height = 0;
    gpu::Image depth, occlusion, occlusion_smooth, lit, lit_depth, display;
    gpu::Framebuffer depth_frame, occlusion_frame, smooth_frame, lit_frame, display_frame;
    SheerTargets sheer;

    Result<Done> add_sheer(gpu::Device& device, const Passes& passes, std::uint32_t samples);

    static Result<Targets> create(gpu::Device& device, const Passes& passes, std::uint32_t width, std::uint32_t height,
                                  std::uint32_t samples, VkFormat display);
};

}  // namespace weft::render
