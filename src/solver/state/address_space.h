// World-wide numbering of particles. Each cloth has a range and keeps it while other cloths are added and removed.
#pragma once

#include "solver/model/constraint_table.h"

#include <cstdint>
#include <vector>

namespace weft {

class AddressSpace {
  public:
    /// Particles before the first range, on which padding of constraints between cloths can act; enough for any table.
    static constexpr std::uint32_t reserved = particle_capacity(0);

    /// Takes the first free range of `count` particles, a multiple of lane_padding. Returns its first particle.
    std::uint32_t take(std::uint32_t count);
    void give_back(std::uint32_t begin, std::uint32_t count);
    /// End of the last range.
    std::uint32_t end() const { return end_; }

  private:
    struct Range {
        std::uint32_t begin, count;
    };
    std::vector<Range> free_;  ///< ascending, adjacent ranges are merged
    std::uint32_t end_ = reserved;
};

}  // namespace weft
