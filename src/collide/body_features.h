// The parts of a body's surface that can touch other bodies first: rounded points, rounded edges and flat
// faces.
#pragma once

#include <weft/scene.h>
#include <weft/vector.h>

#include <cstddef>
#include <vector>

namespace weft {

struct ShapeData;
using ColliderShape = decltype(ColliderDesc::shape);

/// A ball that belongs to a body.
struct RoundPoint {
    Vec3 place;        ///< m, in the body's frame
    float radius = 0;  ///< m
    friend bool operator==(const RoundPoint&, const RoundPoint&) = default;
};

/// All balls between two balls of a body.
struct RoundEdge {
    Vec3 from, to;                         ///< m, in the body's frame
    float radius_from = 0, radius_to = 0;  ///< m; between them linear
    friend bool operator==(const RoundEdge&, const RoundEdge&) = default;
};

/// A face of a convex body: nothing of the body is farther along the normal than the offset and the roundness.
struct FlatFace {
    Vec3 normal;       ///< unit, out of the body, in its frame
    float offset = 0;  ///< m
    friend bool operator==(const FlatFace&, const FlatFace&) = default;
};

struct BodyFeatures {
    std::vector<RoundPoint> points;
    std::vector<RoundEdge> edges;
    std::vector<FlatFace> faces = {};
    float roundness = 0;  ///< m: the surface of the faces is farther out by this
    friend bool operator==(const BodyFeatures&, const BodyFeatures&) = default;
};

/// Largest number of points of a mesh's features. A finer hull is simplified from within.
inline constexpr std::size_t most_mesh_points = 64;

/// The features of a shape. `data`: of the shape, null if it has none.
///
///   - A sphere is one point. A capsule is an edge and its two ends. A tapered capsule likewise, or only its larger
///   ball
///     if that holds the other one.
///   - A box, and a convex hull with its radius, have the points, edges and faces of the polyhedron.
///   - A mesh has those of the convex hull of its vertices, with at most `most_mesh_points` points. A flat mesh has
///     those of the hull of the sheet that cloth meets, which is two cells of the distance field thick.
///   - A plane has none.
BodyFeatures features_of(const ColliderShape& shape, const ShapeData* data);

}  // namespace weft
