// Sets of vertices of a mesh: ascending lists without repetitions.
#pragma once

#include "editor/tools/mesh_view.h"

#include <cstdint>
#include <span>
#include <vector>

namespace weft::editor {

using VertexSet = std::vector<std::uint32_t>;

/// Ascending, without repetitions.
VertexSet make_set(std::vector<std::uint32_t> vertices);
VertexSet with(const VertexSet& set, const VertexSet& more);
VertexSet without(const VertexSet& set, const VertexSet& fewer);
bool holds(const VertexSet& set, std::uint32_t vertex);

// Only vertices of triangles count.

VertexSet all_vertices(const MeshView& mesh);
/// And all that share an edge with one of the set.
VertexSet grown(const MeshView& mesh, const VertexSet& set);
/// Only those that share edges with none outside the set.
VertexSet shrunk(const MeshView& mesh, const VertexSet& set);
/// Those of the set that share an edge with one outside it, or that lie on an edge of a single triangle. Of all
/// vertices: the rim of the mesh.
VertexSet boundary_of(const MeshView& mesh, const VertexSet& set);

}  // namespace weft::editor
