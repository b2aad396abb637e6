// The relief of a weave as a repeating tile. It breaks up highlights near the camera and widens them far away.
#pragma once

#include "base/image.h"
#include "look/material.h"

#include <cstdint>
#include <vector>

namespace weft {

/// One level of a relief: `side` by `side` texels, the first row at v = 0, the first column at u = 0. Slopes are dh/du
/// and dh/dv of the height h in the same unit as u and v: the normal is (-slope_u, -slope_v, 1) normalized. Texels of a
/// smaller level are means of texels of the larger one. The mean of the squared slopes keeps the variance that the mean
/// slope loses, so a distant surface stays as rough as a near one (Olano and Baker 2010, LEAN mapping).
struct ReliefLevel {
    std::uint32_t side = 0;
    std::vector<float>
        first;  ///< four a texel: slope_u, slope_v, light that reaches there 0…1, share of warp on top 0…1
    std::vector<float> second;  ///< four a texel: slope_u², slope_v², slope_u · slope_v, 0
};

struct Relief {
    std::vector<ReliefLevel> levels;  ///< each half the size of the one before, down to 1
    float threads[2] = {1, 1};        ///< thread spacings per tile along u and v
};

/// `side`: a power of two. Weave::smooth gives a single flat texel.
Relief make_weave(Weave weave, std::uint32_t side = 256);
/// The relief of a repeating tangent-space normal map, +x along u, +y along v, scaled to a power of two. v is 0 at the
/// bottom of the image and 1 at its top.
Relief relief_of_normals(const Image8& normals);
/// The largest level as a tangent-space normal map, with its slopes multiplied by `scale`; rows from the top.
Image8 normal_map_of(const Relief& relief, float scale);

}  // namespace weft
