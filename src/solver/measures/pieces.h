// How far cloths have parted: open edges, and pieces.
#pragma once

#include "solver/state/frame.h"

#include <array>
#include <cstdint>
#include <vector>

namespace weft {

/// Both sides of an edge that was opened since the cloth was built, as particles. Sides of an edge that coincide at one
/// end have the same particle there.
using OpenEdge = std::array<EdgeEnds, 2>;

/// The open edges of a cloth; none if it cannot be cut.
std::vector<OpenEdge> open_edges(const ClothModel& model);

/// Pieces of all cloths of a frame. A piece is a set of triangles that edges connect.
struct Pieces {
    std::uint64_t torn_edges = 0;  ///< open edges
    std::uint64_t count = 0;
    /// The piece with the smallest part of its cloth's area at rest.
    struct Smallest {
        std::uint32_t cloth = 0;
        std::uint64_t triangles = 0;
        double part = 1;
    } smallest;
};
Pieces find_pieces(const Frame& frame);

}  // namespace weft
