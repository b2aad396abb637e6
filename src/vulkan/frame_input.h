// What a frame brings from the host: settings, colliders, winds, where things are in each substep.
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

/// How many of each there are: as long as that stays, the places in the buffer do.
struct InputShape {
    std::uint32_t substeps = 0, colliders = 0, winds = 0, movers = 0, held = 0;
    bool feedback = false;  ///< account is kept of contacts
    friend bool operator==(const InputShape&, const InputShape&) = default;
};

InputShape shape_of(const WorldPlan& plan, const StepInput& input, const ClothStep& cloth);

/// Places of all that in a buffer of `bytes()`, of which a host sees a copy.
class FrameInput {
  public:
    FrameInput() = default;
    explicit FrameInput(const InputShape& shape);

    std::uint64_t bytes() const { return bytes_; }
    void attach(std::byte* host, std::uint64_t address) { host_ = host, address_ = address; }

    /// The device must be done with the frame before, which left a lambda of `substep_seconds` (lambda_seconds).
    /// `again`: the frame has been run before, from the same state.
    void write(const ClothModel& model, const WorldPlan& plan, const StepInput& input, const ClothStep& cloth,
               double substep_seconds, bool again);

    std::uint64_t report() const { return address_; }
    std::uint64_t frame() const { return address_ + frame_; }
    std::uint64_t colliders() const { return address_ + colliders_; }
    std::uint64_t winds() const { return address_ + winds_; }
    std::uint64_t poses() const { return address_ + poses_; }
    std::uint64_t mover_poses() const { return address_ + mover_poses_; }
    std::uint64_t held() const { return address_ + held_; }

  private:
    std::uint64_t frame_ = 0, colliders_ = 0, winds_ = 0, poses_ = 0, mover_poses_ = 0, held_ = 0, bytes_ = 0;
    std::byte* host_ = nullptr;
    std::uint64_t address_ = 0;
};

/// Those of some cloths: one copy brings all to the device, one brings their reports back.
class FrameBuffers {
  public:
    FrameBuffers() = default;
    static Result<FrameBuffers> create(gpu::Device& device, std::span<const InputShape> shapes,
                                       const std::string& name);

    FrameInput& input(std::size_t cloth) { return inputs_[cloth]; }
    const FrameInput& input(std::size_t cloth) const { return inputs_[cloth]; }
    /// Reports are none after it.
    void record_begin(gpu::Commands& commands) const;
    void record_end(gpu::Commands& commands) const;
    /// Of the last frame; the device must be done with it.
    std::uint32_t report(std::size_t cloth) const { return reports_.as<std::uint32_t>()[cloth]; }

  private:
    std::vector<FrameInput> inputs_;
    std::vector<std::uint64_t> offsets_;
    gpu::Buffer upload_, buffer_, reports_;
};

}  // namespace weft::vulkan
