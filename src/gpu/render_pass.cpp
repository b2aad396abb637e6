#include "gpu/render_pass.h"

#include "gpu/device.h"

#include <algorithm>
#include <utility>

namespace weft::gpu {

Result<RenderPass> RenderPass::create(const Device& device, std::span<const Attachment> attachments,
                                      const std::string& name) {
    RenderPass self;
    self.device_ = &device;
    self.attachments_.assign(attachments.begin(), attachments.end());
    std::vector<VkAttachmentDescription> descriptions;
    std::vector<VkAttachmentReference> colors;
    VkAttachmentReference depth{VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_UNDEFINED};
    for (const Attachment& one : attachments) {
        const auto index = static_cast<std::uint32_t>(descriptions.size());
        VkAttachmentDescription description{};
        description.format = one.format;
        description.samples = static_cast<VkSampleCountFlagBits>(one.samples);
        description.loadOp = one.keep == Keep::loaded ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR;
        description.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        description.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        description.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        description.initialLayout = one.keep == Keep::loaded ? one.before : VK_IMAGE_LAYOUT_UNDEFINED;
        description.finalLayout = one.after;
        descriptions.push_back(description);
        if (is_depth(one.format)) {
            depth = {index, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
        } else {
            colors.push_back({index, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL});
        }
    }
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = static_cast<std::uint32_t>(colors.size());
    subpass.pColorAttachments = colors.data();
    subpass.pDepthStencilAttachment = depth.attachment == VK_ATTACHMENT_UNUSED ? nullptr : &depth;

    constexpr VkPipelineStageFlags stages =
        VK_PIPELINE_STAGE_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT |
        VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT |
        VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    constexpr VkPipelineStageFlags others = stages | VK_PIPELINE_STAGE_TRANSFER_BIT;
    constexpr VkAccessFlags drawn = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    constexpr VkAccessFlags used = drawn | VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_READ_BIT |
                                   VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT;
    const VkSubpassDependency dependencies[] = {
        {VK_SUBPASS_EXTERNAL, 0, others, stages, drawn | VK_ACCESS_TRANSFER_WRITE_BIT, used, 0},
        {0, VK_SUBPASS_EXTERNAL, stages, others, drawn, used | VK_ACCESS_TRANSFER_READ_BIT, 0}};
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = static_cast<std::uint32_t>(descriptions.size());
    info.pAttachments = descriptions.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = 2;
    info.pDependencies = dependencies;
    const VkResult result = device.vk().vkCreateRenderPass(device.handle(), &info, nullptr, &self.pass_);
    if (result != VK_SUCCESS) return device.error("to make the pass '" + name + "'", result);
    device.name(VK_OBJECT_TYPE_RENDER_PASS, reinterpret_cast<std::uint64_t>(self.pass_), name);
    return self;
}

std::uint32_t RenderPass::colors() const {
    return static_cast<std::uint32_t>(
        std::ranges::count_if(attachments_, [](const Attachment& one) { return !is_depth(one.format); }));
}

RenderPass::~RenderPass() {
    if (pass_ != VK_NULL_HANDLE) device_->vk().vkDestroyRenderPass(device_->handle(), pass_, nullptr);
}

void RenderPass::swap(RenderPass& other) {
    std::swap(device_, other.device_);
    std::swap(attachments_, other.attachments_);
    std::swap(pass_, other.pass_);
}

Result<Framebuffer> Framebuffer::create(const Device& device, const RenderPass& pass,
                                        std::span<const VkImageView> views, std::uint32_t width, std::uint32_t height) {
    Framebuffer self;
    self.device_ = &device;
    self.extent_ = {width, height};
    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = pass.handle();
    info.attachmentCount = static_cast<std::uint32_t>(views.size());
    info.pAttachments = views.data();
    info.width = width;
    info.height = height;
    info.layers = 1;
    const VkResult result = device.vk().vkCreateFramebuffer(device.handle(), &info, nullptr, &self.framebuffer_);
    if (result != VK_SUCCESS) return device.error("to draw into images", result);
    return self;
}

Framebuffer::~Framebuffer() {
    if (framebuffer_ != VK_NULL_HANDLE) device_->vk().vkDestroyFramebuffer(device_->handle(), framebuffer_, nullptr);
}

void Framebuffer::swap(Framebuffer& other) {
    std::swap(device_, other.device_);
    std::swap(framebuffer_, other.framebuffer_);
    std::swap(extent_, other.extent_);
}

}  // namespace weft::gpu
