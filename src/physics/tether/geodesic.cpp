#include "physics/tether/geodesic.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace weft {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Visit {
    double distance;
    std::uint32_t particle;
    // Equal distances in the order of their numbers, so that the result does not depend on the heap.
    friend bool operator<(const Visit& a, const Visit& b) {
        return a.distance != b.distance ? a.distance > b.distance : a.particle > b.particle;
    }
};

double dot_exact(Vec3 a, Vec3 b) {
    return static_cast<double>(a.x) * b.x + static_cast<double>(a.y) * b.y + static_cast<double>(a.z) * b.z;
}

// The arrival at c of a straight front that reached a at da and b at db: unfold the triangle, place the source at its
// distances from a and b on the far side, and measure from there. Valid only if the straight way to c runs through the
// edge ab.
double through_triangle(Vec3 a, Vec3 b, Vec3 c, double da, double db) {
    const double ab = std::sqrt(dot_exact(b - a, b - a));
    if (!(ab > 0) || !(da < infinity) || !(db < infinity)) return infinity;
    const double sx = (da * da - db * db + ab * ab) / (2 * ab);
    const double sy2 = da * da - sx * sx;
    if (sy2 < 0) return infinity;  // no such point: the front came along the edge
    const double sy = -std::sqrt(sy2);
    const double cx = dot_exact(c - a, b - a) / ab;
    const double cy2 = dot_exact(c - a, c - a) - cx * cx;
    if (!(cy2 > 0)) return infinity;
    const double cy = std::sqrt(cy2);
    const double crossing = sx + (cx - sx) * (-sy) / (cy - sy);
    if (crossing < 0 || crossing > ab) return infinity;
    return std::hypot(cx - sx, cy - sy);
}

}  // namespace

Geodesic geodesic_distance(const Topology& topology, std::span<const std::uint32_t> sources) {
    const auto& x = topology.rest_positions;
    std::vector<double> distance(topology.particle_count, infinity);
    std::vector<std::uint8_t> done(topology.particle_count);
    Geodesic result{{}, std::vector<std::uint32_t>(topology.particle_count, none)};
    std::priority_queue<Visit> queue;
    const auto offer = [&](std::uint32_t p, double d, std::uint32_t from) {
        if (!(d < distance[p])) return;
        distance[p] = d;
        result.nearest[p] = from;
        queue.push({d, p});
    };
    for (std::uint32_t source : sources) offer(source, 0, source);
    while (!queue.empty()) {
        const auto [d, p] = queue.top();
        queue.pop();
        if (done[p]) continue;
        done[p] = 1;
        for (std::uint32_t e : topology.particle_edges[p]) {
            const std::uint32_t q = topology.edges[e].a == p ? topology.edges[e].b : topology.edges[e].a;
            offer(q, d + std::sqrt(dot_exact(x[q] - x[p], x[q] - x[p])), result.nearest[p]);
        }
        for (std::uint32_t t : topology.particle_triangles[p]) {
            const Triangle& corners = topology.triangles[t];
            const auto at = static_cast<std::size_t>(std::find(corners.begin(), corners.end(), p) - corners.begin());
            const std::uint32_t q = corners[(at + 1) % 3], r = corners[(at + 2) % 3];
            // Fronts from different sources do not make one front.
            if (done[q] && result.nearest[q] == result.nearest[p]) {
                offer(r, through_triangle(x[p], x[q], x[r], d, distance[q]), result.nearest[p]);
            }
            if (done[r] && result.nearest[r] == result.nearest[p]) {
                offer(q, through_triangle(x[p], x[r], x[q], d, distance[r]), result.nearest[p]);
            }
        }
    }
    result.distance.assign(distance.begin(), distance.end());
    return result;
}

}  // namespace weft
