#include "collide/convex_hull.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace weft {
namespace {

void append_block(AlignedVector<float>& words, Vec3 v, float fourth) {
    words.insert(words.end(), {v.x, v.y, v.z, fourth});
}

float as_word(std::size_t count) {
    const auto integer = static_cast<std::int32_t>(count);
    float word;
    std::memcpy(&word, &integer, sizeof word);
    return word;
}

// Every face has vertices of its own, so that it has its own normal.
TriangleMesh surface_of(const ConvexHull& hull) {
    TriangleMesh mesh;
    for (std::size_t t = 0; t < hull.triangles.size(); ++t) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const std::uint32_t corner : hull.triangles[t]) {
            mesh.positions.push_back(hull.vertices[corner]);
            mesh.normals.push_back(hull.faces[hull.face_of_triangle[t]].normal);
        }
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

}  // namespace

// The layout is that of convex.kernel.h.
ShapeData make_convex_data(const ConvexHull& hull) {
    ShapeData data;
    data.bounds = bounds_of(hull.vertices);
    const Vec3 center = data.bounds.center();
    Vec3 inner;
    for (const Vec3 v : hull.vertices) inner = inner + (v - center) * (1 / static_cast<float>(hull.vertices.size()));
    float depth = std::numeric_limits<float>::infinity();  // of that point
    append_block(data.words, {as_word(hull.faces.size()), as_word(hull.edges.size()), 0}, 0);
    append_block(data.words, center, length(data.bounds.size()) * 0.5f);
    for (const ConvexHull::Face& face : hull.faces) {
        // Relative to the center, where the rounding of floats is least.
        double offset = -std::numeric_limits<double>::infinity();
        for (const Vec3 v : hull.vertices)
            offset = std::max(offset, double{face.normal.x} * (double{v.x} - center.x) +
                                          double{face.normal.y} * (double{v.y} - center.y) +
                                          double{face.normal.z} * (double{v.z} - center.z));
        append_block(data.words, face.normal, static_cast<float>(offset));
        depth = std::min(depth, static_cast<float>(offset) - dot(face.normal, inner));
    }
    for (const auto& [a, b] : hull.edges) {
        const Vec3 from = hull.vertices[a], to = hull.vertices[b];
        const double x = double{to.x} - from.x, y = double{to.y} - from.y, z = double{to.z} - from.z;
        const double size = std::sqrt(x * x + y * y + z * z);
        const double scale = size > 0 ? 1 / size : 0;
        append_block(data.words, from - center, static_cast<float>(size));
        append_block(data.words,
                     {static_cast<float>(x * scale), static_cast<float>(y * scale), static_cast<float>(z * scale)}, 0);
    }
    data.width = 2 * std::max(depth, 0.0f);  // of the largest ball around the point; the hull's own may be larger
    data.surface = surface_of(hull);
    return data;
}

}  // namespace weft
