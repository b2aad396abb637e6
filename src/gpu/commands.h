// Recording work: what a device does when it is submitted, once or every frame.
#pragma once

#include "gpu/device.h"
#include "gpu/graphics_pipeline.h"
#include "gpu/pipeline.h"
#include "gpu/surface_buffers.h"

#include <cstdint>
#include <span>
#include <vector>

namespace weft::gpu {

/// Milliseconds from each of a clock's readings to the next; `bits` of them count, and it begins again at 0.
std::vector<double> intervals_between(std::span<const std::uint64_t> ticks, std::uint32_t bits, double ns_per_tick);

/// One command buffer with a clock of its own. Recorded once, it may be submitted again and again, when the device is
/// done with the last time.
class Commands {
  public:
    /// `stamps`: moments that can be marked.
    static Result<Commands> create(Device& device, std::uint32_t stamps = 0);
    Commands(Commands&& other) noexcept { swap(other); }
    Commands& operator=(Commands&& other) noexcept {
        Commands(std::move(other)).swap(*this);
        return *this;
    }
    ~Commands();

    /// Forgets what was recorded.
    Result<Done> begin();
    void bind(const Pipeline& pipeline);
    void push(std::span<const std::byte> constants);
    void dispatch(std::uint32_t groups_x, std::uint32_t groups_y = 1);
    /// As many workgroups as three 32-bit numbers in a buffer say, which is for VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT
    /// too.
    void dispatch_indirect(const Buffer& groups, std::uint64_t offset);
    /// What comes after sees what shaders and copies before it have written.
    void barrier();
    /// What comes after begins when everything that was submitted before has ended, drawing and the like of a host's
    /// among it: memory that such work reads may be written again.
    void wait_for_all();
    /// And the host sees it when the work is done.
    void host_barrier();
    void copy(const Buffer& from, const Buffer& to, std::uint64_t bytes, std::uint64_t from_offset = 0,
              std::uint64_t to_offset = 0);
    /// Multiples of four bytes.
    void fill(const Buffer& buffer, std::uint32_t value, std::uint64_t bytes = VK_WHOLE_SIZE, std::uint64_t offset = 0);

    // Drawing.

    /// What comes after draws from what shaders and copies before it have written, and may write again what was drawn
    /// from before.
    void drawing_barrier();
    /// Until end_pass(), over the whole of it. Clear values in the order of the attachments.
    void begin_pass(const RenderPass& pass, const Framebuffer& into, std::span<const VkClearValue> clear);
    void end_pass();
    void bind(const GraphicsPipeline& pipeline);
    void bind(std::uint32_t set, const DescriptorSet& images);
    void draw(std::uint32_t vertices, std::uint32_t instances = 1);
    /// Vertices by 32-bit numbers.
    void draw_indexed(const BufferRange& indices, std::uint32_t count);
    void transition(const Image& image, VkImageLayout from, VkImageLayout to);
    /// One level of a picture in VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL; rows lie one after another.
    void copy_to_image(const Buffer& from, std::uint64_t offset, const Image& to, std::uint32_t level = 0);
    /// In VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL.
    void copy_from_image(const Image& from, const Buffer& to);
    VkCommandBuffer handle() const { return commands_; }

    /// Marks the moment at which all before it is done; there must be room for it.
    void stamp();
    Result<Done> end();

    Result<std::uint64_t> submit(Moment after = {}, BinarySemaphores binary = {});
    std::uint32_t stamp_count() const { return stamped_; }
    /// Milliseconds between the marked moments, one fewer than those, of the last time it ran, which has been waited
    /// for; empty without a clock, before it ever ran, and when the device is lost.
    std::vector<double> intervals() const;

  private:
    Commands() = default;
    void swap(Commands& other);

    Device* device_ = nullptr;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkQueryPool clock_ = VK_NULL_HANDLE;
    std::uint32_t stamps_ = 0, stamped_ = 0;
    bool ran_ = false;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;  // of the pipeline that is bound
    VkShaderStageFlags stages_ = 0;             // that get its constants
};

/// Records `work`, runs it and waits for it.
template <class Work>
Result<Done> run_once(Device& device, Work&& work) {
    auto commands = Commands::create(device);
    if (!commands) return commands.errors();
    if (auto begun = commands->begin(); !begun) return begun;
    work(*commands);
    if (auto ended = commands->end(); !ended) return ended;
    auto value = commands->submit();
    if (!value) return value.errors();
    return device.wait(*value);
}

}  // namespace weft::gpu
