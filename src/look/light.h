// What lights a scene: the sun, the sky around, or a picture of surroundings.
#pragma once

#include "base/parameter.h"

#include <weft/vector.h>

#include <string>

namespace weft {

/// A far light with an edge to its shadows. Strength is in units of the picture: a white, matte surface that faces a
/// sun of strength 1 is as bright as white paper, 1, before `exposure`.
struct Sun {
    float azimuth = -40;             ///< degrees from +z toward +x: where the light comes from
    float elevation = 48;            ///< degrees above the horizon
    float strength = 1.0f;           ///< 0: there is none
    Vec3 color{1.0f, 0.96f, 0.90f};  ///< linear RGB
    float size = 3;                  ///< degrees across; larger ones have softer shadows (the real one: 0.53)
    friend bool operator==(const Sun&, const Sun&) = default;
};

/// Light from all around: three colors that flow into one another.
struct Sky {
    float strength = 0.52f;
    Vec3 zenith{0.80f, 0.88f, 1.0f};  ///< linear RGB, straight above
    Vec3 horizon{1.0f, 0.98f, 0.95f};
    Vec3 ground{0.62f, 0.60f, 0.58f};  ///< what comes from below
    friend bool operator==(const Sky&, const Sky&) = default;
};

/// A picture of what is around, in place of the sky: equirectangular, its middle column toward -z.
struct Environment {
    std::string file = {};  ///< .hdr; empty: none
    float rotation = 0;     ///< degrees about +y
    float strength = 1;
    bool visible = true;  ///< as the background; otherwise the sky's colors are behind the scene
    friend bool operator==(const Environment&, const Environment&) = default;
};

struct Lighting {
    Sun sun;
    Sky sky;
    Environment environment;
    float exposure = 0;   ///< stops: 1 doubles all light
    float occlusion = 1;  ///< how dark folds and corners are in the light from around; 0: not at all
    friend bool operator==(const Lighting&, const Lighting&) = default;
};

// One entry is one key.
// clang-format off
inline constexpr Parameter sun_parameters[] = {
    {.key = "azimuth", .offset = offsetof(Sun, azimuth), .min = -360, .max = 360, .unit = "°",
     .what = "where it comes from: from +z toward +x"},
    {.key = "elevation", .offset = offsetof(Sun, elevation), .min = -90, .max = 90, .unit = "°",
     .what = "how high it stands above the horizon"},
    {.key = "strength", .offset = offsetof(Sun, strength), .min = 0, .max = 1000,
     .what = "1 makes a white, matte surface that faces it as bright as white paper; 0: no sun"},
    {.key = "color", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(Sun, color), .min = 0, .max = 1,
     .what = "linear RGB"},
    {.key = "size", .offset = offsetof(Sun, size), .min = 0, .max = 30, .unit = "°",
     .what = "its width; larger ones have softer shadows, the real one has 0.53"},
};

inline constexpr Parameter sky_parameters[] = {
    {.key = "strength", .offset = offsetof(Sky, strength), .min = 0, .max = 1000,
     .what = "of all three colors; 1 with white in all of them makes white, matte surfaces as bright as white paper"},
    {.key = "zenith", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(Sky, zenith), .min = 0, .max = 1,
     .what = "linear RGB, from straight above"},
    {.key = "horizon", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(Sky, horizon), .min = 0, .max = 1,
     .what = "linear RGB, from all sides; the background of a picture"},
    {.key = "ground", .kind = ParameterKind::vector, .count = 3, .offset = offsetof(Sky, ground), .min = 0, .max = 1,
     .what = "linear RGB, from below"},
};

inline constexpr Parameter environment_parameters[] = {
    {.key = "file", .kind = ParameterKind::text, .offset = offsetof(Environment, file),
     .what = "name of an equirectangular picture, .hdr, in place of the sky; its middle is toward -z"},
    {.key = "rotation", .offset = offsetof(Environment, rotation), .min = -360, .max = 360, .unit = "°",
     .what = "turns it about +y"},
    {.key = "strength", .offset = offsetof(Environment, strength), .min = 0, .max = 1000,
     .what = "of its light; 1 as in the file"},
    {.key = "visible", .kind = ParameterKind::flag, .offset = offsetof(Environment, visible),
     .what = "whether it is the background too"},
};

inline constexpr Parameter lighting_parameters[] = {
    {.key = "sun", .kind = ParameterKind::object, .what = "a far light that casts shadows"},
    {.key = "sky", .kind = ParameterKind::object, .what = "light from all around"},
    {.key = "environment", .kind = ParameterKind::object, .what = "a picture of the surroundings in place of the sky"},
    {.key = "exposure", .offset = offsetof(Lighting, exposure), .min = -20, .max = 20, .unit = "stops",
     .what = "1 doubles all light"},
    {.key = "occlusion", .offset = offsetof(Lighting, occlusion), .min = 0, .max = 1,
     .what = "how much darker folds and corners are in the light from around"},
};
// clang-format on

/// Unit vector toward the sun.
Vec3 direction_of(const Sun& sun);

}  // namespace weft
