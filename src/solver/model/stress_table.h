// What the stress of a cloth is computed from, per triangle and particle (physics/tear/tear.md).
#pragma once

#include "physics/scalar.h"
#include "physics/symmetric.h"
#include "solver/model/cloth_model.h"
#include "solver/model/tear_paint.h"

#include <array>
#include <cstdint>
#include <vector>

namespace weft {

struct StressTable {
    struct Face {
        std::uint32_t triangle = 0;                  ///< of the cloth
        std::array<std::uint32_t, 3> corners{};      ///< perhaps wound in the other direction
        std::array<reference::TearSide, 3> sides{};  ///< side k runs from corner k to the next one
        SymmetricMatrix coupling{};  ///< N/m, by side: the energy per area is ½ gᵀ Q g (TearCoupling)
        double area = 0;             ///< m²
        /// Per corner: cosine and sine of twice the angle from the particle's axes to those of the triangle.
        std::array<std::array<double, 2>, 3> turns{};
    };
    /// Triangles that are degenerate at rest, or were removed, are left out.
    std::vector<Face> faces;
    std::vector<double> area;  ///< m², per particle: that of its triangles
    /// Per particle: the axes in which `turns` is measured, unit vectors along the mean warp and perpendicular to it,
    /// in the plane of the cloth at rest.
    std::vector<std::array<reference::vec3, 2>> axes;
    std::vector<double> cut_end;  ///< m, per particle: mean length of its edges if a cut ends there, 0 elsewhere
    /// A closed edge of a seam at a particle, as the rules of tearing see it (TearPaint).
    struct Seam {
        std::uint32_t particle = 0;
        double x = 0, y = 0;                           ///< unit, in the particle's axes: across the edge
        double inverse_strength = 0, tear_energy = 0;  ///< m/N and J/m
    };
    std::vector<Seam> seams;
    std::vector<double> inverse_resistance;  ///< per particle: factor on the load; empty: 1
    bool membranes = false;                  ///< whether any face has a coupling
    bool inextensible = false;               ///< stress cannot be computed, and all stiffnesses are 0

    std::array<double, 2> inverse_strength{};  ///< m/N, warp and weft; 0: no limit
    double tear_energy = 0;                    ///< J/m; 0: none
    double tear_ratio = 0;                     ///< 0: none
};

/// The direction across a seam in the axes of a particle, unit length. `edge`: from the particle along the link.
std::array<double, 2> seam_normal(const TearPaint::Link& seam, const std::array<reference::vec3, 2>& axes,
                                  reference::vec3 edge);

/// A cut ends at a particle of the rim with more than 270° of cloth around it at rest. `triangles`: the current ones.
/// Stiffnesses are those of the fabric: edits of single constraints (RowEdit) do not change them.
StressTable make_stress_table(const ClothModel& model, const TriangleView& triangles);

}  // namespace weft
