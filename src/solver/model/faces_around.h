// The triangles at each particle, ascending, for lanes: as many particles side by side as a packet has.
#pragma once

#include "base/aligned.h"
#include "mesh/topology.h"

#include <cstdint>
#include <vector>

namespace weft {

/// Packet i holds the particles from i · lane_padding on. Its lists, as long as the longest of them, are
/// `triangles[(begin[i] + k) · lane_padding + lane]`; shorter ones end in `nothing`. A packet whose particles differ so
/// much that lists of one length would be mostly nothing has none of these: its particles have lists of their own, that
/// of `lane` `items[offsets[own[i] + lane] … offsets[own[i] + lane + 1])`.
struct FacesAround {
    std::vector<std::uint32_t> begin;  ///< one more entry at the end
    AlignedVector<std::uint32_t> triangles;
    std::vector<std::uint32_t> own, offsets, items;

    bool abreast(std::uint32_t packet) const { return begin[packet] < begin[packet + 1]; }
};

FacesAround lay_out_around(const Adjacency& particle_triangles, std::uint32_t nothing);

}  // namespace weft
