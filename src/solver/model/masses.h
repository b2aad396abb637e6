// What particles weigh.
#pragma once

#include "base/aligned.h"
#include "mesh/triangle_view.h"

#include <weft/result.h>

#include <span>

namespace weft {

/// kg per particle: a third of the triangles at it. `face_area`: m², of the triangles, whose corners are particles.
AlignedVector<float> lump_masses(std::span<const float> face_area, const TriangleView& triangles,
                                 std::uint32_t particle_count, float density);

/// Fails where a density is not > 0 and finite.
Result<Done> check_density(float density);
/// Fails where a mass has no inverse that is > 0 and finite.
Result<Done> check_masses(std::span<const float> mass);

}  // namespace weft
