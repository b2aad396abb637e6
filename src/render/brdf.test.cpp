// Tests shading/brdf.h on the CPU against physical laws and against its sources.

#include "render/shading/brdf.h"
#include "render/albedo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>

namespace weft::render {
namespace {

using namespace shading;

vec3 random_direction(std::mt19937& random) {
    std::uniform_real_distribution<float> cosine(0.02f, 1), angle(0, 2 * pi);
    const float z = cosine(random), a = angle(random), s = std::sqrt(1 - z * z);
    return {s * std::cos(a), s * std::sin(a), z};
}

vec2 at_cosine(const AlbedoTable& table, float cosine) {
    const float at = clamp(cosine, 0.0f, 1.0f) * float(table_size) - 0.5f;
    const int below = int(clamp(std::floor(at), 0.0f, float(table_size) - 2));
    return vec2(mix(table[std::size_t(below)], table[std::size_t(below) + 1], clamp(at - float(below), 0.0f, 1.0f)));
}

/// Sum of all lobes.
vec3 reflected(const Fiber& fiber, const AlbedoTable& table, vec3 l, vec3 v) {
    const Lobes lobes =
        layered(fiber, lobes_before_layering(fiber, l, v), at_cosine(table, v.z), at_cosine(table, l.z));
    return lobes.matte * fiber.color + lobes.sheen + vec3(lobes.gloss);
}

/// Integral of f times the cosine over the hemisphere, with `rings` × 2 `rings` directions on a square grid of angles.
double integral(int rings, const std::function<double(vec3 l)>& f) {
    const double step = std::numbers::pi / 2 / rings, slice = std::numbers::pi / rings;
    double sum = 0;
    for (int i = 0; i < rings; ++i) {
        const double angle = (i + 0.5) * step, c = std::cos(angle), s = std::sin(angle);
        for (int j = 0; j < 2 * rings; ++j) {
            const double a = (j + 0.5) * slice;
            sum += f(vec3(s * std::cos(a), s * std::sin(a), c)) * c * s * step * slice;
        }
    }
    return sum;
}

/// Mean of f over viewers around the normal.
double mean_over_viewers(int viewers, float cosine, const std::function<double(vec3 v)>& f) {
    double sum = 0;
    const float s = std::sqrt(1 - cosine * cosine);
    for (int i = 0; i < viewers; ++i) {
        const float a = pi * (float(i) + 0.25f) / float(viewers);
        sum += f({s * std::cos(a), s * std::sin(a), cosine});
    }
    return sum / viewers;
}

TEST(Brdf, light_goes_both_ways_alike) {
    std::mt19937 random(1);
    for (const MaterialPreset& preset : material_presets()) {
        const Fiber fiber = fiber_of(preset.material, 0.6f);
        const AlbedoTable table = albedo_table(fiber);
        for (int i = 0; i < 500; ++i) {
            const vec3 a = random_direction(random), b = random_direction(random);
            const vec3 there = reflected(fiber, table, a, b), back = reflected(fiber, table, b, a);
            for (int c = 0; c < 3; ++c) {
                ASSERT_TRUE(std::isfinite(there[c]) && there[c] >= 0) << preset.name;
                ASSERT_NEAR(there[c], back[c], 1e-5f + 1e-4f * there[c]) << preset.name << " " << a.z << " " << b.z;
            }
        }
    }
}

// f = (1 - F) ρ/π + F D / (4 (n·l + n·v - (n·l)(n·v))), an independent implementation of the paper on The Order: 1886.
TEST(Brdf, velvet_is_that_of_its_source) {
    Material material{.color = {0.3f, 0.3f, 0.3f}, .specular = 0.05f, .sheen_color = {1, 0.5f, 0}};
    std::mt19937 random(2);
    for (const float k : {0.5f, 4.0f, 20.0f}) {
        for (const float a : {0.2f, 0.35f, 0.8f}) {
            material.velvet = k;
            material.velvet_alpha = a;
            const Fiber fiber = fiber_of(material, 1);
            for (int i = 0; i < 500; ++i) {
                const vec3 l = random_direction(random), v = random_direction(random), m = normalize(l + v);
                const double nl = l.z, nv = v.z, nm = m.z, a2 = double(a) * double(a);
                if (nm > 0.9999) continue;  // where the formula divides by zero
                const double lm = double(dot(l, m));
                const double sharp = std::exp(nm * nm / (a2 * (nm * nm - 1))) / ((1 - nm * nm) * (1 - nm * nm));
                const double d = (1 + double(k) * sharp) / (std::numbers::pi * (1 + double(k) * a2));
                const Lobes lobes = lobes_before_layering(fiber, l, v);
                for (const int c : {0, 1, 2}) {
                    const double f0 = 0.05 * (1 - 0.5 * c), fresnel = f0 + (1 - f0) * std::pow(1 - lm, 5);
                    const double expected =
                        (1 - fresnel) * 0.3 / std::numbers::pi + fresnel * d / (4 * (nl + nv - nl * nv));
                    ASSERT_NEAR(lobes.matte[c] * 0.3f + lobes.sheen[c] + lobes.gloss, expected, 1e-4 * expected)
                        << "k " << k << ", alpha " << a << ", n·m " << nm;
                }
            }
        }
    }
}

TEST(Brdf, without_roughness_the_matte_part_is_lamberts) {
    std::mt19937 random(3);
    for (int i = 0; i < 100; ++i) {
        const vec3 l = random_direction(random), v = random_direction(random);
        EXPECT_NEAR(rough_matte(l.z, v.z, dot(l, v), 0), 1 / pi, 1e-7f);
    }
}

TEST(Brdf, the_matte_part_never_sends_back_more_than_comes) {
    for (const float sigma : {0.0f, 0.3f, 0.6f, 1.0f})
        for (const float cosine : {0.02f, 0.2f, 0.5f, 0.8f, 1.0f}) {
            const vec3 v(std::sqrt(1 - cosine * cosine), 0, cosine);
            const double albedo = integral(64, [&](vec3 l) { return rough_matte(l.z, v.z, dot(l, v), sigma); });
            EXPECT_LE(albedo, 1.001) << sigma << " " << cosine;
            EXPECT_GE(albedo, 0.75) << sigma << " " << cosine;
        }
}

// D (n·m) over all facets is their area seen from above: 1.
TEST(Brdf, facets_of_highlights_cover_the_surface) {
    for (const vec2 alpha : {vec2(0.16f, 0.16f), vec2(0.1f, 0.4f), vec2(0.9f, 0.9f)}) {
        const double area = integral(512, [&](vec3 h) {
            // With both directions at the facet's normal, masking is known, and the rest is D.
            const float masking = 0.5f / (2 * h.z * length(vec3(alpha.x * h.x, alpha.y * h.y, h.z)));
            return double(ggx(h, h, h, alpha) / masking);
        });
        EXPECT_NEAR(area, 1, 0.01) << alpha.x << " " << alpha.y;
    }
}

// Charlie's distribution over all facets, likewise.
TEST(Brdf, fibers_of_sheen_cover_the_surface) {
    for (const float alpha : {0.1f, 0.3f, 0.6f, 1.0f})
        EXPECT_NEAR(integral(256, [&](vec3 h) { return double(charlie_distribution(h.z, alpha)); }), 1, 0.01) << alpha;
}

TEST(Brdf, tables_of_albedo_are_what_a_grid_of_directions_finds) {
    for (const MaterialPreset& preset : material_presets()) {
        if (preset.material.velvet > 0) continue;  // below
        const Fiber fiber = fiber_of(preset.material, 0.6f);
        const AlbedoTable table = albedo_table(fiber);
        Fiber unit = fiber;
        unit.sheen_color = vec3(1);
        for (const std::size_t i : {2u, 8u, 16u, 31u}) {
            const float cosine = (float(i) + 0.5f) / float(table_size);
            const double sheen = mean_over_viewers(1, cosine, [&](vec3 v) {
                return integral(96, [&](vec3 l) { return double(lobes_before_layering(unit, l, v).sheen.x); });
            });
            EXPECT_NEAR(table[i].y, std::min(1.0, sheen), 0.01 + 0.02 * sheen) << preset.name << " sheen " << cosine;
            if (preset.material.roughness[0] < 0.35f) continue;  // too narrow for the grid
            const double gloss = mean_over_viewers(4, cosine, [&](vec3 v) {
                return integral(96, [&](vec3 l) { return double(lobes_before_layering(fiber, l, v).gloss); });
            });
            EXPECT_NEAR(table[i].x, std::min(1.0, gloss), 0.005 + 0.03 * gloss) << preset.name << " gloss " << cosine;
        }
    }
}

TEST(Brdf, tables_of_velvet_give_its_albedo_for_every_color_of_hairs) {
    Material velvet = find_material("velvet")->material;
    ASSERT_GT(velvet.velvet, 0);
    for (const float f0 : {0.0f, 0.04f, 0.5f}) {
        velvet.specular = f0;
        velvet.sheen_color = {1, 1, 1};
        const Fiber fiber = fiber_of(velvet, 1);
        const AlbedoTable table = albedo_table(fiber);
        for (const std::size_t i : {2u, 8u, 16u, 31u}) {
            const float cosine = (float(i) + 0.5f) / float(table_size);
            const double hairs = mean_over_viewers(1, cosine, [&](vec3 v) {
                return integral(96, [&](vec3 l) { return double(lobes_before_layering(fiber, l, v).sheen.x); });
            });
            const double matte = mean_over_viewers(1, cosine, [&](vec3 v) {
                return integral(96, [&](vec3 l) { return double(lobes_before_layering(fiber, l, v).matte.x); });
            });
            EXPECT_NEAR(f0 * table[i].x + table[i].y, hairs, 0.005 + 0.02 * hairs) << f0 << " hairs " << cosine;
            EXPECT_NEAR((1 - f0) * table[i].w, matte, 0.005 + 0.02 * matte) << f0 << " matte " << cosine;
        }
    }
}

TEST(Brdf, tables_of_albedo_are_between_0_and_1_and_all_together_too) {
    for (const MaterialPreset& preset : material_presets()) {
        Material white = preset.material;
        white.color = white.weft_color = {1, 1, 1};
        const Fiber fiber = fiber_of(white, 0.5f);
        const AlbedoTable table = albedo_table(fiber);
        if (white.velvet > 0) {
            const float f0 = fiber.specular * max(fiber.sheen_color.x, max(fiber.sheen_color.y, fiber.sheen_color.z));
            for (const vec4& row : table)
                EXPECT_LE(f0 * row.x + row.y + (1 - f0) * row.w, 1.01f) << preset.name << ", white";
            continue;
        }
        const float sheen = max(fiber.sheen_color.x, max(fiber.sheen_color.y, fiber.sheen_color.z));
        for (std::size_t i = 0; i < table_size; ++i) {
            for (int c = 0; c < 4; ++c) {
                EXPECT_GE(table[i][c], 0) << preset.name << " " << i << " " << c;
                EXPECT_LE(table[i][c], 1) << preset.name << " " << i << " " << c;
            }
            EXPECT_LE(table[i].z, table[i].x + 1e-4f) << preset.name << ": below sheen there is no more gloss";
            EXPECT_LE(table[i].w + table[i].z + sheen * table[i].y, 1.01f) << preset.name << " " << i;
        }
    }
}

TEST(Brdf, mirrors_send_more_where_light_grazes) {
    const AlbedoTable table = albedo_table(fiber_of({.specular = 0.04f, .roughness = {0.4f, 0.4f}}, 1));
    for (std::size_t i = 4; i + 1 < table_size; ++i) EXPECT_GE(table[i].x, table[i + 1].x - 0.002f) << i;
    EXPECT_NEAR(table[table_size - 1].x, 0.04f, 0.006f) << "straight on, F0";
    const AlbedoTable none = albedo_table(fiber_of({.diffuse_roughness = 0, .specular = 0, .roughness = {1, 1}}, 1));
    EXPECT_NEAR(none[table_size - 1].w + none[table_size - 1].z, 1, 0.005f) << "white paper";
}

}  // namespace
}  // namespace weft::render
