// Another material for the rows of a cloth: the numbers that the builders give, without topology.
#pragma once

#include "physics/constraint.h"

#include <weft/vector.h>

#include <span>

namespace weft {

/// In padding, which keeps its numbers, in place of an area.
inline constexpr float no_area = -1;

/// Rows of one kind, array by array, as their builder made them for another material.
struct RowsToChange {
    std::uint32_t stride = 0;                  ///< rows with padding
    const std::uint32_t* particles = nullptr;  ///< [slot · stride + row]
    const float* geometry = nullptr;           ///< [number · stride + row]
    std::span<const float> left_out = {};
    const Vec4* rest_positions = nullptr;  ///< of particles, those of padding included
    float* fields = nullptr;               ///< [field · stride + row]: read, and written where they differ
};

// Each writes the numbers that build_<kind>() gives for `material`, bit by bit. False where that would give other rows;
// `fields` are of no use then.
bool change_stretch(const RowsToChange& rows, const StretchMaterial& material);
/// Only for the same rest angle and the same choice of edges.
bool change_bend(const RowsToChange& rows, const BendMaterial& material);
/// Likewise.
bool change_flexion(const RowsToChange& rows, const FlexionMaterial& material);

}  // namespace weft
