#include "collide/thin_parts.h"

#include "collide/closest_point.h"
#include "collide/solid_surface.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace weft {
namespace {

constexpr double most_points = 1 << 24;  // of large triangles; beyond that they are sampled less densely
constexpr float not_thin = std::numeric_limits<float>::infinity();

double longest_side(Vec3 a, Vec3 b, Vec3 c) {
    return std::sqrt(std::max({double{dot(b - a, b - a)}, double{dot(c - b, c - b)}, double{dot(a - c, a - c)}}));
}

Vec3 unit_normal_of(const SolidSurface& surface, std::uint32_t triangle) {
    const auto [a, b, c] = surface.triangles()[triangle];
    const Vec3 origin = surface.positions()[a];
    return normalized(cross(surface.positions()[b] - origin, surface.positions()[c] - origin));
}

// Thickness at the sample in the direction of `down`, a unit vector; not_thin if it is two or more, or if there is no
// solid.
float thickness_along(const SolidSurface& surface, const SurfaceSample& sample, Vec3 normal, Vec3 down) {
    const Vec3 below = sample.position + down;
    const std::uint32_t other = surface.nearest(below, sample.triangle).triangle;
    if (other == sample.triangle || dot(normal, unit_normal_of(surface, other)) > -0.5f) return not_thin;
    const auto [a, b, c] = surface.triangles()[other];
    const Vec3 pa = surface.positions()[a], pb = surface.positions()[b], pc = surface.positions()[c];
    const auto weights = closest_on_triangle(below, pa, pb, pc).weights;
    const Vec3 opposite =
        pa * static_cast<float>(weights[0]) + pb * static_cast<float>(weights[1]) + pc * static_cast<float>(weights[2]);
    const Vec3 up = normalized(sample.position - opposite);
    const float thickness = length(sample.position - opposite);
    constexpr float slightly = 0.05f;
    const bool solid = thickness > 0 && surface.inside((sample.position + opposite) * 0.5f) &&
                       !surface.inside(sample.position + up * slightly) && !surface.inside(opposite - up * slightly);
    return solid ? thickness : not_thin;
}

}  // namespace

std::vector<SurfaceSample> sample_surface(const SolidSurface& surface, FunctionRef<bool(Vec3)> claim) {
    const auto sides_of = [&](const Triangle& t) {
        const auto p = surface.positions();
        return longest_side(p[t[0]], p[t[1]], p[t[2]]);
    };
    double points = 0;
    for (const Triangle& t : surface.triangles()) {
        if (const double side = sides_of(t); side > 1) points += 0.5 * side * side;
    }
    const double density = points > most_points ? std::sqrt(most_points / points) : 1;
    std::vector<SurfaceSample> samples;
    for (std::uint32_t t = 0; t < surface.triangles().size(); ++t) {
        const auto [a, b, c] = surface.triangles()[t];
        const Vec3 pa = surface.positions()[a], pb = surface.positions()[b], pc = surface.positions()[c];
        const double parts = std::max(1.0, std::ceil(sides_of(surface.triangles()[t]) * density));
        for (double i = 0; i < parts; ++i) {
            for (double j = 0; i + j < parts; ++j) {
                const auto wb = static_cast<float>((i + 1.0 / 3) / parts),
                           wc = static_cast<float>((j + 1.0 / 3) / parts);
                const Vec3 position = pa * (1 - wb - wc) + pb * wb + pc * wc;
                if (claim(position)) samples.push_back({position, t});
            }
        }
    }
    return samples;
}

ThinParts find_thin_parts(const SolidSurface& surface, std::span<const SurfaceSample> samples, WorkerTeam& team) {
    std::vector<float> thickness(samples.size());
    constexpr std::size_t chunk = 256;
    std::atomic<std::size_t> next{0};
    team.run([&](unsigned) {
        for (std::size_t begin; (begin = next.fetch_add(chunk)) < samples.size();) {
            for (std::size_t i = begin; i < std::min(begin + chunk, samples.size()); ++i) {
                // Which side the solid is on is not known: the mesh may be turned inside out.
                const Vec3 normal = unit_normal_of(surface, samples[i].triangle);
                thickness[i] = std::min(thickness_along(surface, samples[i], normal, -normal),
                                        thickness_along(surface, samples[i], normal, normal));
            }
        }
    });
    ThinParts found{.samples = static_cast<std::uint32_t>(samples.size())};
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (thickness[i] == not_thin) continue;
        if (found.thin == 0 || thickness[i] < found.least_thickness) {
            found.least_thickness = thickness[i], found.place = samples[i].position;
        }
        ++found.thin;
    }
    return found;
}

}  // namespace weft
