// The cloth at rest, as constraint builders need it: areas and the directions of warp and weft.
#pragma once

#include "mesh/topology.h"
#include "physics/elasticity.h"

#include <vector>

namespace weft {

/// A particle connected to an anchor by a spring.
struct Attachment {
    std::uint32_t particle = 0;
    float compliance = 0;  ///< m/N, > 0
    Vec3 place = {};       ///< m: initial position of the anchor
};

struct RestFrame {
    Vec3 normal, warp;  ///< unit; 0 without triangles
};

struct RestShape {
    const Topology& topology;
    std::vector<float> area;                   ///< per triangle, m²
    std::vector<Vec3> warp;                    ///< per triangle, unit, in its plane: the direction of increasing u
    std::vector<float> cos2_to_warp = {};      ///< per edge: of its angle to the warp, mean over its triangles
    std::vector<float> area_at_edge = {};      ///< per edge: area of its one or two triangles, m²
    std::vector<RestFrame> frames = {};        ///< per particle: means over its triangles (rest_frames.h)
    std::vector<std::uint8_t> pinned = {};     ///< per particle: 1 if pinned; empty: none is pinned
    std::vector<Attachment> attachments = {};  ///< anchor i is particle `first_anchor` + i
    std::uint32_t first_anchor = topology.particle_count;
    Elasticity elasticity = {};  ///< for one-sided limits
    double mean_density = 0;     ///< kg/m²; for coarse levels
    /// Per triangle: factors on the stiffness against stretch, shear and compression, and against bending; empty: 1.
    std::vector<float> stretch_weight = {}, bend_weight = {};
};

/// The weight of a triangle. `weights`: of all triangles; empty: 1.
inline float weight_at(const std::vector<float>& weights, std::uint32_t triangle) {
    return weights.empty() ? 1.0f : weights[triangle];
}

/// m²: `area_at_edge`, with the area of each triangle multiplied by its weight.
float weighted_area_at(const RestShape& rest, std::size_t edge, const std::vector<float>& weights);

/// m²
inline float area_of(Vec3 a, Vec3 b, Vec3 c) {
    return 0.5f * length(cross(b - a, c - a));
}

/// Without UVs, or in a triangle whose UVs are degenerate, the warp is the x axis projected onto the triangle (the z
/// axis if the triangle faces x).
RestShape make_rest_shape(const TriangleMesh& mesh, const Topology& topology);
/// The same with given areas and warps, as RestShape has them.
RestShape make_rest_shape(const Topology& topology, std::vector<float> area, std::vector<Vec3> warp);

/// Stiffness at an angle to the warp, interpolated from the values along warp, bias (45°) and weft: (warp·cos² +
/// weft·sin²)(1 - s) + bias·s with s = sin²(2φ).
inline float directional(float warp, float bias, float weft, float cos2) {
    const float off_bias = (1 - 2 * cos2) * (1 - 2 * cos2);  // cos²(2φ), without cancellation at 45°
    return (warp * cos2 + weft * (1 - cos2)) * off_bias + bias * (1 - off_bias);
}

}  // namespace weft
