// Curvature relative to the rest shape. Computed from the angles across the edges of a triangle, as in plate.md:
//
//     K = sum over its edges of (angle - angle at rest) · length / (2 · area) · n⊗n
//
// n is the unit vector perpendicular to the edge, and all lengths are those at rest. A sheet rolled to a radius R has
// the curvature 1/R across the roll, independent of the mesh and its constraints. The value of a triangle is the larger
// principal curvature. The value of a vertex is the mean over its triangles.

#include "mesh/edges.h"
#include "physics/scalar.h"
#include "view/nice_numbers.h"
#include "view/overlay_parts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::overlay {
namespace {

// 1/m: lower bound for the end of the scale, a radius of half a meter.
constexpr double least_scale_of_bending = 2;

double angle_across(const Hinge& hinge, std::span<const Vec4> positions) {
    const auto at = [&](std::uint32_t p) { return reference::vec3(positions[p].x, positions[p].y, positions[p].z); };
    return reference::hinge_angle(at(hinge.a), at(hinge.b), at(hinge.c), at(hinge.d)).theta;
}

// rad, positive toward the side of the first triangle's normal.
double angle_at_rest(const Hinge& hinge, const ClothModel& model) {
    const float given = model.fabric.bend.rest_angle;
    return std::isnan(given) ? angle_across(hinge, model.start) : given * std::numbers::pi / 180;
}

bool winds(const Triangle& triangle, std::uint32_t a, std::uint32_t b) {
    for (int side = 0; side < 3; ++side)
        if (triangle[side] == a && triangle[(side + 1) % 3] == b) return true;
    return false;
}

// A symmetric tensor in the plane of the triangle, with x along its first side.
struct Curvature {
    double xx = 0, xy = 0, yy = 0;
    int sides = 0;

    double larger_principal() const {
        const double mean = (xx + yy) / 2, half = (xx - yy) / 2;
        return std::abs(mean) + std::sqrt(half * half + xy * xy);
    }
};

// Adds the term of the angle across the side from a to b.
void add_side(Curvature& sum, const Triangle& triangle, std::uint32_t a, std::uint32_t b, double angle,
              const ClothModel& model) {
    const Vec3 origin = model.rest_position(triangle[0]);
    const Vec3 first = model.rest_position(triangle[1]) - origin, second = model.rest_position(triangle[2]) - origin;
    const double twice_area = length(cross(first, second));
    const Vec3 x = normalized(first), y = normalized(cross(cross(first, second), first));
    const Vec3 edge = model.rest_position(b) - model.rest_position(a);
    // length · n⊗n = r⊗r / length, where r is the edge rotated by 90 degrees, r = length · n.
    const double ex = dot(edge, x), ey = dot(edge, y), scale = angle / (twice_area * length(edge));
    if (!std::isfinite(scale)) return;
    sum.xx += scale * ey * ey;
    sum.xy -= scale * ex * ey;
    sum.yy += scale * ex * ex;
    sum.sides += 1;
}

std::vector<Curvature> curvature_of(const ClothFrame& cloth, const std::vector<Triangle>& triangles) {
    const ClothModel& model = *cloth.model;
    const EdgeList edges = build_edges(triangles, model.particle_count);
    std::vector<Curvature> curvatures(triangles.size());
    for (const Hinge& hinge : build_hinges(edges, triangles).hinges) {
        const double angle = static_cast<double>(
            reference::wrap_angle(angle_across(hinge, cloth.positions) - angle_at_rest(hinge, model)));
        if (!std::isfinite(angle)) continue;
        // The sign refers to the front side of each triangle, so a triangle with the opposite winding gets the opposite
        // sign.
        const std::uint32_t left = hinge.triangle0, right = hinge.triangle1;
        const double to_left = winds(triangles[left], hinge.a, hinge.b) ? angle : -angle;
        const double to_right = winds(triangles[right], hinge.a, hinge.b) ? -angle : angle;
        add_side(curvatures[left], triangles[left], hinge.a, hinge.b, to_left, model);
        add_side(curvatures[right], triangles[right], hinge.a, hinge.b, to_right, model);
    }
    return curvatures;
}

// 1/m, per particle. Triangles at a border lack an angle, so triangles with all three angles are preferred.
std::vector<float> bending_of(const ClothFrame& cloth) {
    const ClothModel& model = *cloth.model;
    const std::vector<Triangle> triangles(cloth.triangles.begin(), cloth.triangles.end());
    const std::vector<Curvature> curvatures = curvature_of(cloth, triangles);
    std::vector<std::uint8_t> inside(model.particle_count);
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (const std::uint32_t p : triangles[t]) inside[p] |= curvatures[t].sides == 3;
    ParticleMeans means(model.particle_count);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto& [a, b, c] = triangles[t];
        const double area = area_of(model.rest_position(a), model.rest_position(b), model.rest_position(c));
        for (const std::uint32_t p : {a, b, c})
            if (curvatures[t].sides == 3 || !inside[p]) means.add(p, curvatures[t].larger_principal(), area);
    }
    return means.result();
}

}  // namespace

void bending(const OverlayInput& input, OverlayOutput& output) {
    std::vector<float> all;
    for (const ClothFrame& cloth : input.frame.cloths) {
        const std::vector<float> values = bending_of(cloth);
        all.insert(all.end(), values.begin(), values.end());
        output.scalars.push_back({.values = at_vertices(*cloth.model, values)});
    }
    if (output.scalars.empty()) return;
    const auto most = static_cast<float>(std::max(least_scale_of_bending, nice_above(percentile(all, 0.98))));
    for (Scalars& scalars : output.scalars) {
        scalars.most = most;
        scalars.scale = render::ColorScale::amount;
    }
    output.legends.push_back({.title = "curvature beyond rest, 1/m",
                              .bar = Legend::Bar{0, most, render::ColorScale::amount},
                              .of_scalars = true});
}

}  // namespace weft::overlay
