// Cloth that sticks to colliders: which particles do is found on the device, anew in every frame. How many there are,
// the host learns with the frame's reports, one frame late. One list for all cloths of a frame, which has a row for
// each particle and collider, in their order.
#pragma once

#include "gpu/commands.h"
#include "solver/plan/world_plan.h"
#include "vulkan/arena.h"
#include "vulkan/compiled_plan.h"
#include "vulkan/lists/args.data.h"
#include "vulkan/programs.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace weft::vulkan {

class AdhesionList {
  public:
    /// A cloth: addresses of what a frame tells it, its first particle and how many it has.
    struct Member {
        std::uint64_t frame = 0, colliders = 0, poses = 0, report = 0;
        std::uint32_t base = 0, particles = 0;
    };

    /// `position`: of the world's particles. `limits`: of any cloth, which rows of this kind do not read. Fails where
    /// the device has no room for so many rows.
    static Result<std::unique_ptr<AdhesionList>> create(gpu::Device& device, Programs& programs, const WorldPlan& plan,
                                                        std::span<const Member> members, std::uint64_t position,
                                                        std::uint64_t limits, std::uint32_t capacity,
                                                        const std::string& name);

    /// One of the passes with RowSource::dynamic, behind a barrier. `member`: moves particles of that one alone;
    /// `none`: of all.
    Result<Done> record(gpu::Commands& commands, const Pass& pass, std::uint32_t substep,
                        std::uint32_t member = none) const;
    /// At the end of a frame, for wanted().
    void record_end(gpu::Commands& commands) const;

    std::uint32_t capacity() const { return args_.capacity; }
    /// Rows of the last frame that the device is done with, whether there was room for them or not.
    std::uint32_t wanted() const { return back_.as<std::uint32_t>()[0]; }

  private:
    AdhesionList(gpu::Device& device, Programs& programs, const WorldPlan& plan)
        : device_(device), programs_(programs), plan_(plan) {}
    Result<Done> run(gpu::Commands& commands, std::string_view program, const ListArgs& args,
                     std::uint32_t items) const;
    Result<Done> record_rows(gpu::Commands& commands, const Pass& pass, std::uint32_t substep) const;

    gpu::Device& device_;
    Programs& programs_;
    const WorldPlan& plan_;
    std::vector<std::uint32_t> first_item_;  ///< by member, and the end
    ListArgs args_{};
    RowArgs rows_{};  ///< but for what a pass says
    Arena arena_;
    Slot head_;
    std::uint64_t scratch_ = 0;
    gpu::Buffer back_;
};

}  // namespace weft::vulkan
