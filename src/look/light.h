// The lights of a scene: the sun, the sky, or an environment map.
#pragma once

#include "base/parameter.h"

#include <weft/vector.h>

#include <string>

namespace weft {

/// A distant light with soft shadow edges. An intensity of 1 makes a white, matte surface that faces the sun as bright
/// as white paper: pixel value 1 before `exposure`.
struct Sun {
    float azimuth = -40;             ///< degrees from +z toward +x: where the light comes from
    float elevation = 48;            ///< degrees above the horizon
    float intensity = 1.0f;          ///< 0: no sun
    Vec3 color{1.0f, 0.96f, 0.90f};  ///< linear RGB
    float angular_diameter = 3;      ///< degrees; larger values give softer shadows (the real sun: 0.53)
    friend bool operator==(const Sun&, const Sun&) = default;
};

/// Light from all directions: three colors with smooth transitions.
struct Sky {
    float intensity = 0.52f;
    Vec3 zenith{0.80f, 0.88f, 1.0f};  ///< linear RGB, straight above
    Vec3 horizon{1.0f, 0.98f, 0.95f};
    Vec3 ground{0.62f, 0.60f, 0.58f};  ///< light from below
    friend bool operator==(const Sky&, const Sky&) = default;
};

/// An equirectangular image of the surroundings, used in place of the sky. Its middle column is toward -z.
struct Environment {
    std::string file = {};  ///< .hdr; empty: none
    float rotation = 0;     ///< degrees about +y
    float intensity = 1;
    bool visible = true;  ///< shown as the background; if false, the background has the sky's colors
    friend bool operator==(const Environment&, const Environment&) = default;
};

struct Lighting {
    Sun sun;
    Sky sky;
    Environment environment;
    float exposure = 0;           ///< stops: 1 doubles all light
    float ambient_occlusion = 1;  ///< darkening of folds and corners in the light of sky and environment; 0: none
    friend bool operator==(const Lighting&, const Lighting&) = default;
};

// One entry per scene key.
// clang-format off
inline constexpr Parameter sun_parameters[] = {
    {.key = "azimuth", .offset = offsetof(Sun, azimuth), .min = -360, .max = 360, .unit = "°",
     .what = "direction that the light comes from, turned from +z toward +x"},
    {.key = "elevation", .offset = offsetof(Sun, elevation), .min = -90, .max = 90, .unit = "°",
     .what = "height above the horizon"},
    {.key = "intensity", .offset = offsetof(Sun, intensity), .min = 0, .max = 1000,
     .what = "brightness; 1 shows a white, matte surface that faces the sun as white; 0: no sun"},
    {.key = "color", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(Sun, color), .min = 0, .max = 1,
     .above_hint = color_hint, .what = "linear RGB"},
    {.key = "angular_diameter", .offset = offsetof(Sun, angular_diameter), .min = 0, .max = 30, .unit = "°",
     .what = "apparent diameter; a larger one gives softer shadows; the real sun has 0.53"},
};

inline constexpr Parameter sky_parameters[] = {
    {.key = "intensity", .offset = offsetof(Sky, intensity), .min = 0, .max = 1000,
     .what = "brightness of all three colors; 1, with white in all of them, shows white, matte surfaces as white"},
    {.key = "zenith", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(Sky, zenith), .min = 0, .max = 1,
     .above_hint = color_hint, .what = "linear RGB of the light from straight above"},
    {.key = "horizon", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(Sky, horizon), .min = 0, .max = 1,
     .above_hint = color_hint, .what = "linear RGB of the light from the horizon; also the background of images"},
    {.key = "ground", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(Sky, ground), .min = 0, .max = 1,
     .above_hint = color_hint, .what = "linear RGB of the light from below"},
};

inline constexpr Parameter environment_parameters[] = {
    {.key = "file", .kind = ParameterKind::text, .offset = offsetof(Environment, file),
     .what = "equirectangular image (.hdr) in place of the sky; its center is toward -z"},
    {.key = "rotation", .offset = offsetof(Environment, rotation), .min = -360, .max = 360, .unit = "°",
     .what = "rotation about +y"},
    {.key = "intensity", .offset = offsetof(Environment, intensity), .min = 0, .max = 1000,
     .what = "brightness; 1 as in the file"},
    {.key = "visible", .kind = ParameterKind::flag, .offset = offsetof(Environment, visible),
     .what = "also show it as the background"},
};

inline constexpr Parameter lighting_parameters[] = {
    {.key = "sun", .kind = ParameterKind::object, .what = "a distant light that casts shadows"},
    {.key = "sky", .kind = ParameterKind::object, .what = "light from all directions"},
    {.key = "environment", .kind = ParameterKind::object, .what = "an image of the surroundings in place of the sky"},
    {.key = "exposure", .offset = offsetof(Lighting, exposure), .min = -20, .max = 20, .unit = "stops",
     .what = "exposure; 1 more doubles the brightness"},
    {.key = "ambient_occlusion", .offset = offsetof(Lighting, ambient_occlusion), .min = 0, .max = 1,
     .what = "darkening of folds and corners in the light of sky and environment; 0: none"},
};
// clang-format on

/// Unit vector toward the sun.
Vec3 direction_of(const Sun& sun);

}  // namespace weft
