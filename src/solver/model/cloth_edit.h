// Changes to single constraints, triangles and particles of a cloth that is built.
#pragma once

#include "physics/constraint.h"
#include "solver/model/cloth_model.h"

#include <weft/result.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace weft {

/// Other corners for a triangle.
struct TriangleEdit {
    std::uint32_t triangle = 0;
    std::array<std::uint32_t, 3> corners{};  ///< particles
    std::uint32_t alive = 1;                 ///< 0: it is gone, and so is its mass
    friend bool operator==(const TriangleEdit&, const TriangleEdit&) = default;
};

/// Other ends and another stiffness for a constraint.
struct RowEdit {
    ConstraintKind kind{};
    std::uint32_t row = 0;  ///< of the model's table
    /// As many as the kind has. Those of a row along a line must be the ones that it has: the rows before and after it
    /// share them.
    std::array<std::uint32_t, 6> particles{};
    /// Times what it has; > 0, or 0: it is gone. Other than 0 and 1 for stretch and for bending over edges alone.
    float stiffness = 1;
    friend bool operator==(const RowEdit&, const RowEdit&) = default;
};

/// In the order in which they are applied.
struct ClothEdit {
    /// Particles of which copies are appended: the first copy has the number `particle_count`. It is where the original
    /// is, moves as that does, and is not pinned.
    std::vector<std::uint32_t> appended = {};
    std::vector<TriangleEdit> triangles = {};
    /// Constraints that are added: like `row`, but for ends and stiffness.
    std::vector<RowEdit> added = {};
    std::vector<RowEdit> rows = {};
    friend bool operator==(const ClothEdit&, const ClothEdit&) = default;
};

/// The model with these changes. Particles weigh what their triangles do; one that has no triangle any more keeps its
/// mass. Where particles or triangles change, coarse levels go, and tethers stay unless `rows` ends them. Everything
/// else is shared with `from`. Fails on numbers that the cloth has not, constraints of one batch that would share a
/// particle, and where the model's reserve is used up; for particles and triangles also where the render mesh is not
/// the simulated one, vertex by vertex.
Result<std::shared_ptr<const ClothModel>> with_edit(const ClothModel& from, const ClothEdit& edit);

}  // namespace weft
