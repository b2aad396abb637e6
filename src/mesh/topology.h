// The simulated mesh, derived from a render mesh: particles, edges, hinges and adjacency.
#pragma once

#include "mesh/triangle_mesh.h"

#include <weft/result.h>

#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// A unique edge, a < b, and its triangles, ascending: `none` if there is no second one, the first two if there are
/// more.
struct Edge {
    std::uint32_t a, b;
    std::uint32_t triangle0, triangle1;
    friend constexpr bool operator==(const Edge&, const Edge&) = default;
};

/// Two triangles that share an edge. Seen from the front, triangle (a, b, c) and triangle (b, a, d):
/// \code
///        c
///       / \       the edge runs from a to b,
///      a---b      c lies left of it and d right
///       \ /
///        d
/// \endcode If both wind the edge the same way, the one with the higher index is treated as flipped, so a flat hinge
/// has angle 0.
struct Hinge {
    std::uint32_t a, b, c, d;            ///< a < b, those of the edge
    std::uint32_t edge;                  ///< index into Topology::edges
    std::uint32_t triangle0, triangle1;  ///< (a, b, c) and (b, a, d)
    friend constexpr bool operator==(const Hinge&, const Hinge&) = default;
};

/// Lists of indices, one per element: `items[offsets[i]] … items[offsets[i+1] - 1]`.
struct Adjacency {
    std::vector<std::uint32_t> offsets;
    std::vector<std::uint32_t> items;

    std::uint32_t size() const { return offsets.empty() ? 0 : static_cast<std::uint32_t>(offsets.size() - 1); }
    std::span<const std::uint32_t> operator[](std::uint32_t i) const {
        return std::span(items).subspan(offsets[i], offsets[i + 1] - offsets[i]);
    }
};

/// Counts of the defects that build_topology() repaired or tolerated.
struct TopologyReport {
    std::uint32_t welded_vertices = 0;       ///< render vertices merged into another
    std::uint32_t isolated_vertices = 0;     ///< render vertices that no kept triangle uses: they never move
    std::uint32_t degenerate_triangles = 0;  ///< left out: two corners the same, or zero area (sound_triangles.h)
    std::uint32_t duplicate_triangles = 0;   ///< left out: the same three particles as an earlier one
    std::uint32_t non_manifold_edges = 0;    ///< kept as edges without a hinge: three or more triangles
    std::uint32_t inconsistent_edges = 0;    ///< two triangles that wind the edge the same way: hinge kept, one turned
};

struct Topology {
    std::uint32_t particle_count = 0;
    std::vector<Vec3> rest_positions;            ///< per particle, m
    std::vector<Triangle> triangles;             ///< kept triangles, in particles
    std::vector<std::uint32_t> source_triangle;  ///< kept triangle -> triangle of the render mesh
    std::vector<Edge> edges;                     ///< sorted by (a, b)
    std::vector<Hinge> hinges;                   ///< in the order of their edges

    /// render vertex -> particle, or `none` for an isolated one
    std::vector<std::uint32_t> vertex_to_particle;
    /// welded vertex -> particle, or `none` for an isolated one. Welded vertices are numbered by their first appearance
    /// among the render vertices; a scene's pins use these numbers.
    std::vector<std::uint32_t> welded_to_particle;

    Adjacency particle_edges;            ///< edges at a particle, ascending
    Adjacency particle_triangles;        ///< triangles at a particle, ascending
    std::vector<std::uint8_t> boundary;  ///< per particle: 1 on an open edge

    TopologyReport report;
};

struct TopologyOptions {
    /// m, >= 0: a vertex is merged into the first one that is no farther away than this. 0 merges only equal positions.
    float weld_distance = 0;
    /// Renumber particles for locality if neighbors then get clearly closer than in the file's order.
    bool reorder = true;
};

/// Fails if there are no triangles (or none with an area), positions are not finite, indices are out of range, or the
/// weld distance is not >= 0. One error per kind; `where` is the first such vertex ("vertex 12") or triangle ("triangle
/// 7"). Counts all other defects in the report and continues. Particles are numbered in welded order, without the
/// isolated ones, unless they are reordered; triangles stay in the order of the mesh.
Result<Topology> build_topology(const TriangleMesh& mesh, const TopologyOptions& options = {});

}  // namespace weft
