#include "collide/crossings.h"

#include "collide/bvh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace weft {
namespace {

struct Point {
    double x = 0, y = 0, z = 0;
};

Point to_point(Vec3 v) {
    return {v.x, v.y, v.z};
}
Point operator-(Point a, Point b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
double dot(Point a, Point b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Point cross(Point a, Point b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The edge of a triangle from corner a to corner b, opposite to corner c; corners are 0 to 2.
struct Side {
    std::uint8_t a, b, c;
};
constexpr std::array<Side, 3> sides{Side{0, 1, 2}, Side{1, 2, 0}, Side{2, 0, 1}};

/// A triangle is left out, with an empty box, if it is degenerate or not finite.
struct Face {
    Triangle corners{};
    std::array<Point, 3> points;
    Point normal;
    std::array<bool, 3> owns{};  // sides that no earlier triangle has, so that each edge is counted once
};

Face make_face(const Triangle& corners, std::span<const Vec3> positions) {
    Face face{.corners = corners, .points = {}, .normal = {}, .owns = {}};
    for (std::size_t c = 0; c < 3; ++c) face.points[c] = to_point(positions[corners[c]]);
    face.normal = cross(face.points[1] - face.points[0], face.points[2] - face.points[0]);
    return face;
}

bool is_usable(const Face& face) {
    double longest = 0;
    for (const Side& side : sides) {
        const Point edge = face.points[side.b] - face.points[side.a];
        longest = std::max(longest, dot(edge, edge));
    }
    // If the height is below 1e-14 of the longest edge, it is rounding error and the plane is undefined.
    const double area = std::sqrt(dot(face.normal, face.normal));
    return std::isfinite(area) && std::isfinite(longest) && area > 1e-14 * longest;
}

void assign_edges(std::vector<Face>& faces, const std::vector<bool>& usable) {
    struct Use {
        std::uint32_t low, high, face;
        std::uint8_t side;
    };
    std::vector<Use> uses;
    uses.reserve(3 * faces.size());
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        if (!usable[f]) continue;
        for (std::uint8_t s = 0; s < 3; ++s) {
            const auto [low, high] = std::minmax(faces[f].corners[sides[s].a], faces[f].corners[sides[s].b]);
            uses.push_back({low, high, f, s});
        }
    }
    std::ranges::sort(uses, {}, [](const Use& u) { return std::pair(std::pair(u.low, u.high), u.face); });
    for (std::size_t i = 0; i < uses.size(); ++i) {
        const bool first = i == 0 || uses[i - 1].low != uses[i].low || uses[i - 1].high != uses[i].high;
        faces[uses[i].face].owns[uses[i].side] = first;
    }
}

bool has_corner(const Face& face, std::uint32_t particle) {
    return face.corners[0] == particle || face.corners[1] == particle || face.corners[2] == particle;
}

int shared_corners(const Face& a, const Face& b) {
    return has_corner(a, b.corners[0]) + has_corner(a, b.corners[1]) + has_corner(a, b.corners[2]);
}

/// Whether each corner of `other` lies in front of the plane of `face`. A corner on the plane counts as in front, so
/// that a chain of edges that passes through the plane at one of its particles crosses it once.
std::array<bool, 3> in_front(const Face& face, const Face& other) {
    std::array<bool, 3> result{};
    for (std::size_t c = 0; c < 3; ++c) result[c] = dot(face.normal, other.points[c] - face.points[0]) >= 0;
    return result;
}

/// Whether the line through `from` and `to` intersects the triangle. The two triangles at an edge evaluate the same
/// expression for it, with its ends ordered by particle, and assign a zero to the same side. So a line through the edge
/// intersects exactly one of them.
bool line_meets(Point from, Point to, const Face& face) {
    const Point direction = to - from;
    std::array<bool, 3> left{};
    for (std::size_t s = 0; s < 3; ++s) {
        const bool turned = face.corners[sides[s].a] > face.corners[sides[s].b];
        const Point a = face.points[turned ? sides[s].b : sides[s].a] - from;
        const Point b = face.points[turned ? sides[s].a : sides[s].b] - from;
        left[s] = (dot(direction, cross(a, b)) >= 0) != turned;
    }
    return left[0] == left[1] && left[1] == left[2];
}

/// Calls visit(side) for each edge through the face that no earlier triangle has. Returns whether any edge is through
/// it.
template <class Visit>
bool visit_edges_through(const Face& edges, const Face& face, Visit&& visit) {
    const std::array<bool, 3> front = in_front(face, edges);
    if (front[0] == front[1] && front[1] == front[2]) return false;
    bool any = false;
    for (std::size_t s = 0; s < 3; ++s) {
        const Side side = sides[s];
        if (front[side.a] == front[side.b]) continue;
        if (has_corner(face, edges.corners[side.a]) || has_corner(face, edges.corners[side.b])) continue;
        // Always from the lower particle to the higher, so that both triangles at the edge get the same result.
        const bool turned = edges.corners[side.a] > edges.corners[side.b];
        const Point from = edges.points[turned ? side.b : side.a];
        const Point to = edges.points[turned ? side.a : side.b];
        if (!line_meets(from, to, face)) continue;
        any = true;
        if (edges.owns[s]) visit(side);
    }
    return any;
}

/// Calls on_edge(triangle of the edge, side, triangle) for every edge through a triangle, and on_triangles() for every
/// two triangles without a common corner that intersect.
template <class OnEdge, class OnTriangles>
void visit_crossings(std::span<const Vec3> positions, std::span<const Triangle> triangles, const CanCross& can_cross,
                     OnEdge&& on_edge, OnTriangles&& on_triangles) {
    std::vector<Face> faces;
    std::vector<bool> usable;
    std::vector<Bounds> boxes;
    faces.reserve(triangles.size());
    for (const Triangle& triangle : triangles) {
        faces.push_back(make_face(triangle, positions));
        usable.push_back(is_usable(faces.back()));
        boxes.emplace_back();
        if (!usable.back()) continue;
        for (std::uint32_t corner : triangle) boxes.back().include(positions[corner]);
    }
    assign_edges(faces, usable);

    Bvh(boxes).for_each_pair([&](std::uint32_t i, std::uint32_t j) {
        const Face& a = faces[i];
        const Face& b = faces[j];
        const int shared = shared_corners(a, b);
        if (can_cross && !can_cross(triangles[i][0], triangles[j][0])) return;
        if (shared >= 2) return;  // every edge of one triangle shares a particle with the other
        const bool ab = visit_edges_through(a, b, [&](const Side& side) { on_edge(i, side, j); });
        const bool ba = visit_edges_through(b, a, [&](const Side& side) { on_edge(j, side, i); });
        if (shared == 0 && (ab || ba)) on_triangles();
    });
}

}  // namespace

Crossings count_crossings(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                          const CanCross& can_cross) {
    Crossings crossings;
    visit_crossings(
        positions, triangles, can_cross, [&](std::uint32_t, const Side&, std::uint32_t) { ++crossings.edges; },
        [&] { ++crossings.triangles; });
    return crossings;
}

std::vector<EdgeCrossing> find_crossings(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                         const CanCross& can_cross) {
    std::vector<EdgeCrossing> found;
    visit_crossings(
        positions, triangles, can_cross,
        [&](std::uint32_t of, const Side& side, std::uint32_t triangle) {
            const auto [a, b] = std::minmax(triangles[of][side.a], triangles[of][side.b]);
            found.push_back({{a, b}, triangle});
        },
        [] {});
    std::ranges::sort(found, {}, [](const EdgeCrossing& one) { return std::pair(one.edge, one.triangle); });
    return found;
}

}  // namespace weft
