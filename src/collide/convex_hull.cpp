#include "collide/convex_hull.h"

#include "base/parameter.h"
#include "collide/closest_point.h"
#include "collide/hull_builder.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <optional>
#include <string>

namespace weft {
namespace {

// Part of the largest extent or coordinate within which a point counts as on a face. Twice the rounding of a rotation
// in floats, and a few steps of the grid.
constexpr double hull_tolerance = 1.0 / (1 << 21);
// m. Smaller hulls count as a point: the distance function squares lengths in floats.
constexpr double least_hull_extent = 1e-6;

std::string digits(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", x);
    return text;
}

std::optional<Error> check_points(std::span<const Vec3> points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 p = points[i];
        const std::string where = "point " + std::to_string(i);
        if (!finite(p))
            return Error{where, "is not finite: (" + digits(p.x) + ", " + digits(p.y) + ", " + digits(p.z) + ")"};
        const double most = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        if (most > far_away) return Error{where, "coordinates must be from -1e6 to 1e6 m, got " + digits(most) + " m"};
    }
    if (points.size() < 4)
        return Error{"points", "a convex hull needs at least 4 points, got " + std::to_string(points.size())};
    return {};
}

// Maps points to the grid, with the same scale along x, y and z. Moves a point by at most half a step per axis: 3e-8 of
// the largest extent.
struct HullGrid {
    std::array<double, 3> origin{};
    double step = 0;       // m
    double tolerance = 0;  // steps

    explicit HullGrid(const Bounds& bounds) {
        const auto largest = [](Vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
        origin = {bounds.min.x, bounds.min.y, bounds.min.z};
        const double extent = std::max({bounds.max.x - origin[0], bounds.max.y - origin[1], bounds.max.z - origin[2]});
        const double size = std::max({extent, double{largest(bounds.min)}, double{largest(bounds.max)}});
        step = std::max(extent, least_hull_extent) / hull_grid_steps;
        tolerance = (extent < least_hull_extent ? least_hull_extent : hull_tolerance * size) / step;
    }
    GridPoint snapped(Vec3 p) const {
        const auto to_step = [&](float x, double from) {
            return static_cast<std::int32_t>(std::lround((x - from) / step));
        };
        return {to_step(p.x, origin[0]), to_step(p.y, origin[1]), to_step(p.z, origin[2])};
    }
};

Error no_volume(const HullBuilder& builder, const HullGrid& grid, std::size_t count) {
    const auto within = [&](const char* what) {
        return "all " + std::to_string(count) + " points lie " + what + ", within " +
               digits(builder.thickness() * grid.step) + " m: a convex hull needs a volume";
    };
    switch (builder.shape()) {
        case HullBuilder::Shape::point:
            return {"points", within("at one place")};
        case HullBuilder::Shape::line:
            return {"points", within("on one line")};
        default:
            return {"points", within("in one plane")};
    }
}

// The remaining facets, numbered anew, and the faces that they belong to.
struct HullFaces {
    std::vector<std::uint32_t> facets;  // of the builder
    std::vector<std::uint32_t> face;    // of each of them
    std::vector<std::uint32_t> seeds;   // of each face, the facet whose plane it has
    std::vector<std::uint32_t> number;  // of each facet of the builder, its place in `facets`
};

// Joins neighboring facets whose corners are all within the tolerance of one plane. That plane is the one of the
// largest facet, not of a neighbor: joined one by one, the facets of a round shape would all become one face.
HullFaces find_faces(const HullBuilder& builder, double tolerance) {
    HullFaces faces;
    const std::span<const HullBuilder::Facet> facets = builder.facets();
    faces.number.assign(facets.size(), none);
    for (std::uint32_t f = 0; f < facets.size(); ++f) {
        if (facets[f].removed) continue;
        faces.number[f] = static_cast<std::uint32_t>(faces.facets.size());
        faces.facets.push_back(f);
    }
    faces.face.assign(faces.facets.size(), none);
    std::vector<std::uint32_t> by_size = faces.facets, open;
    std::ranges::stable_sort(by_size, std::greater(), [&](std::uint32_t f) { return facets[f].length; });
    for (const std::uint32_t seed : by_size) {
        if (faces.face[faces.number[seed]] != none) continue;
        const auto face = static_cast<std::uint32_t>(faces.seeds.size());
        faces.seeds.push_back(seed);
        faces.face[faces.number[seed]] = face;
        open.assign(1, seed);
        while (!open.empty()) {
            const std::uint32_t f = open.back();
            open.pop_back();
            for (const std::uint32_t next : facets[f].neighbors) {
                if (faces.face[faces.number[next]] != none) continue;
                const bool on_plane = std::ranges::all_of(facets[next].corners, [&](std::uint32_t corner) {
                    return std::abs(builder.distance(facets[seed], corner)) <= tolerance;
                });
                if (!on_plane) continue;
                faces.face[faces.number[next]] = face;
                open.push_back(next);
            }
        }
    }
    return faces;
}

// The points where at least three faces meet, ascending. Other vertices lie within a face or an edge.
std::vector<std::uint32_t> corners_of(const HullBuilder& builder, const HullFaces& faces) {
    std::vector<std::array<std::uint32_t, 2>> uses;  // point, face
    for (std::size_t i = 0; i < faces.facets.size(); ++i)
        for (const std::uint32_t point : builder.facets()[faces.facets[i]].corners)
            uses.push_back({point, faces.face[i]});
    std::ranges::sort(uses);
    uses.erase(std::unique(uses.begin(), uses.end()), uses.end());
    std::vector<std::uint32_t> corners;
    for (std::size_t i = 0; i < uses.size();) {
        std::size_t end = i;
        while (end < uses.size() && uses[end][0] == uses[i][0]) ++end;
        if (end - i >= 3) corners.push_back(uses[i][0]);
        i = end;
    }
    return corners;
}

std::size_t vertex_count(const HullBuilder& builder) {
    return builder.facet_count() / 2 + 2;
}

ConvexHull to_hull(const HullBuilder& builder, const HullFaces& faces, std::span<const Vec3> points) {
    const std::span<const HullBuilder::Facet> facets = builder.facets();
    ConvexHull hull;
    std::vector<std::uint32_t> used;
    for (const std::uint32_t f : faces.facets)
        used.insert(used.end(), facets[f].corners.begin(), facets[f].corners.end());
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (const std::uint32_t point : used) hull.vertices.push_back(points[point]);
    const auto vertex = [&](std::uint32_t point) {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(used, point) - used.begin());
    };
    for (const std::uint32_t seed : faces.seeds) {
        const HullBuilder::Facet& facet = facets[seed];
        const auto part = [&](std::size_t i) {
            return static_cast<float>(static_cast<double>(facet.normal[i]) / facet.length);
        };
        const Vec3 n{part(0), part(1), part(2)};
        // The farthest vertex is on the plane: the points are not exactly those of the grid.
        double offset = -std::numeric_limits<double>::infinity();
        for (const Vec3 v : hull.vertices)
            offset = std::max(offset, double{n.x} * v.x + double{n.y} * v.y + double{n.z} * v.z);
        hull.faces.push_back({n, static_cast<float>(offset)});
    }
    for (std::size_t i = 0; i < faces.facets.size(); ++i) {
        const HullBuilder::Facet& facet = facets[faces.facets[i]];
        hull.triangles.push_back({vertex(facet.corners[0]), vertex(facet.corners[1]), vertex(facet.corners[2])});
        hull.face_of_triangle.push_back(faces.face[i]);
        for (std::size_t side = 0; side < 3; ++side) {
            const std::uint32_t a = hull.triangles.back()[side], b = hull.triangles.back()[(side + 1) % 3];
            if (a < b && faces.face[faces.number[facet.neighbors[side]]] != faces.face[i]) hull.edges.push_back({a, b});
        }
    }
    std::ranges::sort(hull.edges);
    return hull;
}

template <class T>
std::vector<T> at_indices(std::span<const T> values, std::span<const std::uint32_t> indices) {
    std::vector<T> chosen;
    chosen.reserve(indices.size());
    for (const std::uint32_t i : indices) chosen.push_back(values[i]);
    return chosen;
}

// Rounding leaves vertices within faces and edges. The hull of the other ones is the same up to the tolerance. Removing
// a vertex can flatten another one, though hardly more than once.
ConvexHull without_flat_vertices(const HullBuilder& builder, const HullGrid& grid, std::span<const Vec3> points) {
    constexpr int most_rounds = 4;
    HullFaces faces = find_faces(builder, grid.tolerance);
    ConvexHull hull = to_hull(builder, faces, points);
    std::vector<std::uint32_t> corners = corners_of(builder, faces);
    std::vector<Vec3> kept = at_indices(points, corners);
    for (int round = 0; round < most_rounds && kept.size() < hull.vertices.size(); ++round) {
        std::vector<GridPoint> snapped;
        for (const Vec3 p : kept) snapped.push_back(grid.snapped(p));
        HullBuilder smaller(snapped, grid.tolerance);
        if (smaller.shape() != HullBuilder::Shape::volume) break;
        smaller.grow(max_hull_vertices);
        faces = find_faces(smaller, grid.tolerance);
        hull = to_hull(smaller, faces, kept);
        corners = corners_of(smaller, faces);
        kept = at_indices(std::span<const Vec3>(kept), corners);
    }
    return hull;
}

// The largest distance to the hull of a point that the builder has left outside. The distance to the triangle that the
// point is in front of is an upper bound, and exact if the closest point is within the triangle, so that few points
// need a search.
double find_shortfall(const HullBuilder& builder, const ConvexHull& hull, std::span<const Vec3> points) {
    const SurfaceSearch search(hull.vertices, hull.triangles);
    double most = 0;
    for (const HullBuilder::Facet& facet : builder.facets()) {
        if (facet.removed) continue;
        const auto [a, b, c] = facet.corners;
        for (const std::uint32_t p : facet.outside) {
            const TrianglePoint near = closest_on_triangle(points[p], points[a], points[b], points[c]);
            if (near.squared_distance <= most * most) continue;
            const bool within = std::ranges::all_of(near.weights, [](double w) { return w > 0; });
            most = std::max(most, within ? std::sqrt(near.squared_distance) : search.closest(points[p]).distance);
        }
    }
    return most;
}

}  // namespace

Result<ConvexHull> convex_hull(std::span<const Vec3> points, std::size_t max_vertices) {
    assert(max_vertices >= 4 && max_vertices <= max_hull_vertices);
    if (const std::optional<Error> error = check_points(points)) return *error;
    const HullGrid grid(bounds_of(points));
    std::vector<GridPoint> snapped;
    snapped.reserve(points.size());
    for (const Vec3 p : points) snapped.push_back(grid.snapped(p));
    HullBuilder builder(snapped, grid.tolerance);
    if (builder.shape() != HullBuilder::Shape::volume) return no_volume(builder, grid, points.size());
    builder.grow(max_vertices);
    ConvexHull hull = without_flat_vertices(builder, grid, points);
    if (vertex_count(builder) >= max_vertices) hull.shortfall = find_shortfall(builder, hull, points);
    return hull;
}

}  // namespace weft
