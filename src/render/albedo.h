// How much of the light from everywhere a material sends to the viewer: what its layers leave for those below.
#pragma once

#include "look/material.h"
#include "render/shading/brdf.h"

#include <array>

namespace weft::render {

/// By the cosine between normal and viewer, in the middles of `table_size` equal parts of 0…1: gloss alone, sheen of
/// color 1 alone, and, layered, gloss and matte per unit of color. Means over the directions along the surface.
/// Of velvet: what its hairs send per unit of their F0, and what they send besides; 0; matte per unit of color and of
/// what F0 leaves of 1.
using AlbedoTable = std::array<glm::vec4, shading::table_size>;

/// The threads of a material, where nothing but them is seen; `warp`: the share of those along u.
shading::Fiber fiber_of(const Material& material, float warp);

/// Integrated with the same text that the GPU runs.
AlbedoTable albedo_table(const shading::Fiber& fiber);

}  // namespace weft::render
