// The iterations of a substep in few dispatches: a workgroup to a patch, which iterates on it in shared memory. Patches
// compute what lies around them as well, so that nothing is exchanged within a dispatch; the same bits as one dispatch
// per pass.
#pragma once

#include "vulkan/command_lists.h"
#include "vulkan/patches.h"

#include <optional>
#include <vector>

namespace weft::vulkan {

class PatchedIterations {
  public:
    /// Adds its lists to `lists`. Nothing where this is no plan for patches: its projection is not Jacobi's, it has
    /// fewer than four iterations or coarse levels among them, or the cloth has no such patches.
    static Result<std::optional<PatchedIterations>> create(gpu::Device& device, Programs& programs,
                                                           const ClothState& cloth, const WorkBuffers& work,
                                                           const FrameInput& input, const InputShape& shape,
                                                           const StepPlan& plan, CommandLists& lists);

    /// Whether the pass is one of those that record() stands for, which follow one another.
    static bool covers(const Pass& pass) {
        return pass.kind == PassKind::correct || pass.kind == PassKind::average || pass.kind == PassKind::contact;
    }
    void record(gpu::Commands& commands, const CommandLists& lists, std::uint32_t substep) const;

  private:
    friend class PatchBuilder;
    PatchedIterations() = default;

    Arena arena_;
    std::uint32_t patches_ = 0;
    std::vector<std::uint32_t> dispatches_;  ///< the first list of each
};

}  // namespace weft::vulkan
