// Generalized winding number of a set of triangles: how often they wind around a point.
//
// It is 1 inside a closed surface that faces outward, -1 inside one that faces inward and 0 outside. Closed surfaces
// add up where they overlap. At a hole the number changes smoothly instead of jumping, so "at least one half" is a
// robust test for inside on surfaces with holes, gaps and overlaps.
#pragma once

#include "mesh/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// The sum of all solid angles, divided by 4 pi. Takes time proportional to the number of triangles. Exact up to the
/// rounding of doubles. On a triangle itself it is either of the values beside the triangle, or one between them.
double exact_winding_number(Vec3 point, std::span<const Vec3> positions, std::span<const Triangle> triangles);

/// A group of triangles that are close together, and the expansion that replaces them far away.
struct WindingGroup {
    Vec3 center{};                  ///< of the expansion
    float squared_radius = 0;       ///< of a ball around the center that contains all triangles
    Vec3 dipole{};                  ///< sum of the area vectors
    std::array<float, 6> second{};  ///< coefficients of xx, yy, zz, xy, xz, yz
    std::array<float, 10> third{};  ///< of xxx, yyy, zzz, xxy, xxz, xyy, yyz, xzz, yzz, xyz
    /// Groups are in depth-first order: the first part is the next group. A traversal that has finished a group
    /// continues at `skip`.
    std::uint32_t skip = 0;
    std::uint32_t first = 0;  ///< of the triangles of a group without parts
    std::uint32_t count = 0;  ///< 0: a group with two parts
};

/// Winding numbers of a static surface, in O(log n) time per point. Keeps references to the positions and triangles,
/// which must outlive it. The same input gives the same numbers.
class WindingNumber {
  public:
    /// How many radii away a group of triangles must be for its expansion to replace it. Larger values are more exact
    /// and slower.
    static constexpr double default_accuracy = 2;

    WindingNumber() = default;
    /// Positions must be finite and triangles must have valid corners. Zero-area triangles are allowed.
    WindingNumber(std::span<const Vec3> positions, std::span<const Triangle> triangles);

    /// With the default accuracy the error is below 0.01 on the meshes of the test.
    double at(Vec3 point, double accuracy = default_accuracy) const;

    /// The gradient, per unit of length, within about a tenth. Large close to the edge of a hole.
    std::array<double, 3> gradient_at(Vec3 point, double accuracy = default_accuracy) const;

  private:
    std::span<const Vec3> positions_;
    std::span<const Triangle> triangles_;
    std::vector<WindingGroup> groups_;
    std::vector<std::uint32_t> items_;  // numbers of the triangles, group by group
};

}  // namespace weft
