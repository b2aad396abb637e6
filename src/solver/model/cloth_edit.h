// Changes to single constraints, triangles and particles of an existing cloth model.
#pragma once

#include "physics/constraint.h"
#include "solver/model/cloth_model.h"

#include <weft/result.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace weft {

/// New corners for a triangle.
struct TriangleEdit {
    std::uint32_t triangle = 0;
    std::array<std::uint32_t, 3> corners{};  ///< particles, in the order of the corners that they replace
    std::uint32_t alive = 1;                 ///< 0: the triangle and its mass are removed
    friend bool operator==(const TriangleEdit&, const TriangleEdit&) = default;
};

/// New particles and a new stiffness for a constraint.
struct RowEdit {
    ConstraintKind kind{};
    std::uint32_t row = 0;  ///< row of the model's table
    /// As many as the kind has. A constraint on a line must keep its particles, because its neighbors on the line share
    /// them.
    std::array<std::uint32_t, 6> particles{};
    /// Factor on the current stiffness; 0 removes the constraint. Only stretch and dihedral bending allow values other
    /// than 0 and 1, from 1e-6 to 1e6.
    float stiffness = 1;
    friend bool operator==(const RowEdit&, const RowEdit&) = default;
};

/// As the second link of an opening: the triangle of the first link is removed. Only for cloth that erodes.
inline constexpr std::uint32_t drops_triangle = 0xfffffffe;

/// Edges at one vertex of the mesh to open: links of the cloth's tear table (tear_table.h), in the ring of that vertex.
struct Opening {
    std::array<std::uint32_t, 2> links = {none, none};
    /// m: how far the far end of each link is from the line that a rip follows, to its left.
    std::array<float, 2> strayed = {0, 0};
    friend bool operator==(const Opening&, const Opening&) = default;
};

/// Edits of one cloth. They are applied in the order of the members.
struct ClothEdit {
    /// Particles to copy. Copies are appended; the first has the number `particle_count`. A copy has the position and
    /// velocity of the original and is not pinned.
    std::vector<std::uint32_t> appended = {};
    std::vector<TriangleEdit> triangles = {};
    /// Opens edges, one opening after another (Opener). Only for cloth that was built with a tear table.
    std::vector<Opening> openings = {};
    /// Constraints to add: copies of constraint `row` with these particles and this stiffness factor.
    std::vector<RowEdit> added = {};
    std::vector<RowEdit> rows = {};
    /// > 0: the openings are those of so many frames, in which coarse levels were pruned instead of built again
    /// (pruned_limits.h). Only without other edits.
    std::uint32_t pruned_frames = 0;
    friend bool operator==(const ClothEdit&, const ClothEdit&) = default;
};

/// Returns the model with these changes. Particle masses are recomputed from the triangles; a particle without
/// triangles keeps its mass. If particles or triangles change, coarse levels are removed, and tethers stay unless
/// `rows` removes them; openings alone rebuild both for each piece, or prune the levels (`pruned_frames`). All other
/// data is shared with `from`. Fails on indices out of range, on constraints of one batch that would share a particle,
/// and if the model's reserve is used up. `appended` and `triangles` also fail unless each vertex of the render mesh is
/// one particle.
Result<std::shared_ptr<const ClothModel>> with_edit(const ClothModel& from, const ClothEdit& edit);

/// The same for openings alone, with exactly these particles pinned, copies included.
Result<std::shared_ptr<const ClothModel>> with_openings(const ClothModel& from, const std::vector<Opening>& openings,
                                                        const std::vector<std::uint32_t>& pinned);

}  // namespace weft
