// Splits a triangle mesh into tiles: groups of neighboring triangles with their vertices and edges. The search for
// pairs of features works on tiles.
#pragma once

#include "base/aligned.h"
#include "mesh/triangle_view.h"

#include <weft/vector.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// Largest numbers in a tile. Multiples of 16, the largest number of SIMD lanes.
inline constexpr std::uint32_t tile_triangles = 64, tile_vertices = 96, tile_edges = 128;

/// Every vertex, edge and triangle of the mesh is owned by exactly one tile: the first one that uses it.
struct Tile {
    std::uint32_t vertex_count = 0;
    std::uint32_t own_vertices = 0;  ///< the first ones are owned
    std::uint32_t edge_count = 0;    ///< owned edges
    std::uint32_t triangle_count = 0;
    /// Particle of each vertex. Unused places repeat the first one.
    alignas(cache_line) std::array<std::uint32_t, tile_vertices> particle{};
    std::array<std::array<std::uint32_t, tile_edges>, 2> edge{};          ///< vertices of the tile
    std::array<std::array<std::uint32_t, tile_triangles>, 3> triangle{};  ///< vertices of the tile
};

/// Orders the triangles along a space-filling curve through their centroids and cuts the order into tiles.
/// `positions`: by particle. Deterministic. Leaves out triangles with two
/// equal corners.
std::vector<Tile> make_tiles(TriangleView triangles, std::span<const Vec4> positions);

/// The numbers of the particles, ordered along a space-filling curve. Deterministic.
std::vector<std::uint32_t> order_along_curve(std::span<const Vec4> particles);

}  // namespace weft
