// Recomputes the numbers of a cloth's constraints for another material, without the topology.
#pragma once

#include "physics/constraint.h"

#include <weft/vector.h>

#include <span>

namespace weft {

/// Marks padding in arrays of areas. Padding keeps its numbers.
inline constexpr float no_area = -1;

/// Constraints of one kind, as arrays, built for another material.
struct RowsToChange {
    std::uint32_t stride = 0;                  ///< number of constraints with padding
    const std::uint32_t* particles = nullptr;  ///< [slot · stride + row]
    const float* geometry = nullptr;           ///< [number · stride + row]
    std::span<const float> left_out = {};
    const Vec4* rest_positions = nullptr;  ///< per particle, the dummies of padding included
    float* fields = nullptr;               ///< [field · stride + row]: read, and written where they differ
    float* coupling = nullptr;             ///< likewise, [number · stride + row]
};

// Each function writes exactly the numbers that build_<kind>() computes for `material`. It returns false if the
// material changes which constraints exist; `fields` are then invalid.
bool change_stretch(const RowsToChange& rows, const StretchMaterial& material);
/// The rest angle and the choice of edges must be unchanged.
bool change_bend(const RowsToChange& rows, const BendMaterial& material);
/// The rest angle must be unchanged.
bool change_moment(const RowsToChange& rows, const MomentMaterial& material);
/// The rest angle and the choice of edges must be unchanged.
bool change_distance_bend(const RowsToChange& rows, const DistanceBendMaterial& material);

}  // namespace weft
