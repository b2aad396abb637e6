// Dispatches for several cloths: one dispatch runs the same pass of all cloths that have it.
#pragma once

#include "vulkan/command_memory.h"
#include "vulkan/compiled_plan.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace weft::vulkan {

/// Commands [begin, end) of a cloth's plan.
struct PlanPart {
    std::uint32_t member = 0;
    std::uint32_t begin = 0, end = 0;
};

/// A pass of several cloths: one command of each, or a list of commands of each.
struct SharedPass {
    Pass pass{};
    std::uint32_t program = 0;   ///< shader number; for a list, that of its first command
    bool is_list = false;        ///< one workgroup per cloth runs the cloth's commands
    bool needs_barrier = false;  ///< true if any cloth needs one
    std::vector<PlanPart> parts;
};

struct SharedPlan {
    std::vector<SharedPass> passes;
    Repeat repeat;
};

/// Merges equal passes of different plans as far as the order within each plan allows. All plans must have the same
/// number of substeps. `grouped`: consecutive passes of coarse levels with few nodes become lists.
SharedPlan share_passes(std::span<const CompiledPlan> plans, bool grouped);

/// The dispatches of the passes that are not lists.
class Dispatches {
  public:
    /// `first` is the number in `memory` of each plan's first command. Keeps pointers into `plans`.
    Result<void> build(gpu::Device& device, Programs& programs, const SharedPlan& shared,
                       std::span<const CompiledPlan> plans, const CommandMemory& memory,
                       std::span<const std::uint32_t> first, const std::string& name);

    /// Records pass number `pass` of the SharedPlan, after a barrier if it needs one. `substep` is added to that of
    /// each command.
    void record(gpu::Commands& commands, std::size_t pass, std::uint32_t substep,
                const gpu::DeviceLimits& limits) const;

  private:
    // Same layout as in dispatch.glsl.
    struct ManyArgs {
        std::uint64_t table = 0;
        std::uint32_t members = 0;
        std::uint32_t groups = 0;       // workgroups of all
        std::uint32_t groups_each = 0;  // per cloth; 0: they differ
        std::uint32_t substep = 0;
    };
    struct Dispatch {
        const Command* single = nullptr;          // command of one cloth, or
        const gpu::Pipeline* pipeline = nullptr;  // pipeline for many
        ManyArgs args;
        bool needs_barrier = false;
    };
    std::vector<Dispatch> dispatches_;  ///< by pass; unused for lists and passes for all cloths
    Arena arena_;
};

}  // namespace weft::vulkan
