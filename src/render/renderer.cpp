#include "render/renderer.h"

#include "gpu/borrowed_functions.h"
#include "render/frame_data.h"
#include "render/frame_slot.h"
#include "render/host_mesh.h"
#include "render/material_set.h"
#include "render/pipelines.h"
#include "render/texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace weft::render {
namespace {

constexpr std::uint32_t most_samples = 256;
constexpr VkClearValue clear_depth{.depthStencil = {1, 0}};
constexpr VkClearValue clear_nothing{};

// Same layout as in shaders (frame.data.h).
struct Push {
    std::uint64_t items = 0, unused = 0;
    glm::vec4 numbers{0};
};
constexpr std::uint32_t uniform_set = 2;
struct BoundsPush {
    std::uint64_t object = 0, bounds = 0;
    std::uint32_t count = 0, unused = 0;
};
struct SunPush {
    std::uint64_t frame = 0, bounds = 0, light = 0;
    float texels = 0, unused = 0;
};

bool encodes_srgb(VkFormat format) {
    return format == VK_FORMAT_R8G8B8A8_SRGB || format == VK_FORMAT_B8G8R8A8_SRGB ||
           format == VK_FORMAT_A8B8G8R8_SRGB_PACK32;
}

bool blends(const gpu::Device& device, VkFormat format) {
    VkFormatProperties properties{};
    const gpu::BorrowedFunctions functions(device);
    vkGetPhysicalDeviceFormatProperties(device.physical(), format, &properties);
    return (properties.optimalTilingFeatures & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT) != 0;
}

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

std::vector<shading::LineData> line_data(std::span<const Line> lines) {
    std::vector<shading::LineData> data;
    data.reserve(lines.size());
    for (const Line& line : lines) {
        data.push_back({{line.from.x, line.from.y, line.from.z, line.width},
                        {line.to.x, line.to.y, line.to.z, 0},
                        {line.color.x, line.color.y, line.color.z, line.color.w}});
    }
    return data;
}

std::uint64_t room_for(const Drawing& drawing, std::uint32_t passes) {
    using shading::FlatData, shading::FrameData, shading::LineData, shading::ObjectData, shading::PointData;
    // Each object may have a material of its own, and offset 0 must have room for any of them.
    const std::uint64_t of_object =
        FrameSlot::room_for_uniform<ObjectData>() + FrameSlot::room_for_uniform<shading::MaterialData>();
    return (passes + std::uint64_t{1}) * FrameSlot::room_for_uniform<FrameData>() +
           (drawing.objects.size() + drawing.grounds.size() + 1) * of_object +
           (drawing.lines.size() + drawing.lines_on_top.size()) * sizeof(LineData) +
           drawing.points.size() * sizeof(PointData) + drawing.flat.size() * sizeof(FlatData) + 128;
}

/// The last pass and its pipeline, by format and layout of the target.
struct Presenting {
    VkFormat format{};
    VkImageLayout after{};
    bool straight = false;
    gpu::RenderPass pass;
    gpu::GraphicsPipeline pipeline;
};

}  // namespace

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

// --- Independent of the image's size

Result<void> Renderer::Impl::open(const RendererOptions& options) {
    const std::string& name = device->info().name;
    if (!device->draws()) return Error::of_machine(name, "has no graphics queue; choose another device");
    const std::uint32_t wanted = std::clamp(options.samples, 1u, most_samples);
    samples = options.draft ? 1 : gpu::supported_samples(*device, std::min(wanted, 4u));
    repeats = options.draft ? 1 : (wanted + samples - 1) / samples;
    if (repeats > 1 && blends(*device, VK_FORMAT_R32G32B32A32_SFLOAT)) display = VK_FORMAT_R32G32B32A32_SFLOAT;
    if (auto made = take(Passes::create(*device, samples, display, options.draft), passes); !made) return made;
    draft = options.draft;
    if (draft) shadow_side = draft_shadow_map_side;
    if (auto made = take(Pipelines::create(*device, passes, samples, draft), pipelines); !made) return made;
    return make_fixed();
}

Result<void> Renderer::Impl::make_fixed() {
    constexpr auto clamp = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    const gpu::SamplerDesc compare{.address_u = clamp, .address_v = clamp, .compare = true};
    const gpu::SamplerDesc point{.filter = VK_FILTER_NEAREST, .address_u = clamp, .address_v = clamp};
    if (auto made = take(gpu::Sampler::create(*device, compare), shadow_compare); !made) return made;
    if (auto made = take(gpu::Sampler::create(*device, point), nearest); !made) return made;
    if (auto made = take(gpu::Sampler::create(*device, {.address_v = clamp}), around_sampler); !made) return made;
    const gpu::ImageDesc map{.width = shadow_side,
                             .height = shadow_side,
                             .format = depth_format,
                             .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT};
    if (auto made = take(gpu::Image::create(*device, map, "shadow"), shadow_map); !made) return made;
    const VkImageView view = shadow_map.view();
    auto frame = gpu::Framebuffer::create(*device, passes.shadow, {&view, 1}, shadow_side, shadow_side);
    if (auto made = take(std::move(frame), shadow_frame); !made) return made;
    gpu::Memory& memory = device->memory();
    if (auto made = take(memory.buffer(32, gpu::MemoryKind::device, "bounds"), bounds); !made) return made;
    return take(
        memory.buffer(sizeof(shading::LightData), gpu::MemoryKind::device, "sun", VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT),
        light);
}

// --- Dependent on the image's size

Result<void> Renderer::Impl::fit(std::uint32_t width, std::uint32_t height, bool sheer) {
    const bool same = targets.width == width && targets.height == height;
    if (same && (targets.sheer || !sheer || draft) && display_set.handle() != VK_NULL_HANDLE) return {};
    if (auto idle = device->wait(device->submitted()); !idle) return idle;
    if (!same) {
        targets = {};
        auto made = Targets::create(*device, passes, width, height, samples, display, draft);
        if (!made) return made.errors();
        targets = std::move(*made);
    }
    if (sheer && !draft) {
        if (auto added = targets.add_sheer(*device, passes, samples); !added) return added;
    }
    return make_sets();
}

Result<void> Renderer::Impl::make_sets() {
    constexpr VkImageLayout depth_layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
    const auto make = [&](gpu::DescriptorSet& into, const gpu::GraphicsPipeline& pipeline,
                          std::initializer_list<gpu::BoundImage> images) {
        return take(gpu::DescriptorSet::create(*device, pipeline.set_layout(0), {images.begin(), images.size()}), into);
    };
    const auto drawn = [&](std::uint32_t binding, const gpu::Image& image) {
        return gpu::BoundImage{binding, image.view(), nearest.handle()};
    };
    const gpu::BoundImage behind{0, background.view(), around_sampler.handle()};
    Result<void> made =
        make(depth_set, pipelines.occlusion, {{0, targets.depth.view(), nearest.handle(), depth_layout}});
    if (made) made = make(occlusion_set, pipelines.occlusion_smooth, {drawn(0, targets.occlusion)});
    if (made) {
        made = make(scene_set, pipelines.lit[0],
                    {{0, shadow_map.view(), shadow_compare.handle(), depth_layout},
                     {1, shadow_map.view(), nearest.handle(), depth_layout},
                     drawn(2, targets.occlusion_smooth),
                     {3, around.view(), around_sampler.handle()},
                     {4, background.view(), around_sampler.handle()}});
    }
    if (made) made = make(background_set, pipelines.background, {behind});
    if (made) made = make(resolve_set, pipelines.resolve, {drawn(0, targets.lit)});
    if (made && targets.sheer) {
        made = make(sheer_set, pipelines.resolve_sheer,
                    {drawn(0, targets.lit), drawn(1, targets.sheer.sum), drawn(2, targets.sheer.depth)});
    }
    if (made && !presenting.empty()) made = make(display_set, presenting.front().pipeline, {drawn(0, shown())});
    return made;
}

Result<const Presenting*> Renderer::Impl::presenting_for(const Target& target, bool straight) {
    for (const Presenting& one : presenting)
        if (one.format == target.format && one.after == target.after && one.straight == straight) return &one;
    Presenting one{target.format, target.after, straight, {}, {}};
    const gpu::Attachment attachment{.format = target.format, .after = target.after};
    if (auto made = take(gpu::RenderPass::create(*device, {&attachment, 1}, "present"), one.pass); !made)
        return made.errors();
    auto pipeline = make_present(*device, one.pass, !encodes_srgb(target.format), straight);
    if (auto made = take(std::move(pipeline), one.pipeline); !made) return made.errors();
    presenting.push_back(std::move(one));
    return &presenting.back();
}

// --- A frame

Placed Renderer::Impl::place(FrameSlot& slot, const Drawing& drawing) {
    Placed placed;
    FrameShape shape{targets.width, targets.height, {0, 0}, 0, has_environment};
    for (std::uint32_t pass = 0; pass <= repeats; ++pass) {
        shape.number = pass;
        shape.jitter = pass < repeats ? jitter_of(pass, repeats) : glm::vec2(0);
        placed.frames.push_back(slot.put_uniform(frame_data(drawing, surroundings, shape)));
    }
    std::map<MaterialId, std::uint32_t> placed_materials;
    const auto material = [&](MaterialId id) {
        const auto [entry, is_new] = placed_materials.try_emplace(id);
        if (is_new) entry->second = slot.put_uniform(materials.data(id));
        return entry->second;
    };
    for (const Object& object : drawing.objects)
        placed.objects.push_back({slot.put_uniform(object_data(object)), material(object.material)});
    for (const Ground& ground : drawing.grounds)
        placed.grounds.push_back({slot.put_uniform(ground_data(ground, drawing.camera)), material(ground.material)});
    placed.lines = slot.put(std::span<const shading::LineData>(line_data(drawing.lines)));
    placed.lines_on_top = slot.put(std::span<const shading::LineData>(line_data(drawing.lines_on_top)));
    std::vector<shading::PointData> points;
    for (const Point& p : drawing.points) {
        points.push_back(
            {{p.position.x, p.position.y, p.position.z, p.size}, {p.color.x, p.color.y, p.color.z, p.color.w}});
    }
    placed.points = slot.put(std::span<const shading::PointData>(points));
    std::vector<shading::FlatData> corners;
    for (const FlatVertex& v : drawing.flat)
        corners.push_back({{v.x, v.y, 0, 0}, {v.color.x, v.color.y, v.color.z, v.color.w}});
    placed.flat = slot.put(std::span<const shading::FlatData>(corners));
    return placed;
}

Result<void> Renderer::Impl::bind_uniforms(FrameSlot& slot) {
    const VkBuffer buffer = slot.buffer().handle();
    const gpu::BoundUniform uniforms[] = {{0, buffer, sizeof(shading::FrameData)},
                                          {1, buffer, sizeof(shading::ObjectData)},
                                          {2, buffer, sizeof(shading::MaterialData)},
                                          {3, light.handle(), sizeof(shading::LightData)}};
    return take(gpu::DescriptorSet::create(*device, pipelines.lit[0].set_layout(uniform_set), {}, uniforms),
                slot.uniforms);
}

void Renderer::Impl::push(gpu::Commands& commands, std::uint32_t frame, Uniforms of) {
    const std::uint32_t offsets[] = {frame, of.object, of.material, 0};
    commands.bind(uniform_set, slots[next_slot].uniforms, offsets);
}

void Renderer::Impl::push(gpu::Commands& commands, std::uint32_t frame, std::uint64_t items, glm::vec4 numbers) {
    push(commands, frame);
    const Push values{items, 0, numbers};
    commands.push(std::as_bytes(std::span(&values, 1)));
}

void Renderer::Impl::draw_surface(gpu::Commands& commands, const Object& object) {
    commands.draw_indexed(object.surface.triangles, 3 * object.surface.triangle_count);
}

// The bounds of all shadow casters are computed on the device, because the host may not have the positions.
void Renderer::Impl::record_sun(gpu::Commands& commands, const Drawing& drawing, const Placed& placed) {
    const std::uint64_t uniforms = slots[next_slot].buffer().address();
    commands.drawing_barrier();
    commands.fill(bounds, 0xffffffffu, 12, 0);
    commands.fill(bounds, 0, 12, 12);
    commands.barrier();
    commands.bind(*pipelines.bounds);
    for (std::size_t i = 0; i < drawing.objects.size(); ++i) {
        const Object& object = drawing.objects[i];
        if (!object.casts_shadow || object.surface.vertex_count == 0) continue;
        const BoundsPush values{uniforms + placed.objects[i].object, bounds.address(), object.surface.vertex_count};
        commands.push(std::as_bytes(std::span(&values, 1)).first(20));
        commands.dispatch(std::min(64u, (object.surface.vertex_count + 63) / 64));
    }
    commands.barrier();
    commands.bind(*pipelines.sun);
    const SunPush values{uniforms + placed.frames[0], bounds.address(), light.address(),
                         static_cast<float>(shadow_side)};
    commands.push(std::as_bytes(std::span(&values, 1)).first(28));
    commands.dispatch(1);
    commands.drawing_barrier();
}

void Renderer::Impl::record_shadow(gpu::Commands& commands, const Drawing& drawing, const Placed& placed) {
    commands.begin_pass(passes.shadow, shadow_frame, {&clear_depth, 1});
    for (std::size_t i = 0; i < drawing.objects.size() && drawing.lighting.sun.intensity > 0; ++i) {
        const Object& object = drawing.objects[i];
        if (!object.casts_shadow || object.surface.triangle_count == 0) continue;
        commands.bind(is_sheer(object) ? pipelines.shadow_sheer : pipelines.shadow);
        push(commands, placed.frames[0], placed.objects[i]);
        draw_surface(commands, object);
    }
    commands.end_pass();
}

void Renderer::Impl::record_occlusion(gpu::Commands& commands, const Drawing& drawing, const Placed& placed,
                                      std::size_t pass) {
    const bool wanted = !draft && drawing.lighting.ambient_occlusion > 0;
    commands.begin_pass(passes.depth, targets.depth_frame, {&clear_depth, 1});
    if (wanted) {
        commands.bind(pipelines.depth);
        for (std::size_t i = 0; i < drawing.objects.size(); ++i) {
            if (is_sheer(drawing.objects[i]) || drawing.objects[i].surface.triangle_count == 0) continue;
            push(commands, placed.frames[pass], placed.objects[i]);
            draw_surface(commands, drawing.objects[i]);
        }
        commands.bind(pipelines.ground_depth);
        for (const Uniforms& ground : placed.grounds) {
            push(commands, placed.frames[pass], ground);
            commands.draw(6);
        }
    }
    commands.end_pass();
    const auto full = [&](const gpu::Framebuffer& into, const gpu::GraphicsPipeline& pipeline,
                          const gpu::DescriptorSet& images) {
        commands.begin_pass(passes.occlusion, into, {&clear_nothing, 1});
        if (wanted) {
            commands.bind(pipeline);
            commands.bind(0, images);
            push(commands, placed.frames[pass]);
            commands.draw(3);
        }
        commands.end_pass();
    };
    full(targets.occlusion_frame, pipelines.occlusion, depth_set);
    full(targets.smooth_frame, pipelines.occlusion_smooth, occlusion_set);
}

void Renderer::Impl::record_lit(gpu::Commands& commands, const Drawing& drawing, const Placed& placed,
                                std::size_t pass) {
    const std::uint32_t frame = placed.frames[pass];
    const VkClearValue clear[] = {clear_nothing, clear_depth};
    commands.begin_pass(passes.lit, targets.lit_frame, clear);
    if (drawing.background == Background::sky) {
        commands.bind(pipelines.background);
        commands.bind(0, background_set);
        push(commands, frame);
        commands.draw(3);
    }
    const auto surfaces = [&](const gpu::GraphicsPipeline& pipeline) {
        commands.bind(pipeline);
        commands.bind(0, scene_set);
        for (std::size_t i = 0; i < drawing.objects.size(); ++i) {
            const Object& object = drawing.objects[i];
            if (is_sheer(object) || object.surface.triangle_count == 0) continue;
            commands.bind(1, materials.images(object.material));
            push(commands, frame, placed.objects[i]);
            draw_surface(commands, object);
        }
    };
    if (drawing.two_passes) {
        surfaces(pipelines.lit[1]);
        surfaces(pipelines.lit[2]);
    } else {
        surfaces(pipelines.lit[0]);
    }
    commands.bind(pipelines.ground);
    commands.bind(0, scene_set);
    for (std::size_t i = 0; i < drawing.grounds.size(); ++i) {
        commands.bind(1, materials.images(drawing.grounds[i].material));
        push(commands, frame, placed.grounds[i]);
        commands.draw(6);
    }
    if (draft) draw_sheer(commands, drawing, placed, pass);
    if (!drawing.lines.empty()) {
        constexpr float nearer = 2e-5f;  // of the depth range: about a tenth of a millimeter
        commands.bind(pipelines.line);
        push(commands, frame, placed.lines, {nearer, 0, 0, 0});
        commands.draw(6 * static_cast<std::uint32_t>(drawing.lines.size()));
    }
    commands.end_pass();
}

void Renderer::Impl::draw_sheer(gpu::Commands& commands, const Drawing& drawing, const Placed& placed,
                                std::size_t pass) {
    const auto surfaces = [&](const gpu::GraphicsPipeline& pipeline) {
        commands.bind(pipeline);
        commands.bind(0, scene_set);
        for (std::size_t i = 0; i < drawing.objects.size(); ++i) {
            const Object& object = drawing.objects[i];
            if (!is_sheer(object) || object.surface.triangle_count == 0) continue;
            commands.bind(1, materials.images(object.material));
            push(commands, placed.frames[pass], placed.objects[i]);
            draw_surface(commands, object);
        }
    };
    if (drawing.two_passes) {
        surfaces(pipelines.sheer[1]);
        surfaces(pipelines.sheer[2]);
    } else {
        surfaces(pipelines.sheer[0]);
    }
}

void Renderer::Impl::record_sheer(gpu::Commands& commands, const Drawing& drawing, const Placed& placed,
                                  std::size_t pass) {
    const VkClearValue clear[] = {clear_nothing, clear_nothing, clear_depth};
    commands.begin_pass(passes.sheer, targets.sheer.frame, clear);
    draw_sheer(commands, drawing, placed, pass);
    commands.end_pass();
}

void Renderer::Impl::record_resolve(gpu::Commands& commands, const Placed& placed, std::size_t pass, bool sheer) {
    commands.begin_pass(pass == 0 ? passes.first : passes.further, targets.display_frame, {&clear_nothing, 1});
    commands.bind(sheer ? pipelines.resolve_sheer : pipelines.resolve);
    commands.bind(0, sheer ? sheer_set : resolve_set);
    push(commands, placed.frames[pass], 0, {1 / static_cast<float>(repeats), 0, 0, 0});
    commands.draw(3);
    commands.end_pass();
}

void Renderer::Impl::record_top(gpu::Commands& commands, const Drawing& drawing, const Placed& placed) {
    if (drawing.lines_on_top.empty() && drawing.points.empty() && drawing.flat.empty()) return;
    commands.begin_pass(passes.top, targets.display_frame, {&clear_nothing, 1});
    const auto add = [&](const gpu::GraphicsPipeline& pipeline, std::uint64_t data, std::size_t vertices) {
        if (vertices == 0) return;
        commands.bind(pipeline);
        push(commands, placed.frames.back(), data, glm::vec4(0));
        commands.draw(static_cast<std::uint32_t>(vertices));
    };
    add(pipelines.line_on_top, placed.lines_on_top, 6 * drawing.lines_on_top.size());
    add(pipelines.point, placed.points, 6 * drawing.points.size());
    add(pipelines.flat, placed.flat, drawing.flat.size());
    commands.end_pass();
}

void Renderer::Impl::record(gpu::Commands& commands, const Drawing& drawing, const Placed& placed, bool sheer) {
    record_sun(commands, drawing, placed);
    record_shadow(commands, drawing, placed);
    for (std::size_t pass = 0; pass < repeats; ++pass) {
        // A draft has no occlusion, but images that shaders name must have been written once.
        if (!draft || !targets.cleared) record_occlusion(commands, drawing, placed, pass);
        targets.cleared = true;
        record_lit(commands, drawing, placed, pass);
        if (draft) continue;
        if (sheer) record_sheer(commands, drawing, placed, pass);
        record_resolve(commands, placed, pass, sheer);
    }
    record_top(commands, drawing, placed);
}

Result<void> Renderer::Impl::record_target(gpu::Commands& commands, FrameSlot& slot, const Target& target,
                                           const Presenting& onto, const Placed& placed) {
    auto frame = gpu::Framebuffer::create(*device, onto.pass, {&target.view, 1}, target.width, target.height);
    if (auto made = take(std::move(frame), slot.target); !made) return made;
    commands.begin_pass(onto.pass, slot.target, {&clear_nothing, 1});
    commands.bind(onto.pipeline);
    commands.bind(0, display_set);
    push(commands, placed.frames.back());
    commands.draw(3);
    commands.end_pass();
    return {};
}

// Without a view, `target` has a size only: the image stays where it was drawn.
Result<std::uint64_t> Renderer::Impl::draw(const Drawing& drawing, const Target& target, gpu::BinarySemaphores window,
                                           bool straight) {
    const bool sheer = std::ranges::any_of(drawing.objects, [&](const Object& object) { return is_sheer(object); });
    const Presenting* onto = nullptr;
    if (target.view != VK_NULL_HANDLE) {
        if (auto made = take(presenting_for(target, straight), onto); !made) return made.errors();
    }
    if (auto fitted = fit(target.width, target.height, sheer); !fitted) return fitted.errors();
    FrameSlot& slot = slots[next_slot];
    if (slot.submitted > 0) {
        if (auto done = device->wait(slot.submitted); !done) return done.errors();
    }
    const auto begun = slot.begin(*device, room_for(drawing, repeats));
    if (!begun) return begun.errors();
    if (*begun) {
        if (auto bound = bind_uniforms(slot); !bound) return bound.errors();
    }
    gpu::Commands& commands = *slot.commands;
    const Placed placed = place(slot, drawing);
    record(commands, drawing, placed, sheer);
    if (onto) {
        if (auto recorded = record_target(commands, slot, target, *onto, placed); !recorded) return recorded.errors();
    }
    if (auto ended = commands.end(); !ended) return ended.errors();

    // All surfaces have times of the same timeline, so waiting for the latest is enough.
    gpu::Moment ready;
    for (const Object& object : drawing.objects) {
        const gpu::Moment one = object.surface.ready;
        if (one.semaphore != VK_NULL_HANDLE && (ready.semaphore == VK_NULL_HANDLE || ready.value < one.value))
            ready = one;
    }
    auto submitted = commands.submit(ready, window);
    if (!submitted) return submitted;
    slot.submitted = *submitted;
    next_slot = 1 - next_slot;
    return submitted;
}

// --- Public functions

Renderer::Renderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Result<Renderer> Renderer::create(std::shared_ptr<gpu::Device> device, const RendererOptions& options) {
    auto impl = std::make_unique<Impl>(std::move(device));
    if (auto opened = impl->open(options); !opened) return opened.errors();
    return Renderer(std::move(impl));
}

const std::shared_ptr<gpu::Device>& Renderer::device() const {
    return impl_->device;
}

Result<MaterialId> Renderer::add(const Material& material, const Image8* color_map, const Image8* normal_map) {
    return impl_->materials.add(material, {color_map, normal_map}, impl_->pipelines.lit[0].set_layout(1));
}

Result<void> Renderer::change(MaterialId id, const Material& material) {
    return impl_->materials.change(id, material);
}

void Renderer::remove(MaterialId material) {
    impl_->materials.remove(material);
}

Result<void> Renderer::surround(const Lighting& light, const ImageF* environment) {
    Impl& self = *impl_;
    self.surroundings = surroundings_of(light, environment);
    self.has_environment = environment != nullptr;
    if (auto idle = self.device->wait(self.device->submitted()); !idle) return idle;
    if (auto made = take(make_texture(*self.device, self.surroundings.mirrored, "surroundings"), self.around); !made)
        return made;
    const ImageF none{1, 1, {0, 0, 0, 1}};
    const std::span<const ImageF> behind(environment ? environment : &none, 1);
    if (auto made = take(make_texture(*self.device, behind, "background"), self.background); !made) return made;
    self.surrounded = true;
    self.display_set = {};  // the next frame makes all descriptor sets again
    return {};
}

Result<std::uint64_t> Renderer::draw(const Drawing& drawing, const Target& target, gpu::BinarySemaphores window) {
    if (!impl_->surrounded) {
        if (auto made = surround(drawing.lighting); !made) return made.errors();
    }
    return impl_->draw(drawing, target, window, false);
}

Result<Image8> Renderer::picture(const Drawing& drawing, std::uint32_t width, std::uint32_t height) {
    Impl& self = *impl_;
    if (!self.surrounded) {
        if (auto made = surround(drawing.lighting); !made) return made.errors();
    }
    const std::uint64_t bytes = std::uint64_t{width} * height * 4;
    if (!self.read_back || self.read_back.size() < bytes) {
        auto buffer = self.device->memory().buffer(bytes, gpu::MemoryKind::readback, "picture");
        if (auto made = take(std::move(buffer), self.read_back); !made) return made.errors();
    }
    if (!self.draft && (!self.own || self.own.desc().width != width || self.own.desc().height != height)) {
        const gpu::ImageDesc desc{.width = width,
                                  .height = height,
                                  .format = VK_FORMAT_R8G8B8A8_SRGB,
                                  .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT};
        if (auto made = take(gpu::Image::create(*self.device, desc, "picture"), self.own); !made) return made.errors();
    }
    const Target target{.view = self.draft ? VK_NULL_HANDLE : self.own.view(),
                        .format = VK_FORMAT_R8G8B8A8_SRGB,
                        .width = width,
                        .height = height,
                        .after = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
    const auto drawn = self.draw(drawing, target, {}, drawing.background == Background::transparent);
    if (!drawn) return drawn.errors();
    const auto copied = gpu::run_once(*self.device, [&](gpu::Commands& commands) {
        const gpu::Image& image = self.draft ? self.targets.lit : self.own;
        if (self.draft)
            commands.transition(image, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        commands.copy_from_image(image, self.read_back);
        commands.host_barrier();
    });
    if (!copied) return copied.errors();
    const auto mapped = self.read_back.as<std::uint8_t>();
    return Image8{width, height, {mapped.begin(), mapped.begin() + static_cast<std::ptrdiff_t>(bytes)}};
}

}  // namespace weft::render
