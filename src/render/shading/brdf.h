// The BRDF of cloth, shared by the GPU and by the CPU, which integrates it. Directions are unit vectors away from the
// surface; n is turned toward the viewer. The "albedo" of a lobe is the share of light from everywhere that it sends to
// the viewer.
#ifndef WEFT_SHADING_BRDF_H
#define WEFT_SHADING_BRDF_H

#include "render/shading/glsl.h"

WEFT_SHADING_BEGIN

const float pi = 3.14159265f;

// Number of entries for the angle between normal and viewer.
const uint table_size = 32u;

/// Material of the threads at one point.
struct Fiber {
    vec3 color;
    vec3 sheen_color;
    float sheen_alpha;
    float diffuse_roughness;
    float specular;
    vec2 alpha_warp;  ///< highlight of threads along u: squared roughness along u and along v
    vec2 alpha_weft;  ///< likewise for threads along v
    float warp;       ///< share of threads along u
    float velvet;
    float velvet_alpha;
};

/// Reflection of light from a direction, in the surface frame: x along u, y along v, z along the normal.
struct Lobes {
    vec3 matte;  ///< per unit of color
    vec3 sheen;  ///< with its color
    float gloss;
};

WEFT_SHADE float power5(float x) {
    float x2 = x * x;
    return x2 * x2 * x;
}

/// Schlick 1994.
WEFT_SHADE float fresnel(float f0, float cosine) {
    return f0 + (1.0f - f0) * power5(clamp(1.0f - cosine, 0.0f, 1.0f));
}

// --- Velvet: The Order: 1886 (Neubelt and Pettineo 2013) after Ashikhmin and Premoze 2007. No geometry term; the
// smooth denominator stays finite at the rim.

/// D(m), a Gaussian in the cotangent plus a constant: upright fibers, and some with random directions.
WEFT_SHADE float velvet_distribution(float nm, float amplitude, float alpha) {
    float cos2 = nm * nm, sin2 = max(1.0f - cos2, 1e-4f), alpha2 = alpha * alpha;
    float standing = exp(-cos2 / (alpha2 * sin2)) / (sin2 * sin2);
    return (1.0f + amplitude * standing) / (pi * (1.0f + amplitude * alpha2));
}

WEFT_SHADE float smooth_denominator(float nl, float nv) {
    return 4.0f * (nl + nv - nl * nv);
}

/// F0 of the hairs, which may be colored.
WEFT_SHADE vec3 velvet_mirrored(Fiber fiber) {
    return fiber.specular * fiber.sheen_color;
}
WEFT_SHADE vec3 velvet_fresnel(vec3 f0, float cosine) {
    return f0 + (vec3(1.0f) - f0) * power5(clamp(1.0f - cosine, 0.0f, 1.0f));
}

// --- Sheen: "Charlie" (Estevez and Kulla 2017), as in KHR_materials_sheen.

WEFT_SHADE float charlie_distribution(float nh, float alpha) {
    float power = 1.0f / alpha;
    float sin2 = max(1.0f - nh * nh, 1e-4f);
    return (2.0f + power) * pow(sin2, 0.5f * power) / (2.0f * pi);
}

WEFT_SHADE float charlie_curve(float x, float alpha) {
    float t = (1.0f - alpha) * (1.0f - alpha);
    float a = mix(21.5473f, 25.3245f, t), b = mix(3.82987f, 3.32435f, t), c = mix(0.19823f, 0.16801f, t),
          d = mix(-1.97760f, -1.27393f, t), e = mix(-4.32054f, -4.85967f, t);
    return a / (1.0f + b * pow(x, c)) + d * x + e;
}

WEFT_SHADE float charlie_lambda(float cosine, float alpha) {
    return cosine < 0.5f ? exp(charlie_curve(cosine, alpha))
                         : exp(2.0f * charlie_curve(0.5f, alpha) - charlie_curve(1.0f - cosine, alpha));
}

WEFT_SHADE float charlie_visibility(float nl, float nv, float alpha) {
    float lambda = 1.0f + charlie_lambda(nv, alpha) + charlie_lambda(nl, alpha);
    return 1.0f / max(lambda * 4.0f * nl * nv, 1e-4f);
}

// --- Highlights: anisotropic GGX with its height-correlated masking (Heitz 2014).

WEFT_SHADE float ggx(vec3 l, vec3 v, vec3 h, vec2 alpha) {
    vec3 d = vec3(h.x / alpha.x, h.y / alpha.y, h.z);
    float d2 = dot(d, d);
    float distribution = 1.0f / (pi * alpha.x * alpha.y * d2 * d2);
    float masked =
        l.z * length(vec3(alpha.x * v.x, alpha.y * v.y, v.z)) + v.z * length(vec3(alpha.x * l.x, alpha.y * l.y, l.z));
    return distribution * 0.5f / max(masked, 1e-5f);
}

// --- Matte: Oren and Nayar 1994 as simplified by Fujii, without its dark ring. 1/pi if sigma is 0.

WEFT_SHADE float rough_matte(float nl, float nv, float lv, float sigma) {
    float a = 1.0f / (pi + (pi / 2.0f - 2.0f / 3.0f) * sigma);
    float s = lv - nl * nv;
    float t = s > 0.0f ? max(nl, nv) : 1.0f;
    return a * (1.0f + sigma * s / t);
}

/// The lobes, each as if it were the only one.
WEFT_SHADE Lobes lobes_before_layering(Fiber fiber, vec3 l, vec3 v) {
    Lobes lobes;
    float nl = clamp(l.z, 1e-3f, 1.0f), nv = clamp(v.z, 1e-3f, 1.0f);
    vec3 h = normalize(l + v);
    float nh = clamp(h.z, 0.0f, 1.0f), lh = clamp(dot(l, h), 0.0f, 1.0f);
    if (fiber.velvet > 0.0f) {
        vec3 mirrored = velvet_fresnel(velvet_mirrored(fiber), lh);
        float standing = velvet_distribution(nh, fiber.velvet, fiber.velvet_alpha) / smooth_denominator(nl, nv);
        lobes.gloss = 0.0f;
        lobes.sheen = mirrored * standing;
        lobes.matte = (vec3(1.0f) - mirrored) / pi;
        return lobes;
    }
    float mirrored = fresnel(fiber.specular, lh);
    vec3 from = vec3(l.x, l.y, nl), to = vec3(v.x, v.y, nv);
    lobes.gloss = mirrored * (fiber.warp * ggx(from, to, h, fiber.alpha_warp) +
                              (1.0f - fiber.warp) * ggx(from, to, h, fiber.alpha_weft));
    lobes.matte = vec3(rough_matte(nl, nv, dot(l, v), fiber.diffuse_roughness));
    lobes.sheen = fiber.sheen_color *
                  (charlie_distribution(nh, fiber.sheen_alpha) * charlie_visibility(nl, nv, fiber.sheen_alpha));
    return lobes;
}

/// Scales the lobes below each layer. A layer passes 1 - albedo, with the larger of its albedos toward viewer and
/// light, so that energy is conserved and the BRDF is reciprocal. `to_viewer`, `to_light`: albedos of gloss and of
/// sheen of color 1, in these directions.
WEFT_SHADE Lobes layered(Fiber fiber, Lobes lobes, vec2 to_viewer, vec2 to_light) {
    if (fiber.velvet > 0.0f) return lobes;
    float most = max(fiber.sheen_color.x, max(fiber.sheen_color.y, fiber.sheen_color.z));
    float below_sheen = max(0.0f, 1.0f - most * max(to_viewer.y, to_light.y));
    float below_gloss = max(0.0f, 1.0f - max(to_viewer.x, to_light.x));
    lobes.gloss *= below_sheen;
    lobes.matte *= below_sheen * below_gloss;
    return lobes;
}

WEFT_SHADING_END

#endif
