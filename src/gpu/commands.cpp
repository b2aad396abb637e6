#include "gpu/commands.h"

#include <utility>

namespace weft::gpu {

std::vector<double> intervals_between(std::span<const std::uint64_t> ticks, std::uint32_t bits, double ns_per_tick) {
    const std::uint64_t mask = bits < 64 ? (std::uint64_t{1} << bits) - 1 : ~std::uint64_t{0};
    std::vector<double> ms;
    for (std::size_t i = 1; i < ticks.size(); ++i)
        ms.push_back(static_cast<double>((ticks[i] - ticks[i - 1]) & mask) * ns_per_tick * 1e-6);
    return ms;
}

Result<Commands> Commands::create(Device& device, std::uint32_t stamps) {
    Commands self;
    self.device_ = &device;
    const auto& vk = device.vk();
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.queueFamilyIndex = device.queue_family();
    VkResult result = vk.vkCreateCommandPool(device.handle(), &pool, nullptr, &self.pool_);
    if (result != VK_SUCCESS) return device.error("to make room for commands", result);
    VkCommandBufferAllocateInfo buffer{};
    buffer.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    buffer.commandPool = self.pool_;
    buffer.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    buffer.commandBufferCount = 1;
    result = vk.vkAllocateCommandBuffers(device.handle(), &buffer, &self.commands_);
    if (result != VK_SUCCESS) return device.error("to make room for commands", result);
    if (stamps > 0 && device.limits().timestamp_bits > 0) {
        VkQueryPoolCreateInfo clock{};
        clock.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
        clock.queryType = VK_QUERY_TYPE_TIMESTAMP;
        clock.queryCount = stamps;
        result = vk.vkCreateQueryPool(device.handle(), &clock, nullptr, &self.clock_);
        if (result != VK_SUCCESS) return device.error("to make a clock", result);
        self.stamps_ = stamps;
    }
    return self;
}

Commands::~Commands() {
    if (!device_) return;
    const auto& vk = device_->vk();
    if (clock_ != VK_NULL_HANDLE) vk.vkDestroyQueryPool(device_->handle(), clock_, nullptr);
    if (pool_ != VK_NULL_HANDLE) vk.vkDestroyCommandPool(device_->handle(), pool_, nullptr);
}

void Commands::swap(Commands& other) {
    std::swap(device_, other.device_);
    std::swap(pool_, other.pool_);
    std::swap(commands_, other.commands_);
    std::swap(clock_, other.clock_);
    std::swap(stamps_, other.stamps_);
    std::swap(stamped_, other.stamped_);
    std::swap(ran_, other.ran_);
    std::swap(layout_, other.layout_);
    std::swap(stages_, other.stages_);
    std::swap(bound_, other.bound_);
    std::swap(collects_, other.collects_);
    std::swap(uncompiled_, other.uncompiled_);
    std::swap(errors_, other.errors_);
}

Result<void> Commands::begin() {
    const auto& vk = device_->vk();
    stamped_ = 0;
    ran_ = false;
    layout_ = VK_NULL_HANDLE;
    bound_ = true, collects_ = false;
    uncompiled_.clear(), errors_.clear();
    VkResult result = vk.vkResetCommandPool(device_->handle(), pool_, 0);
    VkCommandBufferBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    if (result == VK_SUCCESS) result = vk.vkBeginCommandBuffer(commands_, &info);
    if (result != VK_SUCCESS) return device_->error("to record commands", result);
    if (clock_ != VK_NULL_HANDLE) vk.vkCmdResetQueryPool(commands_, clock_, 0, stamps_);
    // Earlier submissions may still write data that these commands read.
    indirect_barrier();
    return {};
}

void Commands::bind(const Pipeline& pipeline) {
    bound_ = pipeline.compiled();
    if (!bound_ && collects_) return uncompiled_.push_back(&pipeline);
    if (!bound_) {
        if (auto compiled = pipeline.compile(); !compiled) {
            errors_.insert(errors_.end(), compiled.errors().begin(), compiled.errors().end());
            return;
        }
        bound_ = true;
    }
    device_->vk().vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.handle());
    layout_ = pipeline.layout();
    stages_ = VK_SHADER_STAGE_COMPUTE_BIT;
}

void Commands::push(std::span<const std::byte> constants) {
    if (!bound_) return;
    device_->vk().vkCmdPushConstants(commands_, layout_, stages_, 0, static_cast<std::uint32_t>(constants.size()),
                                     constants.data());
}

void Commands::dispatch(std::uint32_t groups_x, std::uint32_t groups_y) {
    if (!bound_) return;
    device_->vk().vkCmdDispatch(commands_, groups_x, groups_y, 1);
}

void Commands::dispatch_indirect(const Buffer& groups, std::uint64_t offset) {
    if (!bound_) return;
    device_->vk().vkCmdDispatchIndirect(commands_, groups.handle(), offset);
}

void Commands::barrier() {
    barrier(false);
}

void Commands::indirect_barrier() {
    barrier(true);
}

void Commands::barrier(bool indirect) {
    VkMemoryBarrier memory{};
    memory.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    memory.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
    memory.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_READ_BIT |
                           VK_ACCESS_TRANSFER_WRITE_BIT;
    constexpr VkPipelineStageFlags before = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
    VkPipelineStageFlags after = before;
    if (indirect) {
        memory.dstAccessMask |= VK_ACCESS_INDIRECT_COMMAND_READ_BIT;
        after |= VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT;
    }
    device_->vk().vkCmdPipelineBarrier(commands_, before, after, 0, 1, &memory, 0, nullptr, 0, nullptr);
}

void Commands::wait_for_all() {
    device_->vk().vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                                       VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0,
                                       nullptr, 0, nullptr, 0, nullptr);
}

void Commands::host_barrier() {
    VkMemoryBarrier memory{};
    memory.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    memory.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
    memory.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    device_->vk().vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
                                       VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &memory, 0, nullptr, 0, nullptr);
}

void Commands::copy(const Buffer& from, const Buffer& to, std::uint64_t bytes, std::uint64_t from_offset,
                    std::uint64_t to_offset) {
    if (bytes == 0) return;
    const VkBufferCopy region{from_offset, to_offset, bytes};
    device_->vk().vkCmdCopyBuffer(commands_, from.handle(), to.handle(), 1, &region);
}

void Commands::fill(const Buffer& buffer, std::uint32_t value, std::uint64_t bytes, std::uint64_t offset) {
    device_->vk().vkCmdFillBuffer(commands_, buffer.handle(), offset, bytes, value);
}

void Commands::stamp() {
    if (clock_ == VK_NULL_HANDLE || stamped_ == stamps_) return;
    device_->vk().vkCmdWriteTimestamp(commands_, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, clock_, stamped_++);
}

Result<void> Commands::end() {
    const VkResult result = device_->vk().vkEndCommandBuffer(commands_);
    if (result != VK_SUCCESS) return device_->error("to record commands", result);
    if (!errors_.empty()) return errors_;
    return {};
}

Result<std::uint64_t> Commands::submit(Moment after, BinarySemaphores binary) {
    auto value = device_->submit(commands_, after, binary);
    if (value) ran_ = true;
    return value;
}

std::vector<double> Commands::intervals() const {
    if (stamped_ < 2 || !ran_) return {};
    std::vector<std::uint64_t> ticks(stamped_);
    const VkResult result = device_->vk().vkGetQueryPoolResults(
        device_->handle(), clock_, 0, stamped_, ticks.size() * sizeof ticks[0], ticks.data(), sizeof ticks[0],
        VK_QUERY_RESULT_64_BIT);  // no wait flag: on a lost device, the wait would never end
    if (result != VK_SUCCESS) return {};
    return intervals_between(ticks, device_->limits().timestamp_bits, device_->limits().timestamp_period);
}

}  // namespace weft::gpu
