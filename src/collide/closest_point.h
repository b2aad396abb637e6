// The point of a surface that is closest to a given one.
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

/// Of the closed triangle; of one without an area, of the segment or point that is left of it.
TrianglePoint closest_on_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c);

struct SurfacePoint {
    std::uint32_t triangle = none;    ///< `none` of a surface without triangles
    std::array<double, 3> weights{};  ///< barycentric: >= 0, their sum is 1
    double distance = 0;              ///< m
};

/// Finds closest points on a surface that holds still. Refers to what it is made from, which must outlive it.
class SurfaceSearch {
  public:
    SurfaceSearch(std::span<const Vec3> positions, std::span<const Triangle> triangles);

    /// The lowest of equally close triangles.
    SurfacePoint closest(Vec3 p) const;

  private:
    std::span<const Vec3> positions_;
    std::span<const Triangle> triangles_;
    Bvh bvh_;
};

}  // namespace weft
