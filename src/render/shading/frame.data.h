// Data of a frame in buffers, with the same layout (std140 and std430) in C++ and GLSL.
#ifndef WEFT_SHADING_FRAME_H
#define WEFT_SHADING_FRAME_H

#include "render/shading/brdf.h"

#ifdef __cplusplus
#include <cstdint>
namespace weft::shading {
using Vec4s = std::uint64_t;
using Vec2s = std::uint64_t;
using Floats = std::uint64_t;
using LightRef = std::uint64_t;
using FrameRef = std::uint64_t;
using ObjectRef = std::uint64_t;
using LineRef = std::uint64_t;
using PointRef = std::uint64_t;
using FlatRef = std::uint64_t;
#else
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer Vec4s { vec4 at[]; };
layout(buffer_reference, std430, buffer_reference_align = 8) readonly buffer Vec2s { vec2 at[]; };
layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer Floats { float at[]; };
#endif

/// Placement of the sun's shadow map, computed on the device from the objects' bounds.
struct LightData {
    mat4 to_shadow;  ///< from the world to the shadow map: 0…1 across, depth in z
    vec4 scale;      ///< m per texel; m of depth from 0 to 1; texels across; 0
};

struct MaterialData {
    vec4 color;       ///< w: diffuse_roughness
    vec4 weft_color;  ///< w: specular
    vec4 sheen;       ///< color and alpha
    vec4 roughness;   ///< along threads and across, relief, transmission
    vec4 velvet;      ///< k_amp, alpha, coverage, whether threads cross (the back then shows the other threads)
    vec4 tile;        ///< tiles per m along u and v, or per unit of u and v; z: 1 if per unit; 0
    vec4 map;         ///< repeats of the color map; z: 1 if there is one; w: whether light passes (sheer)
    vec4 table[table_size];  ///< albedos by the cosine to the viewer (albedo.h)
};

#ifndef __cplusplus
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer LightRef { LightData data; };
#endif

struct FrameData {
    mat4 to_clip;
    mat4 from_clip;
    mat4 to_view;
    vec4 eye;          ///< w: distance of the near plane
    vec4 target;       ///< w: distance to the eye
    vec4 sun;          ///< direction toward the sun; w: tangent of half its angular diameter
    vec4 sun_color;    ///< irradiance on a surface that faces the sun; w: 1 if there is a sun
    vec4 around[9];    ///< irradiance of the environment over pi, in spherical harmonics
    vec4 size;         ///< width and height in pixels, and 1 over these
    vec4 light;        ///< exposure, intensity of occlusion, its radius in m, number of the sample
    vec4 environment;  ///< intensity, cosine and sine of the rotation, highest level
    vec4 background;   ///< 1: transparent; 1: environment image; fading of grounds: begin and end, m from the target
    vec4 sky[3];       ///< background colors: zenith, horizon, ground
};

const uint object_has_uvs = 1u, object_has_tangents = 2u, object_has_rest = 4u, object_has_scalars = 8u,
           object_turned = 16u;

struct ObjectData {
    Vec4s positions, normals, tangents;
    Vec2s uvs;
    Floats rest, scalars;
    uint flags, scale_kind;
    Vec4s unused;  // vectors begin at multiples of 16 bytes
    vec4 transform[4];  ///< columns
    vec4 scale;         ///< m per unit of u and of v; minimum of the scalars, 1 over their range
};

struct LineData {
    vec4 from;  ///< w: width in pixels
    vec4 to;
    vec4 color;
};

struct PointData {
    vec4 position;  ///< w: size in pixels
    vec4 color;
};

struct FlatData {
    vec4 position;  ///< pixels
    vec4 color;
};

#ifdef __cplusplus
static_assert(sizeof(FrameData) == 4 * 16 * 3 + 16 * (4 + 9 + 4 + 3));
static_assert(sizeof(ObjectData) == 64 + 64 + 16);
static_assert(sizeof(MaterialData) == 16 * (7 + table_size));
}  // namespace weft::shading
#else
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer FrameRef { FrameData data; };
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer ObjectRef { ObjectData data; };
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer LineRef { LineData at[]; };
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer PointRef { PointData at[]; };
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer FlatRef { FlatData at[]; };

#ifndef WEFT_OWN_PUSH
layout(push_constant, std430) uniform Push {
    Vec4s items;  ///< address of lines, points or flat vertices
    vec4 numbers;
} push;
// Uniform buffers, because software drivers read other buffers once for each pixel, which took most of the time.
layout(set = 2, binding = 0, std140) uniform FrameBlock { FrameData frame; };
layout(set = 2, binding = 1, std140) uniform ObjectBlock { ObjectData object; };
layout(set = 2, binding = 2, std140) uniform MaterialBlock { MaterialData material; };
layout(set = 2, binding = 3, std140) uniform LightBlock { LightData shadow; };  ///< placement of the shadow map
#endif
#endif

#endif
