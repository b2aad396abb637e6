// All pipelines of the renderer.
#pragma once

#include "gpu/graphics_pipeline.h"
#include "gpu/pipeline.h"
#include "render/targets.h"

#include <array>
#include <optional>

namespace weft::render {

struct Pipelines {
    gpu::GraphicsPipeline shadow, shadow_sheer, depth, ground_depth, occlusion, occlusion_smooth, background, ground;
    std::array<gpu::GraphicsPipeline, 3> lit, sheer;  ///< both sides at once; front sides; back sides
    gpu::GraphicsPipeline line, line_on_top, point, flat;
    gpu::GraphicsPipeline resolve, resolve_sheer;
    std::optional<gpu::Pipeline> bounds, sun;

    static Result<Pipelines> create(const gpu::Device& device, const Passes& passes, std::uint32_t samples, bool draft);
};

/// The pipeline that writes to a target. `encode`: encodes sRGB. `straight`: colors are not multiplied by alpha.
Result<gpu::GraphicsPipeline> make_present(const gpu::Device& device, const gpu::RenderPass& pass, bool encode,
                                           bool straight);

}  // namespace weft::render
