// Directional albedo of a material's lobes: the share of light from everywhere that they send to the viewer. The layers
// below get the rest.
#pragma once

#include "look/material.h"
#include "render/shading/brdf.h"

#include <array>

namespace weft::render {

/// Tabulated by the cosine between normal and viewer, at the middles of `table_size` equal parts of 0…1. Components:
/// gloss alone; sheen of color 1 alone; gloss below sheen; matte below both, per unit of color. Means over the azimuth.
/// For velvet: albedo of the hairs per unit of F0; their albedo at F0 = 0; 0; matte per unit of color and of 1 - F0.
using AlbedoTable = std::array<glm::vec4, shading::table_size>;

/// The threads of a material without maps and gaps. `warp`: share of the threads along u.
shading::Fiber fiber_of(const Material& material, float warp);

/// Integrates with the same source code that the GPU runs.
AlbedoTable albedo_table(const shading::Fiber& fiber);

}  // namespace weft::render
