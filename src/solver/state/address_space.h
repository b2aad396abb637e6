// One numbering of particles for the whole world: each cloth has a range of it, and keeps it while others come and go.
#pragma once

#include "solver/model/constraint_table.h"

#include <cstdint>
#include <vector>

namespace weft {

class AddressSpace {
  public:
    /// Particles before the first range, on which padding of constraints between cloths acts: those of any table fit.
    static constexpr std::uint32_t reserved = particle_capacity(0);

    /// The first free range of so many particles, a multiple of lane_padding.
    std::uint32_t take(std::uint32_t count);
    void give_back(std::uint32_t begin, std::uint32_t count);
    /// All ranges lie below it.
    std::uint32_t end() const { return end_; }

  private:
    struct Range {
        std::uint32_t begin, count;
    };
    std::vector<Range> free_;  ///< ascending, none next to another
    std::uint32_t end_ = reserved;
};

}  // namespace weft
