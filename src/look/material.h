// What a surface looks like: how it reflects and lets through light, and how its threads lie. Presets stand in
// materials/, one file each.
#pragma once

#include "base/parameter.h"

#include <weft/vector.h>

#include <span>
#include <string>
#include <string_view>

namespace weft {

/// How threads cross, or what else makes the surface rough: a tile of look/weave.h.
enum class Weave { smooth, plain, twill, satin, knit, rib, grain };

/// Colors are linear RGB, 0…1. Warp runs along u, weft along v.
struct Material {
    Vec3 color{0.8f, 0.8f, 0.8f};       ///< share of light that the warp, or all of it, scatters
    Vec3 weft_color{0.8f, 0.8f, 0.8f};  ///< and the weft; follows `color` where only that is given
    float roughness_matte = 0;          ///< 0…1, of the matte part: Oren and Nayar's sigma
    float specular = 0.04f;             ///< share that a smooth fiber mirrors straight on (F0); 0.04 for index 1.5
    /// 0…1, of the highlight, along the threads and across them. GGX with alpha = roughness².
    float roughness[2] = {0.6f, 0.6f};
    Vec3 sheen_color{0, 0, 0};     ///< of fuzz that stands off the surface: Charlie sheen, as in KHR_materials_sheen
    float sheen_roughness = 0.5f;  ///< 0…1, alpha = sheen_roughness²
    float velvet = 0;  ///< k_amp of the velvet distribution, whose F0 is specular · sheen_color; 0: it is none
    float velvet_alpha = 0.35f;  ///< its width
    float transmission = 0;      ///< share of the matte light that goes through instead of back
    float coverage = 1;  ///< share of its area that threads fill, seen straight on; less than 1 shows what is behind
    Weave weave = Weave::smooth;
    float thread = 0.4f;           ///< mm from a thread to the next; of `grain`: size of a grain
    float relief = 1;              ///< how high threads stand: 1 as the weave has it, 0 flat
    std::string color_map = {};    ///< file of a picture that multiplies the color
    std::string normal_map = {};   ///< file of a tangent-space normal map (+y along v) in place of the weave
    float map_repeat[2] = {1, 1};  ///< how often maps go into one unit of u and v
    friend bool operator==(const Material&, const Material&) = default;
};

// One entry is one key.
// clang-format off
inline constexpr Parameter material_parameters[] = {
    {.key = "color", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(Material, color), .min = 0, .max = 1,
     .what = "linear RGB: share of light that the warp scatters; where `weft_color` is not given, the weft too"},
    {.key = "weft_color", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(Material, weft_color), .min = 0,
     .max = 1, .what = "linear RGB, of the weft"},
    {.key = "roughness_matte", .offset = offsetof(Material, roughness_matte), .min = 0, .max = 1,
     .what = "0: Lambert; more keeps surfaces that face away from the light as bright as those that face it"},
    {.key = "specular", .offset = offsetof(Material, specular), .min = 0, .max = 1,
     .what = "share of light that is mirrored straight on (F0); 0.04 for fibers of index 1.5"},
    {.key = "roughness", .count = 2, .offset = offsetof(Material, roughness), .min = 0.02, .max = 1,
     .what = "of the highlight, along the threads and across them"},
    {.key = "sheen_color", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(Material, sheen_color),
     .min = 0, .max = 1, .what = "linear RGB, of the fuzz on it; black: none"},
    {.key = "sheen_roughness", .offset = offsetof(Material, sheen_roughness), .min = 0.05, .max = 1,
     .what = "how far from the rim its light reaches"},
    {.key = "velvet", .offset = offsetof(Material, velvet), .min = 0, .max = 100,
     .what = "strength of the pile (k_amp); more than 0 makes it velvet: hairs that mirror `specular` of `sheen_color`, "
             "without sheen and highlight of other kinds"},
    {.key = "velvet_alpha", .offset = offsetof(Material, velvet_alpha), .min = 0.05, .max = 1,
     .what = "how unruly the pile is"},
    {.key = "transmission", .offset = offsetof(Material, transmission), .min = 0, .max = 1,
     .what = "share of the scattered light that goes through to the other side"},
    {.key = "coverage", .offset = offsetof(Material, coverage), .min = 0.05, .max = 1,
     .what = "share of the area that threads fill, seen straight on; below 1 one sees through"},
    {.key = "weave", .kind = ParameterKind::choice, .offset = offsetof(Material, weave),
     .what = "how threads lie: in `smooth` none are seen; `grain` is that of leather",
     .choices = "smooth|plain|twill|satin|knit|rib|grain"},
    {.key = "thread", .offset = offsetof(Material, thread), .min = 0.01, .max = 1000, .unit = "mm",
     .what = "from a thread to the next; of `grain`, the size of a grain"},
    {.key = "relief", .offset = offsetof(Material, relief), .min = 0, .max = 4,
     .what = "how high threads stand; 1 as they are in the weave"},
    {.key = "color_map", .kind = ParameterKind::text, .offset = offsetof(Material, color_map),
     .what = "file of a picture (.png, .jpg) that the color is multiplied by; needs UVs"},
    {.key = "normal_map", .kind = ParameterKind::text, .offset = offsetof(Material, normal_map),
     .what = "file of a normal map (.png, .jpg; tangent space, green along v) in place of the weave; needs UVs"},
    {.key = "map_repeat", .count = 2, .offset = offsetof(Material, map_repeat), .min = 0.001, .max = 10000,
     .what = "how often the pictures go into a unit of u and of v"},
};
// clang-format on

struct MaterialPreset {
    std::string_view name;
    std::string_view what;  ///< one line: what it is, and what its look comes from
    Material material;
};

/// Every material known by name, in the order of material.cpp.
std::span<const MaterialPreset> material_presets();
/// nullptr if no preset has that name.
const MaterialPreset* find_material(std::string_view name);

}  // namespace weft
