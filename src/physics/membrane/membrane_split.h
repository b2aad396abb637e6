// Splits the in-plane stiffness of a triangle into springs along its edges and a remainder.
#pragma once

#include "physics/rest_shape.h"
#include "physics/stretch/stretch.data.h"
#include "physics/symmetric.h"

#include <array>

namespace weft {

/// Index i is the edge opposite corner i.
struct MembraneSplit {
    std::array<double, 3> stretched{};   ///< N/m: stiffness of the springs while longer than at rest
    std::array<double, 3> compressed{};  ///< N/m: while shorter
    /// N/m per m²: the remainder's energy is ½ sᵀ M s with the measures s = (length² - rest²)/2.
    SymmetricMatrix remainder{};
};

/// Edges of a triangle at rest, m.
struct MembraneShape {
    std::array<double, 3> along_warp{}, along_weft{};
};

/// `weight`: factor on all stiffnesses.
MembraneSplit split_membrane(const MembraneShape& shape, const StretchMaterial& material, double weight = 1);
MembraneSplit split_membrane(const RestShape& rest, std::uint32_t triangle, const StretchMaterial& material);

}  // namespace weft
