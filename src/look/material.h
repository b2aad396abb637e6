// The material of a surface: how it reflects and transmits light, and its weave. The presets are in materials/, one
// file each.
#pragma once

#include "base/parameter.h"

#include <weft/vector.h>

#include <span>
#include <string>
#include <string_view>

namespace weft {

/// The pattern of the threads, or another kind of roughness: a tile of look/weave.h.
enum class Weave { smooth, plain, twill, satin, knit, rib, grain };

/// Colors are linear RGB, 0…1. Warp runs along u, weft along v.
struct Material {
    Vec3 color{0.8f, 0.8f, 0.8f};       ///< diffuse reflectance of the warp, or of the whole surface
    Vec3 weft_color{0.8f, 0.8f, 0.8f};  ///< of the weft; equals `color` where only `color` is given
    float diffuse_roughness = 0;        ///< 0…1, sigma of Oren and Nayar
    float specular = 0.04f;             ///< reflectance of a smooth fiber at normal incidence (F0); 0.04 for index 1.5
    /// 0…1, of the highlight, along the threads and across them. GGX with alpha = roughness².
    float roughness[2] = {0.6f, 0.6f};
    Vec3 sheen_color{0, 0, 0};     ///< of the fuzz: Charlie sheen, as in KHR_materials_sheen
    float sheen_roughness = 0.5f;  ///< 0…1, alpha = sheen_roughness²
    float velvet = 0;  ///< k_amp of the velvet distribution, whose F0 is specular · sheen_color; 0: not velvet
    float velvet_alpha = 0.35f;  ///< width of the velvet distribution
    float transmission = 0;      ///< fraction of the diffuse light that passes to the other side
    float coverage = 1;  ///< fraction of the area that threads cover, seen straight on; below 1 the cloth is sheer
    Weave weave = Weave::smooth;
    float thread_spacing = 0.4f;  ///< mm between neighboring threads; for `grain`: size of a grain
    float weave_depth = 1;        ///< height of the threads relative to the weave's own; 0: flat
    std::string color_map = {};   ///< file of an image that multiplies the color
    std::string normal_map = {};  ///< file of a tangent-space normal map (+y along v) that replaces the weave
    float uv_tiling[2] = {1, 1};  ///< repeats of the maps per unit of u and v
    friend bool operator==(const Material&, const Material&) = default;
};

// One entry per scene key.
// clang-format off
inline constexpr Parameter material_parameters[] = {
    {.key = "color", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(Material, color), .min = 0, .max = 1,
     .above_hint = color_hint,
     .what = "linear RGB, diffuse reflectance of the warp; also of the weft if `weft_color` is not given"},
    {.key = "weft_color", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(Material, weft_color), .min = 0,
     .max = 1,
     .above_hint = color_hint, .what = "linear RGB, diffuse reflectance of the weft"},
    {.key = "diffuse_roughness", .offset = offsetof(Material, diffuse_roughness), .min = 0, .max = 1,
     .what = "diffuse roughness (Oren-Nayar); 0: Lambert; a rough surface looks flatter"},
    {.key = "specular", .offset = offsetof(Material, specular), .min = 0, .max = 1,
     .what = "specular reflectance at normal incidence (F0); 0.04 for fibers of index 1.5"},
    {.key = "roughness", .count = 2, .offset = offsetof(Material, roughness), .min = 0.02, .max = 1,
     .what = "roughness of the highlight, along the threads and across them"},
    {.key = "sheen_color", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(Material, sheen_color),
     .min = 0, .max = 1,
     .above_hint = color_hint, .what = "linear RGB of the fuzz (sheen); black: none"},
    {.key = "sheen_roughness", .offset = offsetof(Material, sheen_roughness), .min = 0.05, .max = 1,
     .what = "roughness of the sheen; larger values reach farther from the silhouette"},
    {.key = "velvet", .offset = offsetof(Material, velvet), .min = 0, .max = 100,
     .what = "amount of pile (k_amp); above 0 the material is velvet: its hairs reflect `specular` times "
             "`sheen_color`, and there is no other sheen or highlight"},
    {.key = "velvet_alpha", .offset = offsetof(Material, velvet_alpha), .min = 0.05, .max = 1,
     .what = "spread of the pile's directions"},
    {.key = "transmission", .offset = offsetof(Material, transmission), .min = 0, .max = 1,
     .what = "fraction of the diffuse light that passes to the other side"},
    {.key = "coverage", .offset = offsetof(Material, coverage), .min = 0.05, .max = 1,
     .what = "fraction of the area that threads cover; below 1 the cloth is sheer"},
    {.key = "weave", .kind = ParameterKind::choice, .offset = offsetof(Material, weave),
     .what = "pattern of the threads; `smooth`: none; `grain`: leather",
     .choices = "smooth|plain|twill|satin|knit|rib|grain",
     .choice_words = "no threads|over one, under one: cotton, linen|diagonal ribs: denim|"
                     "long floating threads: shine|loops: jersey|loops in ribs: cuffs|leather"},
    {.key = "thread_spacing", .offset = offsetof(Material, thread_spacing), .min = 0.01, .max = 1000, .unit = "mm",
     .what = "distance between threads; for `grain`, the size of a grain"},
    {.key = "weave_depth", .offset = offsetof(Material, weave_depth), .min = 0, .max = 4,
     .what = "height of the threads relative to the weave's own"},
    {.key = "color_map", .kind = ParameterKind::text, .offset = offsetof(Material, color_map),
     .what = "image (.png, .jpg) that multiplies the color; needs UVs"},
    {.key = "normal_map", .kind = ParameterKind::text, .offset = offsetof(Material, normal_map),
     .what = "normal map (.png, .jpg; tangent space, green along v) in place of the weave; needs UVs"},
    {.key = "uv_tiling", .count = 2, .offset = offsetof(Material, uv_tiling), .min = 0.001, .max = 10000,
     .what = "repetitions of the maps per unit of u and of v"},
};
// clang-format on

struct MaterialPreset {
    std::string_view name;
    std::string_view what;  ///< one line: the fabric and what its appearance comes from
    Material material;
};

/// All presets, in the order of material.cpp.
std::span<const MaterialPreset> material_presets();
/// nullptr if no preset has that name.
const MaterialPreset* find_material(std::string_view name);

}  // namespace weft
