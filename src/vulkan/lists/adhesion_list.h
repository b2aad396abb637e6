// Cloth that sticks to colliders. The device finds the sticking particles anew in every frame. The host reads their
// number with the frame's reports, one frame late. All cloths of a frame share one list, which has a constraint for
// each pair of sticking particle and collider, in their order.
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
    /// A cloth: addresses of its frame inputs, its first particle and its number of particles.
    struct Member {
        std::uint64_t frame = 0, colliders = 0, report = 0;
        std::uint32_t base = 0, particles = 0;
    };

    /// `position`: address of the world's particles. `limits`: that of any cloth; adhesion does not read it. Fails if
    /// the device has not enough memory for `capacity` constraints.
    static Result<std::unique_ptr<AdhesionList>> create(gpu::Device& device, Programs& programs, const WorldPlan& plan,
                                                        std::span<const Member> members, std::uint64_t position,
                                                        std::uint64_t limits, std::uint32_t capacity,
                                                        const std::string& name);

    /// Records a pass with RowSource::dynamic, after a barrier. `member`: moves only the particles of that cloth;
    /// `none`: those of all cloths.
    Result<void> record(gpu::Commands& commands, const Pass& pass, std::uint32_t substep,
                        std::uint32_t member = none) const;
    /// Call at the end of a frame. Copies the length of the list back for wanted().
    void record_end(gpu::Commands& commands) const;

    std::uint32_t capacity() const { return args_.capacity; }
    /// Number of constraints in the last finished frame, including those that the list had no room for.
    std::uint32_t wanted() const { return back_.as<std::uint32_t>()[0]; }

  private:
    AdhesionList(gpu::Device& device, Programs& programs, const WorldPlan& plan)
        : device_(device), programs_(programs), plan_(plan) {}
    Result<void> run(gpu::Commands& commands, std::string_view program, const ListArgs& args,
                     std::uint32_t items) const;
    Result<void> record_rows(gpu::Commands& commands, const Pass& pass, std::uint32_t substep) const;

    gpu::Device& device_;
    Programs& programs_;
    const WorldPlan& plan_;
    std::vector<std::uint32_t> first_item_;  ///< by member, then the end
    ListArgs args_{};
    RowArgs rows_{};  ///< record_rows() sets modes
    Arena arena_;
    Slot head_;
    std::uint64_t scratch_ = 0;
    gpu::Buffer back_;
};

}  // namespace weft::vulkan
