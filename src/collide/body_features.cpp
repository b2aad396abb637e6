#include "collide/body_features.h"

#include "collide/convex_hull.h"
#include "collide/field_surface.h"
#include "collide/shape_data.h"
#include "collide/solid_surface.h"
#include "mesh/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <variant>

namespace weft {
namespace {

BodyFeatures round_features(const RoundPoint& a, const RoundPoint& b) {
    return {.points = {a, b}, .edges = {{a.place, b.place, a.radius, b.radius}}};
}

BodyFeatures features_of_shape(const PlaneDesc&, const ShapeData*) {
    return {};
}

BodyFeatures features_of_shape(const SphereDesc& sphere, const ShapeData*) {
    return {.points = {{{}, sphere.radius}}, .edges = {}};
}

BodyFeatures features_of_shape(const BoxDesc& box, const ShapeData*) {
    BodyFeatures features;
    const auto corner = [&](unsigned bits) {
        const auto side = [&](unsigned axis, float half) { return bits >> axis & 1 ? half : -half; };
        return Vec3{side(0, box.half_extents.x), side(1, box.half_extents.y), side(2, box.half_extents.z)};
    };
    for (unsigned bits = 0; bits < 8; ++bits) features.points.push_back({corner(bits), 0});
    for (unsigned axis = 0; axis < 3; ++axis) {
        for (unsigned bits = 0; bits < 8; ++bits)
            if (!(bits >> axis & 1)) features.edges.push_back({corner(bits), corner(bits | 1u << axis), 0, 0});
    }
    const Vec3 half = box.half_extents;
    features.faces = {{{1, 0, 0}, half.x},  {{-1, 0, 0}, half.x}, {{0, 1, 0}, half.y},
                      {{0, -1, 0}, half.y}, {{0, 0, 1}, half.z},  {{0, 0, -1}, half.z}};
    return features;
}

BodyFeatures features_of_shape(const CapsuleDesc& capsule, const ShapeData*) {
    const float y = capsule.half_height, r = capsule.radius;
    if (y == 0) return {.points = {{{}, r}}, .edges = {}};
    return round_features({{0, -y, 0}, r}, {{0, y, 0}, r});
}

BodyFeatures features_of_shape(const TaperedCapsuleDesc& capsule, const ShapeData*) {
    const RoundPoint low{{0, -capsule.half_height, 0}, capsule.radius[0]};
    const RoundPoint high{{0, capsule.half_height, 0}, capsule.radius[1]};
    const bool one_ball = !(std::abs(double{low.radius} - double{high.radius}) < 2 * double{capsule.half_height});
    if (one_ball) return {.points = {low.radius < high.radius ? high : low}, .edges = {}};
    return round_features(low, high);
}

BodyFeatures features_of_hull(const ConvexHull& hull) {
    BodyFeatures features;
    for (const Vec3 v : hull.vertices) features.points.push_back({v, 0});
    for (const auto& [a, b] : hull.edges) features.edges.push_back({hull.vertices[a], hull.vertices[b], 0, 0});
    return features;
}

// A side of a triangle is an edge of the hull if the triangle beyond it has another normal: both normals are those of
// the faces, bit by bit.
BodyFeatures features_of_shape(const ConvexDesc& convex, const ShapeData* data) {
    BodyFeatures features;
    if (!data) return features;
    const TriangleMesh& mesh = data->surface;
    const Weld weld = weld_vertices(mesh.positions, 0);
    for (const std::uint32_t v : weld.first_vertex) features.points.push_back({mesh.positions[v], convex.radius});
    using Side = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;  // two corners, a vertex with the normal
    std::vector<Side> sides;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = weld.vertex_to_welded[t[i]], b = weld.vertex_to_welded[t[(i + 1) % 3]];
            sides.emplace_back(std::min(a, b), std::max(a, b), t[i]);
        }
    }
    std::ranges::sort(sides);
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
        const auto& [a, b, vertex] = sides[i];
        const auto& [next_a, next_b, next_vertex] = sides[i + 1];
        if (a != next_a || b != next_b || mesh.normals[vertex] == mesh.normals[next_vertex]) continue;
        features.edges.push_back({features.points[a].place, features.points[b].place, convex.radius, convex.radius});
    }
    // One face for each normal.
    std::vector<Vec3> normals = mesh.normals;
    const auto order = [](Vec3 a, Vec3 b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
    std::ranges::sort(normals, order);
    const auto [end, last] = std::ranges::unique(normals);
    normals.erase(end, last);
    features.roundness = convex.radius;
    for (const Vec3 normal : normals) {
        float offset = -std::numeric_limits<float>::infinity();
        for (const Vec3 p : mesh.positions) offset = std::max(offset, dot(normal, p));
        features.faces.push_back({normal, offset});
    }
    return features;
}

Vec3 normal_of_largest(const TriangleMesh& mesh) {
    Vec3 largest;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 area = cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
        if (length(area) > length(largest)) largest = area;
    }
    return normalized(largest);
}

BodyFeatures features_of_shape(const SolidMeshDesc&, const ShapeData* data) {
    if (!data) return {};
    const TriangleMesh& mesh = data->surface;
    if (const auto hull = convex_hull(mesh.positions, most_mesh_points)) return features_of_hull(*hull);
    const auto thickness = static_cast<float>(SolidSurface::sheet_thickness * double{cell_of_field(*data)});
    const Vec3 back = normal_of_largest(mesh) * -thickness;
    std::vector<Vec3> both = mesh.positions;
    for (const Vec3 p : mesh.positions) both.push_back(p + back);
    const auto hull = convex_hull(both, most_mesh_points);
    return hull ? features_of_hull(*hull) : BodyFeatures{};
}

}  // namespace

BodyFeatures features_of(const ColliderShape& shape, const ShapeData* data) {
    return std::visit([&](const auto& one) { return features_of_shape(one, data); }, shape);
}

}  // namespace weft
