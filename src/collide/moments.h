// Volume, center and second moments of solids and shells: what the mass and inertia of a body follow from.
#pragma once

#include <weft/mesh.h>

#include <array>
#include <span>

namespace weft {

/// Integrals over a solid: of 1, of the place x, and of x xᵀ.
struct Moments {
    double volume = 0;               ///< m³; of a shell its area, m²
    std::array<double, 3> first{};   ///< the center times the volume
    std::array<double, 6> second{};  ///< xx, yy, zz, yz, zx, xy
};

Moments& operator+=(Moments& sum, const Moments& more);
Moments operator*(const Moments& moments, double factor);

/// m. The integrals count places from here. An origin near the solid keeps them exact far from zero.
using MomentOrigin = std::array<double, 3>;

/// Of what closed triangles that face outward enclose (divergence theorem).
Moments moments_of_solid(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                         const MomentOrigin& origin);

/// Of the triangles themselves, with an equal weight per area.
Moments moments_of_shell(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                         const MomentOrigin& origin);

/// Of all points within `radius` (m, ≥ 0) of a convex solid whose triangles are closed and face outward. Exact: the
/// solid, a prism on each triangle, a wedge at each edge and a part of a ball at each corner. The first vertex of each
/// triangle has the normal of its face. Vertices at one place count as one.
Moments moments_of_rounded(const TriangleMesh& convex, double radius, const MomentOrigin& origin);

/// A part of a solid of revolution around the y axis, from `from` to `to` (m): its squared radius at y is
/// a + b·y + c·y² (m²).
struct RevolvedPart {
    double from, to;
    double a, b, c;
};
Moments moments_of_revolved(const RevolvedPart& part);

}  // namespace weft
