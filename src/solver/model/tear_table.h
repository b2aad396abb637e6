// How the triangles of a cloth hang together, and which of their corners each constraint follows. Built once for a
// cloth that can be cut or torn, and shared by all its later models: openings change only the corners of triangles.
#pragma once

#include "mesh/grouping.h"
#include "physics/rest_shape.h"
#include "solver/model/constraint_table.h"

#include <weft/result.h>

#include <array>
#include <cstdint>
#include <vector>

namespace weft {

struct ClothModel;

/// A vertex is a particle of the cloth as it was built; its copies belong to the same vertex. The ring of a vertex
/// lists the triangles at it, each next to its neighbors. A corner is an index into ClothModel::faces.
struct TearTable {
    /// A triangle in the ring of a vertex, and the edge between it and the next one: a link. Each edge with two
    /// triangles is a link in the rings of both its ends.
    struct Entry {
        std::uint32_t vertex = 0;
        std::uint32_t corner = 0;       ///< of the triangle at the vertex
        std::uint32_t next = none;      ///< entry of the next triangle; `none` at the rim
        std::uint32_t far = none;       ///< corner of the triangle at the other end of the edge
        std::uint32_t next_far = none;  ///< the same corner of the next triangle
        std::uint32_t twin = none;      ///< the same edge as a link in the ring of its other end
    };
    std::vector<std::uint32_t> ring_begin;  ///< per vertex, and one more: its first entry
    std::vector<Entry> entries;
    std::vector<std::uint32_t> vertices;  ///< [corner]: the vertex there

    /// The constraints of a kind, as rows of the table.
    struct Rows {
        std::uint32_t stride = 0;            ///< of the table
        std::vector<std::uint32_t> corners;  ///< [slot · stride + row]: the corner that gives the particle; or `none`
        /// Pairs of corners, tie_begin[row] … tie_begin[row + 1]: both of a pair are the same particle while the edges
        /// that the constraint crosses are closed. Without stretch.
        std::vector<std::uint32_t> tie_begin;
        std::vector<std::array<std::uint32_t, 2>> ties;
    };
    std::array<Rows, constraint_kind_count> rows;
    /// Stretch constraints of edges with two triangles, [slot · half_stride + row]: the corners of the second triangle;
    /// `none` in other rows. The second half of row r is row half_stride + r.
    std::vector<std::uint32_t> second;
    std::uint32_t half_stride = 0;
    std::vector<float> first_part;  ///< per row below half_stride: the first triangle's part of the area of both
    /// Per row below half_stride, m/N: the compliances of the first triangle's spring, stretched and compressed, then
    /// of the second one's. Empty unless the cloth has membranes: StretchLaw then gives them.
    std::vector<std::array<float, 4>> springs;

    struct RowRef {
        ConstraintKind kind{};
        std::uint32_t row = 0;
    };
    Groups<RowRef> rows_at;                                 ///< of each vertex; without the second halves
    std::vector<std::array<std::uint32_t, 2>> without_row;  ///< corners of the ends of ClothEdges::without_row

    std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(ring_begin.size() - 1); }
};

/// The table of a model that was just built from `rest`. Fails if an edge has three triangles or more.
Result<std::shared_ptr<const TearTable>> make_tear_table(const ClothModel& model, const RestShape& rest);

}  // namespace weft
