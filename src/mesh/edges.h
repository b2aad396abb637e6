// The unique edges of a triangle list, and its hinges.
#pragma once

#include "mesh/topology.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace weft {

struct EdgeList {
    std::vector<Edge> edges;                  ///< sorted by (a, b); the triangles of each ascending
    std::vector<std::uint32_t> non_manifold;  ///< ascending: edges of three or more triangles, of which two are stored
};

/// No triangle may have two equal corners; particles are < particle_count.
EdgeList build_edges(std::span<const Triangle> triangles, std::uint32_t particle_count);

struct HingeList {
    std::vector<Hinge> hinges;       ///< in the order of their edges; a and b are those of the edge, a < b
    std::uint32_t inconsistent = 0;  ///< hinges whose two triangles wind the edge the same way
};

/// One hinge per edge with exactly two triangles. If both wind the edge the same way, the second is treated as flipped,
/// so that the two opposite corners lie on different sides of the edge and a flat hinge has angle 0.
HingeList build_hinges(const EdgeList& edges, std::span<const Triangle> triangles);

struct EdgesAndHinges {
    EdgeList edges;
    HingeList hinges;
};

/// Replaces build_edges and build_hinges; must return the same lists. Empty: uses those two functions.
using FindEdges = std::function<Result<EdgesAndHinges>(std::span<const Triangle>, std::uint32_t particle_count)>;

/// As in topology.h, but finds edges and hinges with `find`. Calls it twice if it reorders the particles, and returns
/// the errors that `find` returns.
Result<Topology> build_topology(const TriangleMesh& mesh, const TopologyOptions& options, const FindEdges& find);

}  // namespace weft
