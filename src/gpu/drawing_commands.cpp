// The drawing functions of Commands.
#include "gpu/commands.h"

#include <algorithm>

namespace weft::gpu {

void Commands::drawing_barrier() {
    VkMemoryBarrier memory{};
    memory.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    memory.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_HOST_WRITE_BIT;
    memory.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_INDEX_READ_BIT |
                           VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
    constexpr VkPipelineStageFlags drawing = VK_PIPELINE_STAGE_VERTEX_INPUT_BIT | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT |
                                             VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
    constexpr VkPipelineStageFlags writing = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
    device_->vk().vkCmdPipelineBarrier(commands_, writing | drawing | VK_PIPELINE_STAGE_HOST_BIT, writing | drawing, 0,
                                       1, &memory, 0, nullptr, 0, nullptr);
}

void Commands::begin_pass(const RenderPass& pass, const Framebuffer& into, std::span<const VkClearValue> clear) {
    const VkExtent2D extent = into.extent();
    VkRenderPassBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    info.renderPass = pass.handle();
    info.framebuffer = into.handle();
    info.renderArea = {{0, 0}, extent};
    info.clearValueCount = static_cast<std::uint32_t>(clear.size());
    info.pClearValues = clear.data();
    const auto& vk = device_->vk();
    vk.vkCmdBeginRenderPass(commands_, &info, VK_SUBPASS_CONTENTS_INLINE);
    const VkViewport viewport{0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height), 0, 1};
    const VkRect2D all{{0, 0}, extent};
    vk.vkCmdSetViewport(commands_, 0, 1, &viewport);
    vk.vkCmdSetScissor(commands_, 0, 1, &all);
}

void Commands::end_pass() {
    device_->vk().vkCmdEndRenderPass(commands_);
}

void Commands::bind(const GraphicsPipeline& pipeline) {
    device_->vk().vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.handle());
    layout_ = pipeline.layout();
    stages_ = GraphicsPipeline::stages;
}

void Commands::bind(std::uint32_t set, const DescriptorSet& descriptors, std::span<const std::uint32_t> offsets) {
    const VkDescriptorSet handle = descriptors.handle();
    device_->vk().vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, set, 1, &handle,
                                          static_cast<std::uint32_t>(offsets.size()), offsets.data());
}

void Commands::scissor(const VkRect2D& pixels) {
    device_->vk().vkCmdSetScissor(commands_, 0, 1, &pixels);
}

void Commands::draw(std::uint32_t vertices, std::uint32_t instances) {
    device_->vk().vkCmdDraw(commands_, vertices, instances, 0, 0);
}

void Commands::draw_indexed(const BufferRange& indices, std::uint32_t count) {
    device_->vk().vkCmdBindIndexBuffer(commands_, indices.buffer, indices.offset, VK_INDEX_TYPE_UINT32);
    device_->vk().vkCmdDrawIndexed(commands_, count, 1, 0, 0, 0);
}

void Commands::transition(const Image& image, VkImageLayout from, VkImageLayout to) {
    VkImageMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image.handle();
    barrier.subresourceRange = {image.aspect(), 0, image.desc().levels, 0, 1};
    device_->vk().vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                                       VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

namespace {

VkBufferImageCopy whole_level(const Image& image, std::uint64_t offset, std::uint32_t level) {
    VkBufferImageCopy copy{};
    copy.bufferOffset = offset;
    copy.imageSubresource = {image.aspect(), level, 0, 1};
    copy.imageExtent = {std::max(1u, image.desc().width >> level), std::max(1u, image.desc().height >> level), 1};
    return copy;
}

}  // namespace

void Commands::copy_to_image(const Buffer& from, std::uint64_t offset, const Image& to, std::uint32_t level) {
    const VkBufferImageCopy copy = whole_level(to, offset, level);
    device_->vk().vkCmdCopyBufferToImage(commands_, from.handle(), to.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                                         &copy);
}

void Commands::copy_from_image(const Image& from, const Buffer& to) {
    const VkBufferImageCopy copy = whole_level(from, 0, 0);
    device_->vk().vkCmdCopyImageToBuffer(commands_, from.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to.handle(), 1,
                                         &copy);
}

}  // namespace weft::gpu
