#include "solver/world/collider_mesh.h"

#include "mesh/procedural.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>

namespace weft {
namespace {

using Numbers = std::array<float, 4>;  // parameters of the shape, see its kernel file

constexpr std::uint32_t slices = 96, rings = 24;  // of round shapes: around, and from a pole to the equator

/// Outline of a surface of revolution about y: points (radius, height) with their normals, from the top down.
struct Outline {
    std::vector<Vec2> points, normals;
};

constexpr float half_turn = std::numbers::pi_v<float>;

// Part of a circle around a point of the axis. Angles are from the top, in radians.
void add_arc(Outline& outline, float radius, float height, float from, float to) {
    for (std::uint32_t i = 0; i <= rings; ++i) {
        const float angle = from + (to - from) * static_cast<float>(i) / rings;
        const Vec2 normal{std::sin(angle), std::cos(angle)};
        outline.points.push_back({radius * normal.x, height + radius * normal.y});
        outline.normals.push_back(normal);
    }
}

TriangleMesh turned(const Outline& outline) {
    TriangleMesh mesh;
    for (std::size_t row = 0; row < outline.points.size(); ++row) {
        for (std::uint32_t slice = 0; slice <= slices; ++slice) {
            const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(slice % slices) / slices;
            const float c = std::cos(angle), s = std::sin(angle);
            mesh.positions.push_back({outline.points[row].x * c, outline.points[row].y, outline.points[row].x * s});
            mesh.normals.push_back({outline.normals[row].x * c, outline.normals[row].y, outline.normals[row].x * s});
        }
    }
    for (std::uint32_t row = 0; row + 1 < outline.points.size(); ++row) {
        for (std::uint32_t slice = 0; slice < slices; ++slice) {
            const std::uint32_t a = row * (slices + 1) + slice, b = a + slices + 1;
            mesh.triangles.push_back({a, a + 1, b});
            mesh.triangles.push_back({b, a + 1, b + 1});
        }
    }
    return mesh;
}

// A function `mesh_of_<name>` for every shape of shapes.def.

TriangleMesh mesh_of_plane(const Collider&) {
    return {};
}

TriangleMesh mesh_of_capsule(const Collider& collider) {
    Outline outline;
    const auto& [radius, half_height, unused0, unused1] = collider.numbers;
    add_arc(outline, radius, half_height, 0, half_turn / 2);
    add_arc(outline, radius, -half_height, half_turn / 2, half_turn);
    return turned(outline);
}

TriangleMesh mesh_of_tapered_capsule(const Collider& collider) {
    const auto& [below, above, half_height, slope] = collider.numbers;
    // The cone touches the balls at the angle of its normal. If one ball holds the other, it is drawn alone.
    const float angle = std::acos(slope);
    Outline outline;
    if (slope < 1) add_arc(outline, above, half_height, 0, angle);
    if (slope > -1) add_arc(outline, below, -half_height, angle, half_turn);
    return turned(outline);
}

TriangleMesh mesh_of_sphere(const Collider& collider) {
    return mesh_of_capsule(collider);  // without a height
}

TriangleMesh mesh_of_box(const Collider& collider) {
    const Numbers& numbers = collider.numbers;
    TriangleMesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0f, 1.0f}) {
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            const auto u = static_cast<std::size_t>((axis + 1) % 3), v = static_cast<std::size_t>((axis + 2) % 3);
            for (const auto& [a, b] : {std::pair{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}}) {
                std::array<float, 3> p{}, n{};
                p[static_cast<std::size_t>(axis)] = side * numbers[static_cast<std::size_t>(axis)];
                p[u] = side * a * numbers[u];  // counterclockwise from outside, on both sides
                p[v] = b * numbers[v];
                n[static_cast<std::size_t>(axis)] = side;
                mesh.positions.push_back({p[0], p[1], p[2]});
                mesh.normals.push_back({n[0], n[1], n[2]});
            }
            mesh.triangles.push_back({first, first + 1, first + 2});
            mesh.triangles.push_back({first, first + 2, first + 3});
        }
    }
    return mesh;
}

void append(TriangleMesh& mesh, const TriangleMesh& part, Vec3 by) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3 p : part.positions) mesh.positions.push_back(p + by);
    mesh.normals.insert(mesh.normals.end(), part.normals.begin(), part.normals.end());
    for (const auto& [a, b, c] : part.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

// The side of a cylinder between two points, without its ends.
TriangleMesh tube(Vec3 from, Vec3 to, float radius) {
    constexpr std::uint32_t sides = 32;
    const Vec3 along = normalized(to - from);
    const Vec3 across = normalized(cross(along, std::abs(along.y) < 0.7f ? Vec3{0, 1, 0} : Vec3{1, 0, 0}));
    const Vec3 beside = cross(along, across);
    TriangleMesh mesh;
    for (std::uint32_t side = 0; side <= sides; ++side) {
        const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(side % sides) / sides;
        const Vec3 normal = across * std::cos(angle) + beside * std::sin(angle);
        for (const Vec3 end : {from, to}) {
            mesh.positions.push_back(end + normal * radius);
            mesh.normals.push_back(normal);
        }
    }
    for (std::uint32_t i = 0; i < 2 * sides; i += 2) {
        mesh.triangles.push_back({i, i + 2, i + 1});
        mesh.triangles.push_back({i + 1, i + 2, i + 3});
    }
    return mesh;
}

// The faces moved outward, a tube along every side and a ball at every corner. What lies within is not seen.
TriangleMesh rounded(const TriangleMesh& surface, float radius) {
    TriangleMesh mesh = surface;
    if (!(radius > 0)) return mesh;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        mesh.positions[i] = mesh.positions[i] + mesh.normals[i] * radius;
    const TriangleMesh ball = make_sphere(radius, 3);
    const auto less = [](Vec3 a, Vec3 b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
    const auto less_pair = [&](const std::pair<Vec3, Vec3>& a, const std::pair<Vec3, Vec3>& b) {
        return a.first == b.first ? less(a.second, b.second) : less(a.first, b.first);
    };
    std::set<Vec3, decltype(less)> corners(less);
    std::set<std::pair<Vec3, Vec3>, decltype(less_pair)> sides(less_pair);
    for (const Triangle& triangle : surface.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 a = surface.positions[triangle[k]], b = surface.positions[triangle[(k + 1) % 3]];
            if (corners.insert(a).second) append(mesh, ball, a);
            if (sides.insert(std::minmax(a, b, less)).second) append(mesh, tube(a, b, radius), {});
        }
    }
    return mesh;
}

TriangleMesh mesh_of_convex(const Collider& collider) {
    return collider.data ? rounded(collider.data->surface, collider.numbers[0]) : TriangleMesh{};
}

TriangleMesh mesh_of_mesh(const Collider& collider) {
    return collider.data ? collider.data->surface : TriangleMesh{};
}

// A function `extent_of_<name>` for every shape: its extent from the origin of its own frame along a unit vector in
// that frame, m. Infinite for an unbounded shape.

float extent_of_plane(const Numbers&, Vec3) {
    return std::numeric_limits<float>::infinity();
}

float extent_of_capsule(const Numbers& numbers, Vec3 along) {
    return numbers[0] + numbers[1] * std::abs(along.y);
}

float extent_of_tapered_capsule(const Numbers& numbers, Vec3 along) {
    return std::max(numbers[0] - numbers[2] * along.y, numbers[1] + numbers[2] * along.y);
}

float extent_of_sphere(const Numbers& numbers, Vec3) {
    return numbers[0];
}

float extent_of_box(const Numbers& numbers, Vec3 along) {
    return numbers[0] * std::abs(along.x) + numbers[1] * std::abs(along.y) + numbers[2] * std::abs(along.z);
}

// Shapes with data have a box instead.
float extent_of_convex(const Numbers&, Vec3) {
    return 0;
}
float extent_of_mesh(const Numbers&, Vec3) {
    return 0;
}

float extent_of(const Collider& collider, Vec3 along) {
    switch (collider.shape) {
#define WEFT_SHAPE(name, Name) \
    case ShapeKind::name:      \
        return extent_of_##name(collider.numbers, along);
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE
    }
    return 0;
}

}  // namespace

Bounds bounds_of(const Collider& collider) {
    if (collider.data) return to_world(collider.pose, collider.bounds);
    const Mat3 to_own = transposed(collider.pose.rotation);
    const Vec3 above{extent_of(collider, to_own.x), extent_of(collider, to_own.y), extent_of(collider, to_own.z)};
    const Vec3 below{extent_of(collider, -to_own.x), extent_of(collider, -to_own.y), extent_of(collider, -to_own.z)};
    if (!finite(above) || !finite(below)) return {};
    return {collider.pose.position - below, collider.pose.position + above};
}

TriangleMesh mesh_of(const Collider& collider) {
    switch (collider.shape) {
#define WEFT_SHAPE(name, Name) \
    case ShapeKind::name:      \
        return mesh_of_##name(collider);
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE
    }
    return {};
}

}  // namespace weft
