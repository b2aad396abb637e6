// Command buffers: work that is recorded once, and submitted once or every frame.
#pragma once

#include "gpu/device.h"
#include "gpu/graphics_pipeline.h"
#include "gpu/pipeline.h"
#include "gpu/surface_buffers.h"

#include <cstdint>
#include <span>
#include <vector>

namespace weft::gpu {

/// Milliseconds from each timestamp to the next. Only the low `bits` bits are valid; the counter may wrap around once.
std::vector<double> intervals_between(std::span<const std::uint64_t> ticks, std::uint32_t bits, double ns_per_tick);

/// One command buffer with its own timestamps. Recorded once, it may be submitted repeatedly. The device must have
/// finished the previous submission.
class Commands {
  public:
    /// `stamps`: largest number of calls of stamp().
    static Result<Commands> create(Device& device, std::uint32_t stamps = 0);
    Commands(Commands&& other) noexcept { swap(other); }
    Commands& operator=(Commands&& other) noexcept {
        Commands(std::move(other)).swap(*this);
        return *this;
    }
    ~Commands();

    /// Starts a new recording and discards the previous one.
    Result<void> begin();
    /// Compiles the pipeline if it is not compiled yet. A failure is returned by end().
    void bind(const Pipeline& pipeline);
    /// In the rest of this recording, bind() only remembers pipelines that are not compiled yet, and their dispatches
    /// are left out: for a recording that is made again, once compile_together() has compiled them all.
    void collect_uncompiled() { collects_ = true; }
    std::span<const Pipeline* const> uncompiled() const { return uncompiled_; }
    void push(std::span<const std::byte> constants);
    void dispatch(std::uint32_t groups_x, std::uint32_t groups_y = 1);
    /// Reads the three numbers of workgroups (32 bits each) from a buffer with VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT. An
    /// indirect_barrier() must lie between the shader that writes them and this command.
    void dispatch_indirect(const Buffer& groups, std::uint64_t offset);
    /// Makes writes of earlier shaders and copies visible to later ones, but not to dispatch_indirect(): see there.
    void barrier();
    /// The same, and to the numbers of workgroups that dispatch_indirect() reads. NVIDIA's driver takes twice as long
    /// for it (H200: 3.4 us with an empty dispatch, 2 us without the numbers).
    void indirect_barrier();
    /// Later commands start after all work that was submitted before, including a host's drawing. Then they may
    /// overwrite memory that such work reads.
    void wait_for_all();
    /// Makes earlier writes visible to the host when the work is done.
    void host_barrier();
    void copy(const Buffer& from, const Buffer& to, std::uint64_t bytes, std::uint64_t from_offset = 0,
              std::uint64_t to_offset = 0);
    /// `bytes` and `offset` must be multiples of four.
    void fill(const Buffer& buffer, std::uint32_t value, std::uint64_t bytes = VK_WHOLE_SIZE, std::uint64_t offset = 0);

    // Drawing.

    /// Makes writes of earlier shaders and copies visible to later drawing. Later commands may overwrite what earlier
    /// drawing reads.
    void drawing_barrier();
    /// Begins a pass over the whole framebuffer, until end_pass(). Clear values in the order of the attachments.
    void begin_pass(const RenderPass& pass, const Framebuffer& into, std::span<const VkClearValue> clear);
    void end_pass();
    void bind(const GraphicsPipeline& pipeline);
    /// `offsets`: one per uniform buffer of the set, in the order of their bindings, in bytes.
    void bind(std::uint32_t set, const DescriptorSet& descriptors, std::span<const std::uint32_t> offsets = {});
    /// Later drawing of this pass changes only these pixels, which must lie within the framebuffer.
    void scissor(const VkRect2D& pixels);
    void draw(std::uint32_t vertices, std::uint32_t instances = 1);
    /// `indices`: 32 bits each.
    void draw_indexed(const BufferRange& indices, std::uint32_t count);
    void transition(const Image& image, VkImageLayout from, VkImageLayout to);
    /// Copies one level of an image in VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL. Rows of pixels are tightly packed.
    void copy_to_image(const Buffer& from, std::uint64_t offset, const Image& to, std::uint32_t level = 0);
    /// The image must be in VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL.
    void copy_from_image(const Image& from, const Buffer& to);
    VkCommandBuffer handle() const { return commands_; }

    /// Writes a timestamp when all earlier commands are done. At most `stamps` calls (see create()).
    void stamp();
    Result<void> end();

    Result<std::uint64_t> submit(Moment after = {}, BinarySemaphores binary = {});
    std::uint32_t stamp_count() const { return stamped_; }
    /// Milliseconds between consecutive timestamps of the last run, which must have been waited for. Empty without a
    /// clock, before the first run, and if the device is lost.
    std::vector<double> intervals() const;

  private:
    Commands() = default;
    void barrier(bool indirect);
    void swap(Commands& other);

    Device* device_ = nullptr;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkQueryPool clock_ = VK_NULL_HANDLE;
    std::uint32_t stamps_ = 0, stamped_ = 0;
    bool ran_ = false;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;  // of the bound pipeline
    VkShaderStageFlags stages_ = 0;             // stages that get its push constants
    bool bound_ = true;                         // false: the pipeline bound last is missing
    bool collects_ = false;
    std::vector<const Pipeline*> uncompiled_;
    Errors errors_;
};

/// Records `work`, runs it and waits for it.
template <class Work>
Result<void> run_once(Device& device, Work&& work) {
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
