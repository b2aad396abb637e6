// The closest point of a surface to a given point.
#pragma once

#include "collide/bvh.h"
#include "mesh/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <span>

namespace weft {

struct TrianglePoint {
    std::array<double, 3> weights{};  ///< barycentric: >= 0, their sum is 1
    double squared_distance = 0;      ///< m²
};

/// Closest point of the triangle, its sides included. A triangle without area counts as the segment or point it has
/// degenerated to.
TrianglePoint closest_on_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c);

struct SurfacePoint {
    std::uint32_t triangle = none;    ///< `none` for a surface without triangles
    std::array<double, 3> weights{};  ///< barycentric: >= 0, their sum is 1
    double distance = 0;              ///< m
};

/// Finds closest points on a static surface. Keeps references to the positions and triangles, which must outlive it.
class SurfaceSearch {
  public:
    SurfaceSearch(std::span<const Vec3> positions, std::span<const Triangle> triangles);

    /// Of equally close triangles, returns the one with the lowest index.
    SurfacePoint closest(Vec3 p) const;

  private:
    std::span<const Vec3> positions_;
    std::span<const Triangle> triangles_;
    Bvh bvh_;
};

}  // namespace weft
