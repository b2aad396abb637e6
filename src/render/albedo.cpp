#include "render/albedo.h"

#include "render/sampling.h"

#include <algorithm>
#include <cmath>

namespace weft::render {
namespace {

using namespace shading;

constexpr std::uint32_t sphere_rings = 48, sphere_slices = 24;  // grid of light directions
constexpr std::uint32_t facets = 128;                           // samples per gloss lobe and viewer (`turns` viewers)
constexpr std::uint32_t turns = 4;

vec3 direction(float cosine, float angle) {
    const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
    return {sine * std::cos(angle), sine * std::sin(angle), cosine};
}

vec2 at_cosine(const AlbedoTable& table, float cosine) {
    const float at = std::clamp(cosine, 0.0f, 1.0f) * static_cast<float>(table_size) - 0.5f;
    const auto below = static_cast<std::size_t>(std::clamp(std::floor(at), 0.0f, static_cast<float>(table_size) - 2));
    return vec2(mix(table[below], table[below + 1], std::clamp(at - static_cast<float>(below), 0.0f, 1.0f)));
}

/// Calls `add(l, share)` for directions on a grid over the hemisphere. `share`: cosine times solid angle of each.
template <class Add>
void for_sphere(Add&& add) {
    for (std::uint32_t ring = 0; ring < sphere_rings; ++ring) {
        const float angle = pi / 2 * middle(ring, sphere_rings);
        const float share = std::sin(angle) * std::cos(angle) * (pi / 2 / sphere_rings) * (2 * pi / sphere_slices);
        for (std::uint32_t slice = 0; slice < sphere_slices; ++slice)
            add(direction(std::cos(angle), 2 * pi * middle(slice, sphere_slices)), share);
    }
}

/// Importance sampling of GGX facets, because a grid of directions misses narrow highlights.
template <class Add>
void for_facets(vec3 v, vec2 alpha, Add&& add) {
    for (std::uint32_t i = 0; i < facets; ++i) {
        const float part = middle(i, facets), angle = 2 * pi * radical_inverse(i);
        const float slope = std::sqrt(part / (1 - part));
        const vec3 h = normalize(vec3(alpha.x * slope * std::cos(angle), alpha.y * slope * std::sin(angle), 1.0f));
        const vec3 l = 2 * dot(v, h) * h - v;
        if (l.z <= 0 || dot(v, h) <= 0) continue;
        const vec3 d(h.x / alpha.x, h.y / alpha.y, h.z);
        const float d2 = dot(d, d), density = h.z / (pi * alpha.x * alpha.y * d2 * d2) / (4 * dot(v, h));
        add(l, l.z / density / static_cast<float>(facets));
    }
}

struct Both {
    float unlayered = 0, layered = 0;
};

/// Albedo of gloss, alone and below sheen.
Both gloss_to(const Fiber& fiber, float cosine, const AlbedoTable& table) {
    Both sum;
    const vec2 to_viewer = at_cosine(table, cosine);
    const auto add_of = [&](const Fiber& one, vec3 v, float weight) {
        return [&, v, weight](vec3 l, float share) {
            const Lobes lobes = lobes_before_layering(one, l, v);
            sum.unlayered += weight * share * lobes.gloss;
            sum.layered += weight * share * shading::layered(fiber, lobes, to_viewer, at_cosine(table, l.z)).gloss;
        };
    };
    for (std::uint32_t turn = 0; turn < turns; ++turn) {
        const vec3 v = direction(cosine, pi * middle(turn, turns));
        for (const bool warp : {true, false}) {
            Fiber one = fiber;
            one.warp = warp ? 1.0f : 0.0f;
            const float share = warp ? fiber.warp : 1 - fiber.warp;
            for_facets(v, warp ? fiber.alpha_warp : fiber.alpha_weft, add_of(one, v, share / turns));
        }
    }
    return sum;
}

}  // namespace

Fiber fiber_of(const Material& material, float warp) {
    const auto color = [](Vec3 c) { return vec3(c.x, c.y, c.z); };
    const float along = material.roughness[0] * material.roughness[0],
                across = material.roughness[1] * material.roughness[1];
    return {.color = mix(color(material.weft_color), color(material.color), warp),
            .sheen_color = color(material.sheen_color),
            .sheen_alpha = material.sheen_roughness * material.sheen_roughness,
            .diffuse_roughness = material.diffuse_roughness,
            .specular = material.specular,
            .alpha_warp = {along, across},
            .alpha_weft = {across, along},
            .warp = warp,
            .velvet = material.velvet,
            .velvet_alpha = material.velvet_alpha};
}

namespace {

AlbedoTable velvet_table(const Fiber& fiber) {
    AlbedoTable table{};
    Fiber none = fiber, all = fiber;  // of F0
    none.specular = 0;
    all.specular = 1;
    all.sheen_color = vec3(1);
    for (std::uint32_t i = 0; i < table_size; ++i) {
        const vec3 v = direction(middle(i, table_size), 0);
        for_sphere([&](vec3 l, float share) {
            const Lobes without = lobes_before_layering(none, l, v);
            table[i].x += share * (lobes_before_layering(all, l, v).sheen.x - without.sheen.x);
            table[i].y += share * without.sheen.x;
            table[i].w += share * without.matte.x;
        });
    }
    return table;
}

}  // namespace

AlbedoTable albedo_table(const Fiber& fiber) {
    if (fiber.velvet > 0) return velvet_table(fiber);
    AlbedoTable table{};
    Fiber unit = fiber;
    unit.sheen_color = vec3(1);
    for (std::uint32_t i = 0; i < table_size; ++i) {
        const float cosine = middle(i, table_size);
        const vec3 v = direction(cosine, 0);
        table[i].x = std::min(1.0f, gloss_to(fiber, cosine, {}).unlayered);
        for_sphere([&](vec3 l, float share) { table[i].y += share * lobes_before_layering(unit, l, v).sheen.x; });
        table[i].y = std::min(1.0f, table[i].y);
    }
    for (std::uint32_t i = 0; i < table_size; ++i) {
        const float cosine = middle(i, table_size);
        const vec3 v = direction(cosine, 0);
        table[i].z = gloss_to(fiber, cosine, table).layered;
        for_sphere([&](vec3 l, float share) {
            const vec2 to_light = at_cosine(table, l.z);
            table[i].w += share * layered(fiber, lobes_before_layering(fiber, l, v), vec2(table[i]), to_light).matte.x;
        });
    }
    return table;
}

}  // namespace weft::render
