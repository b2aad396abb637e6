// Nearly straight lines through a mesh: chains of consecutive edges.
#pragma once

#include <weft/vector.h>

#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// Path i visits the links `links[offsets[i]] … links[offsets[i + 1] - 1]` in this order. It enters each link at the
/// link's first point, or at its second if `turned` is set, and leaves it at the other, where the next link begins.
struct Paths {
    std::vector<std::uint32_t> offsets = {0};
    std::vector<std::uint32_t> links;
    std::vector<std::uint8_t> turned;  ///< per entry of `links`

    std::uint32_t size() const { return static_cast<std::uint32_t>(offsets.size() - 1); }
    std::uint32_t length(std::uint32_t path) const { return offsets[path + 1] - offsets[path]; }
};

/// Puts every link (two points each, in `points`) into exactly one path. At each point the two links that continue each
/// other most nearly straight belong to one path, then the next two, up to turns of 45°. Points with very many links
/// end all paths. No path visits a point twice or is longer than `max_length` links. Longer ones are cut into equal
/// pieces that share no points, and a path of one link connects each piece to the next. Deterministic.
Paths find_paths(std::span<const std::uint32_t> points, std::span<const Vec3> positions, std::uint32_t max_length);

}  // namespace weft
