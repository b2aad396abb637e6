// Rigid bodies on the device. They are integrated, and their contacts solved, by one workgroup; contact with cloth adds
// to their sums. The state comes from the host at the start of a frame and goes back at its end.
#pragma once

#include "gpu/commands.h"
#include "solver/world/backend.h"
#include "vulkan/bodies/bodies.data.h"
#include "vulkan/programs.h"

#include <cstdint>
#include <span>
#include <vector>

namespace weft::vulkan {

static_assert(most_device_bodies == WEFT_MOST_BODIES);

class Bodies {
  public:
    /// Lists that are found on the device. The first is a power of two.
    struct Room {
        std::uint32_t pairs = 256, rows = 256;
    };

    /// Prepares a frame. Makes new buffers if there are other bodies or colliders than in the frame before, or more
    /// room is needed; recorded commands are then invalid, and serial() changes. The device must have finished the
    /// frame before. Keeps pointers into the step until finish().
    Result<void> update(gpu::Device& device, const WorldStep& step);
    /// `reports`: addresses of the reports of all cloths that step with the bodies. Call before the first
    /// frame with other cloths.
    Result<void> set_reports(gpu::Device& device, std::span<const std::uint64_t> reports);

    bool empty() const { return count_ == 0; }
    std::uint64_t serial() const { return serial_; }
    /// Address of BodiesIn; 0 without bodies.
    std::uint64_t address() const;

    /// Records the start of a frame, a pass (is_body_pass) and the end of a frame. `colliders`: address of CollidersIn.
    Result<void> record_begin(gpu::Device& device, Programs& programs, gpu::Commands& commands,
                              std::uint64_t colliders) const;
    Result<void> record(gpu::Device& device, Programs& programs, gpu::Commands& commands, std::uint64_t colliders,
                        const Pass& pass, std::uint32_t substep) const;
    void record_end(gpu::Commands& commands) const;
    /// Runs a frame without cloths and waits for it.
    Result<void> run_alone(gpu::Device& device, Programs& programs, std::uint64_t colliders, std::uint32_t substeps);

    /// Whether a list was too short in the last finished frame. Then the cloths are as before the frame.
    bool list_was_full() const;
    /// The next update() gives such lists more room.
    void grow();
    Room room() const { return room_; }
    void set_room(const Room& room) { room_ = room; }
    bool all_finite() const;
    /// Writes the states at the end of the frame to the step.
    void finish() const;

  private:
    Result<void> make_buffers(gpu::Device& device, const StepInput& input);
    void write(const WorldStep& step);
    const BodiesIn& read_back() const { return back_.as<const BodiesIn>().front(); }
    std::span<const BodyIn> bodies_back() const;

    std::uint32_t count_ = 0;
    std::uint64_t serial_ = 0, order_ = 0;
    std::uint32_t colliders_ = 0;
    Room room_, made_;
    BodiesIn addresses_{};         ///< with the addresses only
    std::vector<BodyStep> steps_;  ///< of the frame
    std::uint32_t report_count_ = 0;
    gpu::Buffer upload_, head_, lists_, reports_, back_;
};

}  // namespace weft::vulkan
