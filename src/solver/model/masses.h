// Particle masses.
#pragma once

#include "base/aligned.h"
#include "mesh/triangle_view.h"

#include <weft/result.h>

#include <span>

namespace weft {

/// Mass of each particle in kg: a third of the mass of its triangles. `face_area`: m², per triangle. `density`: kg/m².
/// `weights`: factors on the density, per triangle; empty: 1.
AlignedVector<float> lump_masses(std::span<const float> face_area, const TriangleView& triangles,
                                 std::uint32_t particle_count, float density, std::span<const float> weights);

/// Fails if the density is not > 0 and finite.
Result<void> check_density(float density);
/// Fails if the inverse of a mass is not > 0 and finite.
Result<void> check_masses(std::span<const float> mass);

}  // namespace weft
