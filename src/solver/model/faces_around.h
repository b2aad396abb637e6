// The triangles at each particle, in ascending order, laid out for SIMD lanes: a packet is lane_padding particles.
#pragma once

#include "base/aligned.h"
#include "mesh/topology.h"

#include <cstdint>
#include <vector>

namespace weft {

/// Packet i holds the particles from i · lane_padding on. Element k of the list of `lane` is
/// `triangles[(begin[i] + k) · lane_padding + lane]`. All lists of a packet have the length of the longest one; shorter
/// lists are filled with `nothing`. If the lengths in a packet differ so much that most elements would be `nothing`,
/// the packet has no such lists. The list of `lane` is then `items[offsets[j] … offsets[j + 1])`, j = own[i] + lane.
struct FacesAround {
    std::vector<std::uint32_t> begin;  ///< per packet, and one more entry at the end
    AlignedVector<std::uint32_t> triangles;
    std::vector<std::uint32_t> own, offsets, items;

    /// Whether the packet has lists of equal length in `triangles`.
    bool abreast(std::uint32_t packet) const { return begin[packet] < begin[packet + 1]; }
};

FacesAround lay_out_around(const Adjacency& particle_triangles, std::uint32_t nothing);

}  // namespace weft
