#include "collide/closest_point.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace weft {
namespace {

struct Exact {
    double x, y, z;
};
Exact exact(Vec3 v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
Exact operator-(const Exact& a, const Exact& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
double dot(const Exact& a, const Exact& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Exact cross(const Exact& a, const Exact& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

std::vector<Bounds> bounds_of_triangles(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
    std::vector<Bounds> boxes(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (const std::uint32_t corner : triangles[t]) boxes[t].include(positions[corner]);
    }
    return boxes;
}

}  // namespace

// Takes the closest of four candidates: the projection onto the plane and one point per side, compared by their
// computed distances. On a sliver, where rounding hides which region of the triangle a point projects to, the result is
// still a point of the triangle and as close as rounding allows.
TrianglePoint closest_on_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
    // Relative to p, so that a triangle far from the origin loses no precision.
    const Exact corners[] = {exact(a) - exact(p), exact(b) - exact(p), exact(c) - exact(p)};
    TrianglePoint best{.weights = {}, .squared_distance = std::numeric_limits<double>::infinity()};
    const auto consider = [&](const std::array<double, 3>& w) {
        const Exact d{w[0] * corners[0].x + w[1] * corners[1].x + w[2] * corners[2].x,
                      w[0] * corners[0].y + w[1] * corners[1].y + w[2] * corners[2].y,
                      w[0] * corners[0].z + w[1] * corners[1].z + w[2] * corners[2].z};
        if (const double d2 = dot(d, d); d2 < best.squared_distance) best = {w, d2};
    };

    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const Exact side = corners[j] - corners[i];
        const double length2 = dot(side, side);
        const double t = length2 > 0 ? std::clamp(-dot(corners[i], side) / length2, 0.0, 1.0) : 0;
        std::array<double, 3> w{};
        w[i] = 1 - t, w[j] = t;
        consider(w);
    }

    const Exact ab = corners[1] - corners[0], ac = corners[2] - corners[0];
    const Exact normal = cross(ab, ac);
    if (const double n2 = dot(normal, normal); n2 > 0) {
        const double wb = dot(cross(ac, corners[0]), normal) / n2, wc = dot(cross(corners[0], ab), normal) / n2;
        if (wb >= 0 && wc >= 0 && wb + wc <= 1) consider({1 - wb - wc, wb, wc});
    }
    return best;
}

SurfaceSearch::SurfaceSearch(std::span<const Vec3> positions, std::span<const Triangle> triangles)
    : positions_(positions), triangles_(triangles), bvh_(bounds_of_triangles(positions, triangles)) {}

SurfacePoint SurfaceSearch::closest(Vec3 p) const {
    SurfacePoint found;
    double least = std::numeric_limits<double>::infinity();
    bvh_.for_each_nearest(p, least, [&](std::uint32_t t) {
        const auto [a, b, c] = triangles_[t];
        const TrianglePoint point = closest_on_triangle(p, positions_[a], positions_[b], positions_[c]);
        const double d2 = point.squared_distance;
        if (d2 < least || (d2 == least && t < found.triangle)) {
            least = d2;
            found = {.triangle = t, .weights = point.weights, .distance = std::sqrt(d2)};
        }
        return least;
    });
    return found;
}

}  // namespace weft
