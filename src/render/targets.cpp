#include "render/targets.h"

#include "gpu/device.h"

namespace weft::render {
namespace {

using gpu::Attachment;
using gpu::Keep;

constexpr VkImageLayout read = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
constexpr VkImageLayout depth_read = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
constexpr VkImageLayout depth_kept = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;

/// Moves a made object to `into`, or keeps the first error.
template <class Value>
bool take(Result<Value> made, Value& into, Errors& errors) {
    if (made) {
        into = std::move(*made);
    } else if (errors.empty()) {
        errors = made.errors();
    }
    return errors.empty();
}

}  // namespace

Result<Passes> Passes::create(const gpu::Device& device, std::uint32_t samples, VkFormat display, bool draft) {
    Passes passes;
    Errors errors;
    const auto make = [&](gpu::RenderPass& into, const char* name, std::initializer_list<Attachment> attachments) {
        take(gpu::RenderPass::create(device, {attachments.begin(), attachments.size()}, name), into, errors);
    };
    make(passes.shadow, "shadow", {{depth_format, 1, Keep::cleared, depth_read}});
    make(passes.depth, "depth", {{depth_format, 1, Keep::cleared, depth_read}});
    make(passes.occlusion, "occlusion", {{occlusion_format, 1, Keep::cleared, read}});
    make(passes.lit, "lit",
         {{draft ? draft_format : light_format, samples, Keep::cleared, read},
          {depth_format, samples, Keep::cleared, depth_kept}});
    make(passes.sheer, "sheer",
         {{light_format, samples, Keep::cleared, read},
          {light_format, samples, Keep::cleared, read},
          {depth_format, samples, Keep::loaded, depth_kept, depth_kept}});
    make(passes.first, "resolve", {{display, 1, Keep::cleared, read}});
    make(passes.further, "resolve more", {{display, 1, Keep::loaded, read, read}});
    make(passes.top, "top", {{draft ? draft_format : display, 1, Keep::loaded, read, read}});
    if (!errors.empty()) return errors;
    return passes;
}

Result<Targets> Targets::create(gpu::Device& device, const Passes& passes, std::uint32_t width, std::uint32_t height,
                                std::uint32_t samples, VkFormat display, bool draft) {
    Targets targets;
    targets.width = width;
    targets.height = height;
    Errors errors;
    constexpr VkImageUsageFlags drawn = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    constexpr VkImageUsageFlags deep = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    const auto image = [&](gpu::Image& into, const char* name, VkFormat format, VkImageUsageFlags usage,
                           std::uint32_t count, std::uint32_t part = 1) {
        take(gpu::Image::create(device,
                                {.width = (width + part - 1) / part,
                                 .height = (height + part - 1) / part,
                                 .format = format,
                                 .usage = usage,
                                 .samples = count},
                                name),
             into, errors);
    };
    image(targets.depth, "depth", depth_format, deep, 1);
    image(targets.occlusion, "occlusion", occlusion_format, drawn, 1, 2);
    image(targets.occlusion_smooth, "occlusion, smooth", occlusion_format, drawn, 1, 2);
    if (draft) {
        image(targets.lit, "draft", draft_format, drawn | VK_IMAGE_USAGE_TRANSFER_SRC_BIT, 1);
    } else {
        image(targets.lit, "lit", light_format, drawn, samples);
        image(targets.display, "display", display, drawn, 1);
    }
    image(targets.lit_depth, "depth of what is lit", depth_format, deep, samples);
    if (!errors.empty()) return errors;
    const auto frame = [&](gpu::Framebuffer& into, const gpu::RenderPass& pass,
                           std::initializer_list<const gpu::Image*> images) {
        std::vector<VkImageView> views;
        for (const gpu::Image* one : images) views.push_back(one->view());
        const gpu::ImageDesc& desc = (*images.begin())->desc();
        take(gpu::Framebuffer::create(device, pass, views, desc.width, desc.height), into, errors);
    };
    frame(targets.depth_frame, passes.depth, {&targets.depth});
    frame(targets.occlusion_frame, passes.occlusion, {&targets.occlusion});
    frame(targets.smooth_frame, passes.occlusion, {&targets.occlusion_smooth});
    frame(targets.lit_frame, passes.lit, {&targets.lit, &targets.lit_depth});
    frame(targets.display_frame, draft ? passes.top : passes.first, {draft ? &targets.lit : &targets.display});
    if (!errors.empty()) return errors;
    return targets;
}

Result<void> Targets::add_sheer(gpu::Device& device, const Passes& passes, std::uint32_t samples) {
    if (sheer) return {};
    Errors errors;
    for (gpu::Image* into : {&sheer.sum, &sheer.depth}) {
        take(gpu::Image::create(device,
                                {.width = width,
                                 .height = height,
                                 .format = light_format,
                                 .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                                 .samples = samples},
                                "sheer"),
             *into, errors);
    }
    if (!errors.empty()) return errors;
    const VkImageView views[] = {sheer.sum.view(), sheer.depth.view(), lit_depth.view()};
    take(gpu::Framebuffer::create(device, passes.sheer, views, width, height), sheer.frame, errors);
    if (!errors.empty()) return errors;
    return {};
}

}  // namespace weft::render
