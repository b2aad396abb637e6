// Inputs of a frame from the host for each cloth: settings, winds, and the targets of pins in each substep.
#pragma once

#include "gpu/commands.h"
#include "gpu/device.h"
#include "solver/world/backend.h"
#include "vulkan/args.data.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace weft::vulkan {

/// Internal report: there were too few slots for lists of near colliders, and the frame must run again. Finished frames
/// never have this bit.
inline constexpr std::uint32_t report_near_full = 1u << 30;

/// Numbers of elements. They determine the layout of the buffer.
struct InputShape {
    std::uint32_t substeps = 0, colliders = 0, winds = 0, motions = 0, targets = 0, grabs = 0;
    bool contact_forces = false;  ///< contacts are recorded
    bool attached = false;        ///< some targets are points of bodies
    friend bool operator==(const InputShape&, const InputShape&) = default;
};

/// The surface of a collider meets no colliders.
InputShape shape_of(const ClothModel& model, const WorldPlan& plan, const StepInput& input, const ClothStep& cloth);

/// Layout of the inputs in a device buffer of `bytes()`, which the host writes through an upload buffer.
/// Addresses of arrays on the device, by particle; 0: without.
struct ParticleAddresses {
    std::uint64_t weights, thickness;
};

class FrameInput {
  public:
    FrameInput() = default;
    explicit FrameInput(const InputShape& shape);

    std::uint64_t bytes() const { return bytes_; }
    void attach(std::byte* host, std::uint64_t address) { host_ = host, address_ = address; }

    /// The device must have finished the previous frame. `substep_seconds`: that frame's lambda_seconds().
    /// `again`: second run of a frame, from the same state. `of_particles`: as in FrameIn.
    void write(const ClothModel& model, const WorldPlan& plan, const StepInput& input, const ClothStep& cloth,
               double substep_seconds, bool again, const ParticleAddresses& of_particles);

    std::uint64_t report() const { return address_; }
    std::uint64_t frame() const { return address_ + frame_; }
    std::uint64_t winds() const { return address_ + winds_; }
    std::uint64_t motion_poses() const { return address_ + motion_poses_; }
    std::uint64_t targets() const { return address_ + targets_; }
    std::uint64_t grabs() const { return address_ + grabs_; }
    /// ClothStep::pulls: written by the device.
    std::uint64_t pulls() const { return address_ + pulls_; }
    std::uint64_t first_pull() const { return pulls_; }  ///< bytes from the start of the input
    std::uint64_t pull_bytes() const { return pull_bytes_; }

  private:
    std::uint64_t frame_ = 0, winds_ = 0, motion_poses_ = 0, targets_ = 0, grabs_ = 0, pulls_ = 0, pull_bytes_ = 0,
                  bytes_ = 0;
    std::byte* host_ = nullptr;
    std::uint64_t address_ = 0;
};

/// Inputs of several cloths. One copy uploads all of them; their reports are copied back to the host.
class FrameBuffers {
  public:
    FrameBuffers() = default;
    static Result<FrameBuffers> create(gpu::Device& device, std::span<const InputShape> shapes,
                                       const std::string& name);

    FrameInput& input(std::size_t cloth) { return inputs_[cloth]; }
    const FrameInput& input(std::size_t cloth) const { return inputs_[cloth]; }
    /// Uploads the inputs and thereby clears the reports.
    void record_begin(gpu::Commands& commands) const;
    void record_end(gpu::Commands& commands) const;
    /// Sets the reports of all cloths.
    void record_reports(gpu::Commands& commands, std::uint32_t report) const;
    /// Report of the last frame, which the device must have finished.
    std::uint32_t report(std::size_t cloth) const { return word(cloth, WEFT_REPORT_BITS); }
    /// Copies ClothStep::pulls of the last frame.
    void read_pulls(std::size_t cloth, std::span<Vec4> pulls) const;
    /// Slots that lists of near colliders needed in it.
    std::uint32_t near_slots(std::size_t cloth) const { return word(cloth, WEFT_REPORT_NEAR_SLOTS); }

  private:
    std::uint32_t word(std::size_t cloth, std::size_t which) const {
        return reports_.as<std::uint32_t>()[cloth * WEFT_REPORT_WORDS + which];
    }

    std::vector<FrameInput> inputs_;
    std::vector<std::uint64_t> offsets_;
    std::vector<std::uint64_t> pull_offsets_;  ///< in `reports_`
    gpu::Buffer upload_, buffer_, reports_;
};

}  // namespace weft::vulkan
