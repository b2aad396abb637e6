// What a Renderer holds, and the parts of a frame.
#pragma once

#include "render/frame_data.h"
#include "render/frame_slot.h"
#include "render/material_set.h"
#include "render/pipelines.h"
#include "render/renderer.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace weft::render {

inline constexpr VkClearValue clear_nothing{};

template <class Value>
Result<void> take(Result<Value> made, Value& into) {
    if (!made) return made.errors();
    into = std::move(*made);
    return {};
}

/// Offsets of what a draw command reads.
struct Uniforms {
    std::uint32_t object = 0, material = 0;
};

/// Where a drawing's data is: offsets of uniform data, device addresses of the rest.
struct Placed {
    std::vector<std::uint32_t> frames;  // one per pass, and one for lines and points on top
    std::vector<Uniforms> objects, grounds;
    std::uint64_t lines = 0, lines_on_top = 0, points = 0, flat = 0;
};

/// The last pass and its pipeline, by format and layout of the target.
struct Presenting {
    VkFormat format{};
    VkImageLayout after{};
    bool straight = false;
    gpu::RenderPass pass;
    gpu::GraphicsPipeline pipeline;
};

struct Renderer::Impl {
    std::shared_ptr<gpu::Device> device;
    std::uint32_t samples = 1, repeats = 1, shadow_side = shadow_map_side;
    bool draft = false;
    VkFormat display = light_format;
    Passes passes;
    Pipelines pipelines;
    std::vector<Presenting> presenting;
    gpu::Sampler shadow_compare, nearest, around_sampler;

    gpu::Image shadow_map;
    gpu::Framebuffer shadow_frame;
    gpu::Buffer bounds, light;  // LightData
    MaterialSet materials;

    bool surrounded = false, has_environment = false;
    Surroundings surroundings;
    gpu::Image around, background;

    Targets targets;
    gpu::DescriptorSet depth_set, occlusion_set, scene_set, background_set, resolve_set, sheer_set, display_set;
    std::array<FrameSlot, 2> slots;
    std::uint32_t next_slot = 0;
    gpu::Image own;  // of picture()
    gpu::Buffer read_back;

    explicit Impl(std::shared_ptr<gpu::Device> d) : device(std::move(d)), materials(*device) {}
    ~Impl() {
        if (device->submitted() > 0) (void)device->wait(device->submitted());
    }

    Result<void> open(const RendererOptions& options);
    Result<void> make_fixed();
    Result<void> fit(std::uint32_t width, std::uint32_t height, bool sheer);
    Result<void> make_sets();
    Result<const Presenting*> presenting_for(const Target& target, bool straight);

    // renderer_frame.cpp
    Placed place(FrameSlot& slot, const Drawing& drawing);
    void push(gpu::Commands& commands, std::uint32_t frame, Uniforms of = {});
    void push(gpu::Commands& commands, std::uint32_t frame, std::uint64_t items, glm::vec4 numbers);
    Result<void> bind_uniforms(FrameSlot& slot);
    void record_sun(gpu::Commands& commands, const Drawing& drawing, const Placed& placed);
    void record_shadow(gpu::Commands& commands, const Drawing& drawing, const Placed& placed);
    void record_occlusion(gpu::Commands& commands, const Drawing& drawing, const Placed& placed, std::size_t pass);
    void record_lit(gpu::Commands& commands, const Drawing& drawing, const Placed& placed, std::size_t pass);
    void draw_sheer(gpu::Commands& commands, const Drawing& drawing, const Placed& placed, std::size_t pass);
    void record_sheer(gpu::Commands& commands, const Drawing& drawing, const Placed& placed, std::size_t pass);
    void record_resolve(gpu::Commands& commands, const Placed& placed, std::size_t pass, bool sheer);
    void record_top(gpu::Commands& commands, const Drawing& drawing, const Placed& placed);
    void draw_surface(gpu::Commands& commands, const Object& object);

    const gpu::Image& shown() const { return draft ? targets.lit : targets.display; }
    bool is_sheer(const Object& object) const {
        return object.scalars.values.address == 0 && materials.sheer(object.material);
    }
    void record(gpu::Commands& commands, const Drawing& drawing, const Placed& placed, bool sheer);
    Result<void> record_target(gpu::Commands& commands, FrameSlot& slot, const Target& target, const Presenting& onto,
                               const Placed& placed);
    Result<std::uint64_t> draw(const Drawing& drawing, const Target& target, gpu::BinarySemaphores window,
                               bool straight);
};

}  // namespace weft::render
