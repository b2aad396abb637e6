#include "physics/rest_frames.h"

#include <algorithm>
#include <cmath>

namespace weft {

std::vector<RestFrame> rest_frames(const RestShape& rest) {
    const Topology& topology = rest.topology;
    std::vector<RestFrame> frames(topology.particle_count);
    for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
        const auto [a, b, c] = topology.triangles[t];
        const Vec3 at_a = topology.rest_positions[a];
        const Vec3 normal = cross(topology.rest_positions[b] - at_a, topology.rest_positions[c] - at_a);
        for (const std::uint32_t p : {a, b, c}) {
            frames[p].normal += normal;
            frames[p].warp += rest.warp[t] * rest.area[t];
        }
    }
    for (RestFrame& frame : frames) frame = {normalized(frame.normal), normalized(frame.warp)};
    return frames;
}

StraightLine straight_line(const RestFrame& a, const RestFrame& b, Vec3 from_a_to_b) {
    constexpr double alike = 0.985, in_plane = 0.09;  // 10°, 5°
    constexpr double arc = 1.002;                     // an arc of 10° is longer than its chord by less
    const double apart = length(from_a_to_b);
    const auto cosine = [](Vec3 u, Vec3 v) { return static_cast<double>(dot(u, v)); };
    const auto along = [&](Vec3 direction) { return std::abs(cosine(from_a_to_b, direction)); };
    const bool flat = cosine(a.normal, b.normal) > alike && along(a.normal) < in_plane * apart;
    if (!flat || !(cosine(a.warp, b.warp) > alike)) return {};
    return {apart * arc, along(a.warp) * arc, along(cross(a.normal, a.warp)) * arc};
}

}  // namespace weft
