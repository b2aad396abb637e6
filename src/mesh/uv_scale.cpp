#include "mesh/uv_scale.h"

#include <cmath>

namespace weft {

std::array<float, 2> uv_meters(std::span<const Vec3> positions, std::span<const Vec2> uvs,
                               std::span<const Triangle> triangles) {
    if (uvs.empty()) return {1, 1};
    // A UV triangle whose height is less than this part of its side is a line and gives no scale across that line.
    constexpr double flattest = 1e-6;
    double along_u = 0, along_v = 0, area = 0;
    for (const auto& [a, b, c] : triangles) {
        const Vec2 d1 = uvs[b] - uvs[a], d2 = uvs[c] - uvs[a];
        const Vec3 e1 = positions[b] - positions[a], e2 = positions[c] - positions[a];
        const double determinant = double{d1.x} * d2.y - double{d1.y} * d2.x;
        const double largest = double{d1.x} * d1.x + double{d1.y} * d1.y + double{d2.x} * d2.x + double{d2.y} * d2.y;
        if (!(std::abs(determinant) > flattest * largest)) continue;
        // Solves for the tangents times the determinant, then divides their lengths by the determinant.
        const auto length_of = [&](double f1, double f2) {
            const double x = e1.x * f1 + e2.x * f2, y = e1.y * f1 + e2.y * f2, z = e1.z * f1 + e2.z * f2;
            return std::sqrt(x * x + y * y + z * z) / std::abs(determinant);
        };
        const double weight = length(cross(e1, e2));
        along_u += weight * length_of(d2.y, -d1.y);
        along_v += weight * length_of(-d2.x, d1.x);
        area += weight;
    }
    const auto u = static_cast<float>(along_u / area), v = static_cast<float>(along_v / area);
    if (!(area > 0) || !(u > 0) || !(v > 0) || !std::isfinite(u) || !std::isfinite(v)) return {1, 1};
    return {u, v};
}

}  // namespace weft
