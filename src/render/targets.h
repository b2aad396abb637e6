// Render passes and intermediate images of a frame.
#pragma once

#include "gpu/graphics_pipeline.h"
#include "gpu/image.h"
#include "gpu/render_pass.h"

#include <cstdint>

namespace weft::render {

/// The passes of a frame, independent of its size, in order of execution.
struct Passes {
    gpu::RenderPass shadow;     ///< depth seen from the sun
    gpu::RenderPass depth;      ///< depth seen from the eye, one sample per pixel
    gpu::RenderPass occlusion;  ///< ambient visibility, and the depth
    gpu::RenderPass lit;        ///< solid objects; all objects of a draft, in colors for a screen
    gpu::RenderPass sheer;      ///< sheer objects: sums, optical depth
    gpu::RenderPass first;      ///< resolves samples to colors for a screen
    gpu::RenderPass further;    ///< likewise, added to the colors of earlier passes
    gpu::RenderPass top;        ///< lines, points and flat triangles on top

    static Result<Passes> create(const gpu::Device& device, std::uint32_t samples, VkFormat display, bool draft);
};

inline constexpr VkFormat light_format = VK_FORMAT_R16G16B16A16_SFLOAT, depth_format = VK_FORMAT_D32_SFLOAT,
                          occlusion_format = VK_FORMAT_R16G16_SFLOAT, draft_format = VK_FORMAT_R8G8B8A8_SRGB;

/// Images for sheer objects. Made only for scenes that have some.
struct SheerTargets {
    gpu::Image sum, depth;
    gpu::Framebuffer frame;

    explicit operator bool() const { return static_cast<bool>(sum); }
};

struct Targets {
    std::uint32_t width = 0, height = 0;
    bool cleared = false;  ///< what drafts do not draw
    gpu::Image depth, occlusion, occlusion_smooth, lit, lit_depth;
    gpu::Image display;  ///< not of drafts: `lit` has its place
    gpu::Framebuffer depth_frame, occlusion_frame, smooth_frame, lit_frame, display_frame;
    SheerTargets sheer;

    Result<void> add_sheer(gpu::Device& device, const Passes& passes, std::uint32_t samples);

    static Result<Targets> create(gpu::Device& device, const Passes& passes, std::uint32_t width, std::uint32_t height,
                                  std::uint32_t samples, VkFormat display, bool draft);
};

}  // namespace weft::render
