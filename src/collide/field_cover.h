// Lets a distance field cover its mesh, whose convex edges and tips interpolation cuts off.
#pragma once

#include "collide/field_grid.h"
#include "collide/solid_surface.h"

#include <cstdint>
#include <span>

namespace weft {

/// Lowers values where the surface is outside the solid of the field (distance_field.h). That only makes the solid
/// larger, so points that were covered stay so. Cells without a negative value are left alone: they have no inside, as
/// those of a sheet. Leaves copies of shared nodes as they are.
///   surface   in cells
///   brick_of  number of each place's brick, or `none`
void cover_surface(const field::FieldGrid& grid, const SolidSurface& surface, std::span<const std::uint32_t> brick_of,
                   std::span<field::BrickNodes> nodes);

}  // namespace weft
