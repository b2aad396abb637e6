// The step of fast marching over triangles.
#pragma once

#include <weft/vector.h>

#include <cmath>
#include <limits>

namespace weft {

inline double dot_exact(Vec3 a, Vec3 b) {
    return static_cast<double>(a.x) * b.x + static_cast<double>(a.y) * b.y + static_cast<double>(a.z) * b.z;
}

/// The distance at c of a straight front with distance da at a and db at b: unfolds the triangle, places the source on
/// the far side at its distances from a and b, and measures from there. Valid only if the straight line to c crosses
/// the edge ab; infinite otherwise.
inline double through_triangle(Vec3 a, Vec3 b, Vec3 c, double da, double db) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double ab = std::sqrt(dot_exact(b - a, b - a));
    if (!(ab > 0) || !(da < infinity) || !(db < infinity)) return infinity;
    const double sx = (da * da - db * db + ab * ab) / (2 * ab);
    const double sy2 = da * da - sx * sx;
    if (sy2 < 0) return infinity;  // no such point: the front moves along the edge
    const double sy = -std::sqrt(sy2);
    const double cx = dot_exact(c - a, b - a) / ab;
    const double cy2 = dot_exact(c - a, c - a) - cx * cx;
    if (!(cy2 > 0)) return infinity;
    const double cy = std::sqrt(cy2);
    const double crossing = sx + (cx - sx) * (-sy) / (cy - sy);
    if (crossing < 0 || crossing > ab) return infinity;
    return std::sqrt((cx - sx) * (cx - sx) + (cy - sy) * (cy - sy));
}

}  // namespace weft
