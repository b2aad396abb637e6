// Unique edges of a triangle list, and the hinges across them.
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

/// One hinge per edge with exactly two triangles. Where the two wind the edge the same way, the first of them is right
/// and the second is taken as turned over, so that the two wings still lie on different sides: flat is flat.
HingeList build_hinges(const EdgeList& edges, std::span<const Triangle> triangles);

struct EdgesAndHinges {
    EdgeList edges;
    HingeList hinges;
};

/// Another way to the very lists that build_edges and build_hinges give. Empty: those themselves.
using FindEdges = std::function<Result<EdgesAndHinges>(std::span<const Triangle>, std::uint32_t particle_count)>;

/// As in topology.h, with edges and hinges found this way: twice, if particles are reordered. Fails where it fails.
Result<Topology> build_topology(const TriangleMesh& mesh, const TopologyOptions& options, const FindEdges& find);

}  // namespace weft
