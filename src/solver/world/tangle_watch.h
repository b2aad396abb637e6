// Finds where cloths that collide with cloth pass through each other.
#pragma once

#include "collide/seams.h"
#include "collide/tangle.h"
#include "solver/model/cloth_model.h"
#include "solver/state/cloth_contact_counts.h"

#include <cstdint>
#include <span>

namespace weft {

struct WatchedCloth {
    const ClothModel* model = nullptr;
    std::uint32_t base = 0;           ///< number of its first particle in the world
    std::span<const Vec4> positions;  ///< m, of its particles
};

class TangleWatch {
  public:
    /// Replaces the tangle. `seams`: where crossings do not count. O(n log n) for n triangles.
    void search(std::span<const WatchedCloth> cloths, std::span<const Seams* const> seams = {});
    /// The last one found, with particles numbered over the world; null if there is none.
    const Tangle* tangle() const { return tangle_.pairs.empty() ? nullptr : &tangle_; }
    /// Adds it to the counts of a frame.
    void count(ClothContactCounts& counts) const;

  private:
    Tangle tangle_;
    std::uint32_t least_particle_ = no_particle;  ///< of a cloth, in a pair of the tangle
};

}  // namespace weft
