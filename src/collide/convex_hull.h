// The convex hull of points, as a collider's shape.
#pragma once

#include "collide/shape_data.h"

#include <weft/mesh.h>
#include <weft/result.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace weft {

struct ConvexHull {
    /// Contains the points x with normal·x <= offset.
    struct Face {
        Vec3 normal;       ///< unit, out of the hull
        float offset = 0;  ///< m; all vertices are on or behind the plane
    };

    std::vector<Vec3> vertices;                       ///< m; some of the points, in their order
    std::vector<Face> faces;                          ///< the one with the largest triangle first
    std::vector<std::array<std::uint32_t, 2>> edges;  ///< vertices of each edge between two faces, ascending
    std::vector<Triangle> triangles;                  ///< of all faces, counterclockwise from outside
    std::vector<std::uint32_t> face_of_triangle;      ///< the same number for the triangles of one face
    double shortfall = 0;                             ///< m: largest distance of a point to a simplified hull; else 0
};

/// Largest number of a hull's vertices. A hull with that many has at most 508 faces and 762 edges. Cloth that touches a
/// hull takes time proportional to their number.
inline constexpr std::size_t max_hull_vertices = 256;

/// The hull of the points. A point that is less than 2^-21 (5e-7) of the largest extent or coordinate outside a face
/// counts as on the face. This covers the rounding of floats: a rotated box keeps its 6 faces and 12 edges.
///
/// A hull with more than `max_vertices` vertices (4 … max_hull_vertices) is simplified. The result is the hull of the
/// points that stand out most. It lies within the true hull, and no point is farther from it than `shortfall`. A radius
/// of at least `shortfall` makes the shape contain all points.
///
/// Deterministic. The time is O(n log v) for n points and v vertices in practice.
///
/// Fails and names the point if a coordinate is not finite or beyond 1e6 m. Fails if the points have no volume: fewer
/// than four points, all within 1e-6 m, or all within the above tolerance of a point, a line or a plane.
Result<ConvexHull> convex_hull(std::span<const Vec3> points, std::size_t max_vertices = max_hull_vertices);

/// The hull for distance_convex (physics/contact/convex.kernel.h). The bounds are those of the vertices: the radius by
/// which the shape is rounded comes on top.
ShapeData make_convex_data(const ConvexHull& hull);

}  // namespace weft
