// Which stitched parts of an island have to step together in a frame, because their cloths come near each other.
//
// A first guess follows from positions and velocities at the start of the frame. After the frame, the places that
// contact looked at tell whether it was right; if not, more parts are grouped, and the frame runs again.
#pragma once

#include "base/disjoint_sets.h"
#include "cpu/cloth_state.h"
#include "solver/world/backend.h"

#include <weft/bounds.h>

#include <cstdint>
#include <span>
#include <vector>

namespace weft::cpu {

class NearParts {
  public:
    /// Guesses for a frame. `cloths`: those of the step, which must last as long as this is used. Does
    /// not allocate if the step has one part, as had all before.
    void begin(const IslandStep& step, std::span<ClothState* const> cloths, const StepInput& input);

    /// Groups of parts that step together, ascending.
    std::vector<std::vector<std::uint32_t>> groups() { return grouped_.sets(); }
    /// For a box around the places of a cloth of the step at which contact has looked. Surfaces of colliders have
    /// theirs from begin() on.
    Bounds& swept(std::uint32_t cloth) { return swept_[cloth]; }
    /// Groups the parts whose cloths came near each other and were not in one group. Returns whether there are any.
    bool merge();

  private:
    bool merge(std::span<const Bounds> boxes);

    // Empty if the step has one part.
    std::span<ClothState* const> cloths_;
    std::vector<std::uint32_t> part_of_;  // by cloth
    DisjointSets grouped_{0};             // parts
    std::vector<Bounds> swept_;           // by cloth
    float surface_motion_ = 0;            // of the input
};

}  // namespace weft::cpu
