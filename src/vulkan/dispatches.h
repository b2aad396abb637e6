// Passes of several cloths side by side: one dispatch runs the same pass of all cloths that take part in it.
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

/// A pass of the cloths that take part in it: a command of each, or a list of commands of each.
struct SharedPass {
    Pass pass{};
    std::uint32_t program = 0;   ///< of a list that of its first command
    bool is_list = false;        ///< a workgroup to each cloth works through its commands
    bool needs_barrier = false;  ///< some cloth does
    std::vector<PlanPart> parts;
};

struct SharedPlan {
    std::vector<SharedPass> passes;
    Repeat repeat;
};

/// Each plan's order is kept; the same passes of different plans come together where that allows it. All plans have as
/// many substeps. `grouped`: passes of coarse levels of few nodes that follow one another become lists.
SharedPlan share_passes(std::span<const CompiledPlan> plans, bool grouped);

/// The passes that are not lists, as dispatches.
class Dispatches {
  public:
    /// `first` is the number in `memory` of each plan's first command. `plans` stay where they are.
    Result<Done> build(gpu::Device& device, Programs& programs, const SharedPlan& shared,
                       std::span<const CompiledPlan> plans, const CommandMemory& memory,
                       std::span<const std::uint32_t> first, const std::string& name);

    /// The pass of that number in the SharedPlan, behind a barrier if it needs one. `substep` is added to that of each
    /// command.
    void record(gpu::Commands& commands, std::size_t pass, std::uint32_t substep,
                const gpu::DeviceLimits& limits) const;

  private:
    // As dispatch.glsl has it.
    struct ManyArgs {
        std::uint64_t table = 0;
        std::uint32_t members = 0;
        std::uint32_t groups = 0;       // workgroups of all
        std::uint32_t groups_each = 0;  // of each; 0: they differ
        std::uint32_t substep = 0;
    };
    struct Dispatch {
        const Command* alone = nullptr;           // of one cloth, or
        const gpu::Pipeline* pipeline = nullptr;  // of many
        ManyArgs args;
        bool needs_barrier = false;
    };
    std::vector<Dispatch> dispatches_;  ///< by pass; lists and passes of dynamic lists have none
    Arena arena_;
};

}  // namespace weft::vulkan
