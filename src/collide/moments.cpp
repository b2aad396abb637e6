#include "collide/moments.h"

#include "base/wide_vector.h"
#include "mesh/weld.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace weft {
namespace {

using Place = WideVec3;

void add_volume(Moments& sum, double volume) {
    sum.volume += volume;
}
void add_first(Moments& sum, const Place& a, double weight) {
    sum.first[0] += weight * a.x, sum.first[1] += weight * a.y, sum.first[2] += weight * a.z;
}
// weight · (a bᵀ + b aᵀ) / 2
void add_second(Moments& sum, const Place& a, const Place& b, double weight) {
    sum.second[0] += weight * a.x * b.x;
    sum.second[1] += weight * a.y * b.y;
    sum.second[2] += weight * a.z * b.z;
    sum.second[3] += 0.5 * weight * (a.y * b.z + a.z * b.y);
    sum.second[4] += 0.5 * weight * (a.z * b.x + a.x * b.z);
    sum.second[5] += 0.5 * weight * (a.x * b.y + a.y * b.x);
}
void add_multiple_of_identity(Moments& sum, double weight) {
    for (std::size_t i = 0; i < 3; ++i) sum.second[i] += weight;
}

using Corners = std::array<Place, 3>;

Place seen_from(const MomentOrigin& origin, Vec3 p) {
    return {p.x - origin[0], p.y - origin[1], p.z - origin[2]};
}
Corners corners_from(const MomentOrigin& origin, std::span<const Vec3> positions, const Triangle& t) {
    return {seen_from(origin, positions[t[0]]), seen_from(origin, positions[t[1]]), seen_from(origin, positions[t[2]])};
}
Place area_vector(const Corners& c) {
    return cross(c[1] - c[0], c[2] - c[0]) * 0.5;
}

// `weight`: of each corner's x xᵀ, and of that of the sum of the corners.
void add_corners(Moments& sum, const Corners& c, double weight) {
    const Place all = c[0] + c[1] + c[2];
    for (const Place& p : c) add_second(sum, p, p, weight);
    add_second(sum, all, all, weight);
}

// Everything within `height` in front of a triangle.
void add_prism(Moments& sum, const Corners& c, const Place& normal, double height) {
    const double area = length(area_vector(c));
    const Place middle = (c[0] + c[1] + c[2]) * (1.0 / 3);
    add_volume(sum, area * height);
    add_first(sum, middle, area * height);
    add_first(sum, normal, area * height * height / 2);
    add_corners(sum, c, area * height / 12);
    add_second(sum, middle, normal, area * height * height);
    add_second(sum, normal, normal, area * height * height * height / 3);
}

// The directions between the normals of two faces: an arc around their edge.
struct Arc {
    double angle;  // negative at an edge that is concave by rounding
    Place along;   // unit, along the edge
    Place toward;  // unit, to the middle of the arc
    Place across;  // unit, perpendicular to both
    Place mean;    // ∫ u over the arc
    Arc(const Place& from, const Place& to, const Place& edge) : along(edge) {
        angle = std::atan2(dot(cross(from, to), edge), dot(from, to));
        const Place middle = from + to;
        toward = middle * (1 / length(middle));
        across = cross(along, toward);
        mean = toward * (2 * std::sin(angle / 2));
    }
};

// Everything within `radius` of an edge, in the directions of the arc.
void add_wedge(Moments& sum, const Place& from, const Place& to, const Arc& arc, double radius) {
    const Place middle = (from + to) * 0.5;
    const double size = length(to - from), r2 = radius * radius, volume = 0.5 * arc.angle * r2 * size;
    add_volume(sum, volume);
    add_first(sum, middle, volume);
    add_first(sum, arc.mean, size * r2 * radius / 3);
    add_second(sum, middle, middle, volume);
    add_second(sum, arc.along, arc.along, volume * size * size / 12);
    add_second(sum, middle, arc.mean, 2 * size * r2 * radius / 3);
    const double disk = size * r2 * r2 / 8;
    add_second(sum, arc.toward, arc.toward, disk * (arc.angle + std::sin(arc.angle)));
    add_second(sum, arc.across, arc.across, disk * (arc.angle - std::sin(arc.angle)));
}

// The directions from a corner in which no face is: a polygon on the unit sphere, whose sides are the arcs of the
// corner's edges. Integrals over it are sums over its sides (Arvo, "Applications of Irradiance Tensors to the
// Simulation of Non-Lambertian Phenomena", SIGGRAPH 1995): of 1 by the angles of the faces, of u and u uᵀ by the arcs.
struct CornerDirections {
    double solid_angle = 2 * std::numbers::pi;  // less the angle of each face at the corner
    Moments moments;                            // over the unit sphere; its volume is not used
    void add_side(const Arc& arc, const Place& outward) {
        add_first(moments, outward, -0.5 * arc.angle);
        add_second(moments, arc.mean, outward, -1.0 / 3);
    }
};

void add_corner(Moments& sum, const Place& corner, const CornerDirections& directions, double radius) {
    const double r3 = radius * radius * radius, volume = directions.solid_angle * r3 / 3;
    const auto& [x, y, z] = directions.moments.first;
    add_volume(sum, volume);
    add_first(sum, corner, volume);
    add_first(sum, {x, y, z}, r3 * radius / 4);
    add_second(sum, corner, corner, volume);
    add_second(sum, corner, {x, y, z}, r3 * radius / 2);
    const double fifth = r3 * radius * radius / 5;
    for (std::size_t i = 0; i < 6; ++i) sum.second[i] += fifth * directions.moments.second[i];
    add_multiple_of_identity(sum, fifth * directions.solid_angle / 3);
}

double angle_between(const Place& a, const Place& b) {
    return std::atan2(length(cross(a, b)), dot(a, b));
}

struct SideOfFace {
    std::uint32_t low, high;  // corners
    std::uint32_t triangle;
    bool upward;  // the triangle goes from the lower to the higher corner
};

}  // namespace

Moments& operator+=(Moments& sum, const Moments& more) {
    sum.volume += more.volume;
    for (std::size_t i = 0; i < 3; ++i) sum.first[i] += more.first[i];
    for (std::size_t i = 0; i < 6; ++i) sum.second[i] += more.second[i];
    return sum;
}

Moments operator*(const Moments& moments, double factor) {
    Moments product = moments;
    product.volume *= factor;
    for (double& x : product.first) x *= factor;
    for (double& x : product.second) x *= factor;
    return product;
}

Moments moments_of_solid(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                         const MomentOrigin& origin) {
    Moments sum;
    for (const Triangle& t : triangles) {
        const Corners c = corners_from(origin, positions, t);
        const double volume = dot(c[0], cross(c[1], c[2])) / 6;  // of the tetrahedron from the origin
        add_volume(sum, volume);
        add_first(sum, c[0] + c[1] + c[2], volume / 4);
        add_corners(sum, c, volume / 20);
    }
    return sum;
}

Moments moments_of_shell(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                         const MomentOrigin& origin) {
    Moments sum;
    for (const Triangle& t : triangles) {
        const Corners c = corners_from(origin, positions, t);
        const double area = length(area_vector(c));
        add_volume(sum, area);
        add_first(sum, c[0] + c[1] + c[2], area / 3);
        add_corners(sum, c, area / 12);
    }
    return sum;
}

// Normals of the faces and not of the triangles: a sliver has none that is exact.
Moments moments_of_rounded(const TriangleMesh& convex, double radius, const MomentOrigin& origin) {
    Moments sum = moments_of_solid(convex.positions, convex.triangles, origin);
    if (radius == 0) return sum;
    const Weld weld = weld_vertices(convex.positions, 0);
    std::vector<Place> normals;
    std::vector<CornerDirections> directions(weld.first_vertex.size());
    std::vector<SideOfFace> sides;
    for (const Triangle& t : convex.triangles) {
        const Corners c = corners_from(origin, convex.positions, t);
        normals.push_back(seen_from({}, convex.normals[t[0]]));
        add_prism(sum, c, normals.back(), radius);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t next = (i + 1) % 3, last = (i + 2) % 3;
            const std::uint32_t a = weld.vertex_to_welded[t[i]], b = weld.vertex_to_welded[t[next]];
            directions[a].solid_angle -= angle_between(c[next] - c[i], c[last] - c[i]);
            sides.push_back({std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(normals.size() - 1), a < b});
        }
    }
    std::ranges::sort(sides, [](const SideOfFace& a, const SideOfFace& b) {
        return std::array{a.low, a.high, a.triangle} < std::array{b.low, b.high, b.triangle};
    });
    const auto place_of = [&](std::uint32_t welded) {
        return seen_from(origin, convex.positions[weld.first_vertex[welded]]);
    };
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
        const SideOfFace &one = sides[i], &other = sides[i + 1];
        if (one.low != other.low || one.high != other.high) continue;
        const Place from = place_of(one.low), to = place_of(one.high);
        const Place along = (to - from) * (1 / length(to - from));
        // Seen from outside, the face that goes along with the edge is on its left.
        const SideOfFace &left = one.upward ? one : other, &right = one.upward ? other : one;
        const Arc arc(normals[left.triangle], normals[right.triangle], along);
        add_wedge(sum, from, to, arc, radius);
        directions[one.low].add_side(arc, along);
        directions[one.high].add_side(arc, along * -1);
    }
    for (std::uint32_t v = 0; v < directions.size(); ++v) add_corner(sum, place_of(v), directions[v], radius);
    return sum;
}

// By Gauss' rule with three points, which is exact: the integrals are of polynomials up to the fourth degree.
Moments moments_of_revolved(const RevolvedPart& part) {
    Moments sum;
    const double half = (part.to - part.from) / 2, middle = (part.to + part.from) / 2;
    const double outer = std::sqrt(0.6);
    const std::array<std::array<double, 2>, 3> rule{{{-outer, 5.0 / 9}, {0, 8.0 / 9}, {outer, 5.0 / 9}}};
    for (const auto& [at, weight] : rule) {
        const double y = middle + half * at, square = part.a + y * (part.b + y * part.c);
        const double slice = std::numbers::pi * square * half * weight;
        sum.volume += slice;
        sum.first[1] += slice * y;
        sum.second[0] += slice * square / 4;
        sum.second[1] += slice * y * y;
        sum.second[2] += slice * square / 4;
    }
    return sum;
}

}  // namespace weft
