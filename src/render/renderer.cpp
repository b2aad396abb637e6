#include "gpu/borrowed_functions.h"
#include "render/renderer_impl.h"
#include "render/texture.h"

#include <algorithm>

namespace weft::render {
namespace {

constexpr std::uint32_t most_samples = 256;

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

}  // namespace

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
