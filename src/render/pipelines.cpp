#include "render/pipelines.h"

#include "gpu/device.h"
#include "render/shaders.h"

namespace weft::render {
namespace {

using gpu::Blend;
using gpu::DepthTest;
using gpu::GraphicsState;

/// Makes pipelines and collects failures.
class Maker {
  public:
    explicit Maker(const gpu::Device& device) : device_(device) {}

    void make(gpu::GraphicsPipeline& into, const gpu::RenderPass& pass, const char* vertex, const char* fragment,
              const GraphicsState& state, std::initializer_list<std::uint32_t> constants = {}) {
        if (!errors_.empty()) return;
        const gpu::GraphicsShaders shaders{shader(vertex), fragment ? shader(fragment) : gpu::Shader{}};
        auto made = gpu::GraphicsPipeline::create(device_, pass, shaders, state, {constants.begin(), constants.size()});
        if (made) {
            into = std::move(*made);
        } else {
            errors_ = made.errors();
        }
    }
    void make(std::optional<gpu::Pipeline>& into, const char* name) {
        if (!errors_.empty()) return;
        auto made = gpu::Pipeline::create(device_, shader(name));
        if (made) {
            into.emplace(std::move(*made));
        } else {
            errors_ = made.errors();
        }
    }
    const Errors& errors() const { return errors_; }

  private:
    const gpu::Device& device_;
    Errors errors_;
};

}  // namespace

Result<Pipelines> Pipelines::create(const gpu::Device& device, const Passes& passes, std::uint32_t samples,
                                    bool draft) {
    Pipelines all;
    Maker maker(device);
    const GraphicsState solid{.depth = DepthTest::write};
    maker.make(all.shadow, passes.shadow, "shadow_vert", nullptr, solid);
    maker.make(all.shadow_sheer, passes.shadow, "shadow_vert", "shadow_sheer_frag", solid);
    maker.make(all.depth, passes.depth, "depth_vert", nullptr, solid);
    maker.make(all.ground_depth, passes.depth, "ground_vert", nullptr, solid);
    maker.make(all.occlusion, passes.occlusion, "full_vert", "occlusion_frag", {});
    maker.make(all.occlusion_smooth, passes.occlusion, "full_vert", "occlusion_blur_frag", {});
    maker.make(all.background, passes.lit, "full_vert", "background_frag", {}, {0, 0, draft});
    // Alpha blends a ground that shows only its shadows. For any other ground, alpha is 1.
    maker.make(all.ground, passes.lit, "ground_vert", "ground_frag", {.depth = DepthTest::write, .blend = Blend::over},
               {0, 0, draft});
    constexpr VkCullModeFlags hidden[] = {VK_CULL_MODE_NONE, VK_CULL_MODE_BACK_BIT, VK_CULL_MODE_FRONT_BIT};
    for (std::uint32_t sides = 0; sides < 3; ++sides) {
        maker.make(all.lit[sides], passes.lit, "lit_vert", "lit_frag",
                   {.cull = hidden[sides], .depth = DepthTest::write}, {sides, 0, draft});
        maker.make(all.sheer[sides], draft ? passes.lit : passes.sheer, "lit_vert", draft ? "lit_frag" : "sheer_frag",
                   {.cull = hidden[sides], .depth = DepthTest::read, .blend = draft ? Blend::over : Blend::add},
                   {sides, 0, draft});
    }
    maker.make(all.line, passes.lit, "line_vert", "line_frag", {.depth = DepthTest::read, .blend = Blend::over});
    maker.make(all.line_on_top, passes.top, "line_vert", "line_frag", {.blend = Blend::over});
    maker.make(all.point, passes.top, "point_vert", "point_frag", {.blend = Blend::over});
    maker.make(all.flat, passes.top, "flat_vert", "flat_frag", {.blend = Blend::over});
    const bool several = samples > 1;
    maker.make(all.resolve, passes.further, "full_vert", several ? "resolve_multisampled_frag" : "resolve_frag",
               {.blend = Blend::add}, {samples});
    maker.make(all.resolve_sheer, passes.further, "full_vert",
               several ? "resolve_multisampled_sheer_frag" : "resolve_sheer_frag", {.blend = Blend::add}, {samples});
    maker.make(all.bounds, "bounds_comp");
    maker.make(all.sun, "sun_comp");
    if (!maker.errors().empty()) return maker.errors();
    return all;
}

Result<gpu::GraphicsPipeline> make_present(const gpu::Device& device, const gpu::RenderPass& pass, bool encode,
                                           bool straight) {
    const std::uint32_t constants[] = {encode, straight};
    return gpu::GraphicsPipeline::create(device, pass, {shader("full_vert"), shader("present_frag")}, {}, constants);
}

}  // namespace weft::render
