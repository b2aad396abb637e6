#include "collide/body_mass.h"

#include "base/disjoint_sets.h"
#include "collide/moments.h"
#include "collide/shape_data.h"
#include "collide/solid_surface.h"
#include "collide/winding_number.h"
#include "mesh/weld.h"
#include "physics/body/body.data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace weft {
namespace {

// Values of a body in floats, with a margin for products of two of them and of lengths.
constexpr double least_value = 1e-30, largest_value = 1e30;

std::string figure_text(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", x);
    return text;
}

// What mass and inertia follow from.
struct MassShape {
    Moments moments;             // about `origin`
    MomentOrigin origin{};       // m
    const char* no_volume = "";  // why the moments are those of a shell; empty: they are of a solid
};

using FoundShape = Result<MassShape>;

FoundShape mass_shape_of(const PlaneDesc&, const ShapeData*) {
    return Error{"", "a plane has no volume, so it cannot be a body"};
}

// A ball around the y axis, or the part of it from `from` to `to`.
RevolvedPart part_of_ball(double center, double radius, double from, double to) {
    return {from, to, radius * radius - center * center, 2 * center, -1};
}

Moments moments_of_ball(double center, double radius) {
    return moments_of_revolved(part_of_ball(center, radius, center - radius, center + radius));
}

FoundShape mass_shape_of(const SphereDesc& sphere, const ShapeData*) {
    return MassShape{.moments = moments_of_ball(0, sphere.radius)};
}

FoundShape mass_shape_of(const BoxDesc& box, const ShapeData*) {
    const double x = box.half_extents.x, y = box.half_extents.y, z = box.half_extents.z, volume = 8 * x * y * z;
    return MassShape{.moments = {volume, {}, {volume * x * x / 3, volume * y * y / 3, volume * z * z / 3, 0, 0, 0}}};
}

// A part of each ball, and between them the cone that touches both.
Moments moments_of_balls(double low_radius, double high_radius, double half_height) {
    const double length = 2 * half_height, slope = (low_radius - high_radius) / length;
    if (!(std::abs(low_radius - high_radius) < length))
        return low_radius < high_radius ? moments_of_ball(half_height, high_radius)
                                        : moments_of_ball(-half_height, low_radius);
    const double low_end = -half_height + low_radius * slope, high_end = half_height + high_radius * slope;
    Moments sum = moments_of_revolved(part_of_ball(-half_height, low_radius, -half_height - low_radius, low_end));
    sum += moments_of_revolved(part_of_ball(half_height, high_radius, high_end, half_height + high_radius));
    const double shrink = std::sqrt(1 - slope * slope), from = low_radius * shrink, to = high_radius * shrink;
    const double grow = (to - from) / (high_end - low_end), at_zero = from - grow * low_end;
    sum += moments_of_revolved({low_end, high_end, at_zero * at_zero, 2 * at_zero * grow, grow * grow});
    return sum;
}

FoundShape mass_shape_of(const CapsuleDesc& capsule, const ShapeData*) {
    return MassShape{.moments = moments_of_balls(capsule.radius, capsule.radius, capsule.half_height)};
}

FoundShape mass_shape_of(const TaperedCapsuleDesc& capsule, const ShapeData*) {
    return MassShape{.moments = moments_of_balls(capsule.radius[0], capsule.radius[1], capsule.half_height)};
}

MomentOrigin origin_in(const Bounds& bounds) {
    const Vec3 center = bounds.center();
    return {center.x, center.y, center.z};
}

FoundShape mass_shape_of(const ConvexDesc& convex, const ShapeData* data) {
    const MomentOrigin origin = origin_in(data->bounds);
    return MassShape{.moments = moments_of_rounded(data->surface, convex.radius, origin), .origin = origin};
}

// The triangles that edges connect, in order of their first triangle.
std::vector<std::vector<Triangle>> parts_of(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
    const Weld weld = weld_vertices(positions, 0);
    std::vector<std::array<std::uint32_t, 3>> sides;  // two corners, triangle
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = weld.vertex_to_welded[triangles[t][i]],
                                b = weld.vertex_to_welded[triangles[t][(i + 1) % 3]];
            sides.push_back({std::min(a, b), std::max(a, b), t});
        }
    }
    std::ranges::sort(sides);
    DisjointSets sets(static_cast<std::uint32_t>(triangles.size()));
    for (std::size_t i = 0; i + 1 < sides.size(); ++i)
        if (sides[i][0] == sides[i + 1][0] && sides[i][1] == sides[i + 1][1]) sets.merge(sides[i][2], sides[i + 1][2]);
    std::vector<std::vector<Triangle>> parts;
    for (const auto& set : sets.sets()) {
        parts.emplace_back();
        for (const std::uint32_t t : set) parts.back().push_back(triangles[t]);
    }
    return parts;
}

// 1 if most of the part's area is where the solid ends behind its triangles, -1 if it ends in front of them, 0 if both
// sides are inside or both are outside.
double weight_of(std::span<const Triangle> part, std::span<const Vec3> positions, const WindingNumber& winding) {
    constexpr std::size_t most_samples = 256;
    const std::size_t step = (part.size() + most_samples - 1) / most_samples;
    double behind = 0, in_front = 0, neither = 0;
    for (std::size_t i = 0; i < part.size(); i += step) {
        const Vec3 a = positions[part[i][0]], b = positions[part[i][1]], c = positions[part[i][2]];
        const Vec3 normal = cross(b - a, c - a), middle = (a + b + c) * (1.0f / 3);
        const double area = length(normal);
        const Vec3 up = normalized(normal) * static_cast<float>(1e-3 * std::sqrt(area));
        const bool back = std::abs(winding.at(middle - up)) > 0.5, front = std::abs(winding.at(middle + up)) > 0.5;
        (back == front ? neither : back ? behind : in_front) += area;
    }
    if (neither >= behind && neither >= in_front) return 0;
    return behind >= in_front ? 1 : -1;
}

Moments moments_of_mesh(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                        const MomentOrigin& origin) {
    const auto parts = parts_of(positions, triangles);
    if (parts.size() == 1) {
        const Moments whole = moments_of_solid(positions, triangles, origin);
        return whole * (whole.volume < 0 ? -1 : 1);
    }
    const WindingNumber winding(positions, triangles);
    Moments sum;
    for (const auto& part : parts)
        sum += moments_of_solid(positions, part, origin) * weight_of(part, positions, winding);
    return sum;
}

FoundShape mass_shape_of(const SolidMeshDesc&, const ShapeData* data) {
    // Of the area to the power of 3/2. Rounding of positions gives a flat mesh about this volume.
    constexpr double least_volume = 1e-7;
    const std::vector<Vec3>& positions = data->surface.positions;
    const OrientedTriangles oriented = orient_triangles(positions, data->surface.triangles);
    const MomentOrigin origin = origin_in(data->bounds);
    MassShape shape{.moments = moments_of_shell(positions, oriented.triangles, origin), .origin = origin};
    if (!oriented.boundary.empty()) {
        shape.no_volume = "the mesh has holes";
        return shape;
    }
    const Moments solid = moments_of_mesh(positions, oriented.triangles, origin);
    if (solid.volume > least_volume * std::pow(shape.moments.volume, 1.5))
        shape.moments = solid;
    else
        shape.no_volume = "the mesh encloses nothing";
    return shape;
}

using SymmetricMatrix = std::array<double, 6>;  // xx, yy, zz, yz, zx, xy

std::optional<SymmetricMatrix> inverse_of(const SymmetricMatrix& m) {
    const auto& [xx, yy, zz, yz, zx, xy] = m;
    const double a = yy * zz - yz * yz, b = zx * yz - xy * zz, c = xy * yz - zx * yy;
    const double determinant = xx * a + xy * b + zx * c;
    if (!(determinant > 0)) return std::nullopt;
    return SymmetricMatrix{a / determinant,
                           (xx * zz - zx * zx) / determinant,
                           (xx * yy - xy * xy) / determinant,
                           (xy * zx - xx * yz) / determinant,
                           c / determinant,
                           b / determinant};
}

// Per kg, about the center of mass.
SymmetricMatrix inertia_per_mass(const Moments& moments, const std::array<double, 3>& center) {
    const auto& [x, y, z] = center;
    const auto& second = moments.second;
    const auto about_center = [&](std::size_t i, double a, double b) { return second[i] / moments.volume - a * b; };
    const double xx = about_center(0, x, x), yy = about_center(1, y, y), zz = about_center(2, z, z);
    // 0 - x and not -x, which would be a negative zero.
    return {yy + zz, zz + xx, xx + yy, 0 - about_center(3, y, z), 0 - about_center(4, z, x), 0 - about_center(5, x, y)};
}

bool fits_floats(double x) {
    return x >= least_value && x <= largest_value;
}

std::optional<Error> problem_of_values(const BodyDesc& body) {
    if (!(body.mass >= 0 && std::isfinite(body.mass)))
        return Error{"/mass", "must be ≥ 0 kg, got " + figure_text(body.mass)};
    if (body.mass == 0 && !(body.density > 0 && std::isfinite(body.density)))
        return Error{"/density", "must be > 0 kg/m³, got " + figure_text(body.density)};
    if (!finite(body.center)) return Error{"/center", "must be finite"};
    const Vec3 given = body.inertia;
    if (const auto what = inertia_problem(given); !finite(given) || !what.empty())
        return Error{"/inertia", (what.empty() ? "must be finite" : std::string(what)) + ", got [" +
                                     figure_text(given.x) + ", " + figure_text(given.y) + ", " + figure_text(given.z) +
                                     "]"};
    return std::nullopt;
}

// The result in floats, or what does not fit.
Result<BodyMass> to_floats(double mass, const std::array<double, 3>& center, const SymmetricMatrix& inertia) {
    const auto error_of = [&](const char* what, double value, const char* unit) {
        return Error{"", std::string("the body is too ") + (value > 1 ? "large" : "small") + ": its " + what + " is " +
                             figure_text(value) + unit + "; it must be from 1e-30 to 1e30"};
    };
    if (!fits_floats(mass)) return error_of("mass", mass, " kg");
    const auto inverse = inverse_of(inertia);
    for (std::size_t i = 0; i < 3; ++i)
        if (!fits_floats(inertia[i])) return error_of("moment of inertia", inertia[i], " kg·m²");
    if (!inverse || !std::ranges::all_of(std::span(*inverse).first(3), fits_floats))
        return Error{"", "the body is too thin: one of its moments of inertia is too small beside the others"};
    BodyMass made{.mass = static_cast<float>(mass), .center = {}};
    made.center = {static_cast<float>(center[0]), static_cast<float>(center[1]), static_cast<float>(center[2])};
    for (std::size_t i = 0; i < 6; ++i) {
        made.inertia[i] = static_cast<float>(inertia[i]);
        made.inverse_inertia[i] = static_cast<float>((*inverse)[i]);
    }
    return made;
}

}  // namespace

Result<BodyMass> body_mass_of(const BodyDesc& body, const ColliderShape& shape, const ShapeData* data,
                              std::string* note) {
    if (note) note->clear();
    if (const auto problem = problem_of_values(body)) return *problem;
    const auto found = std::visit([&](const auto& one) { return mass_shape_of(one, data); }, shape);
    if (!found) return found.errors();
    const Moments& moments = found->moments;
    const bool shell = *found->no_volume != 0;
    if (shell && body.mass == 0)
        return Error{"/mass", std::string("must be given: ") + found->no_volume + ", so it has no volume"};
    if (!(moments.volume > 0) || !std::isfinite(moments.volume))
        return Error{"", "the shape has no volume in floats, got " + figure_text(moments.volume) + " m³"};
    const double mass = body.mass > 0 ? double{body.mass} : double{body.density} * moments.volume;
    std::array<double, 3> center{};
    for (std::size_t i = 0; i < 3; ++i) center[i] = moments.first[i] / moments.volume;
    SymmetricMatrix inertia = inertia_per_mass(moments, center);
    for (double& x : inertia) x *= mass;
    const Vec3 given = body.inertia, offset = body.center;
    if (!(given == Vec3{})) inertia = {given.x, given.y, given.z, 0, 0, 0};
    if (shell && note && given == Vec3{})
        *note = std::string(found->no_volume) + ", so its center and moments of inertia are those of a shell";
    const std::array<double, 3> moved{offset.x, offset.y, offset.z};
    for (std::size_t i = 0; i < 3; ++i) center[i] += found->origin[i] + moved[i];
    return to_floats(mass, center, inertia);
}

BodyMass with_points(const BodyMass& body, std::span<const PointMass> points) {
    if (points.empty()) return body;
    double mass = body.mass;
    std::array<double, 3> first{mass * body.center.x, mass * body.center.y, mass * body.center.z};
    for (const PointMass& point : points) {
        mass += point.mass;
        first[0] += double{point.mass} * point.place.x;
        first[1] += double{point.mass} * point.place.y;
        first[2] += double{point.mass} * point.place.z;
    }
    const std::array<double, 3> center{first[0] / mass, first[1] / mass, first[2] / mass};
    SymmetricMatrix inertia{};
    std::ranges::copy(body.inertia, inertia.begin());
    const auto add = [&](double m, Vec3 place) {
        const double x = place.x - center[0], y = place.y - center[1], z = place.z - center[2];
        inertia[0] += m * (y * y + z * z), inertia[1] += m * (z * z + x * x), inertia[2] += m * (x * x + y * y);
        inertia[3] -= m * y * z, inertia[4] -= m * z * x, inertia[5] -= m * x * y;
    };
    add(body.mass, body.center);
    for (const PointMass& point : points) add(point.mass, point.place);
    const auto sum = to_floats(mass, center, inertia);
    return sum ? *sum : body;
}

}  // namespace weft
