#version 460
// Places the shadow map around all shadow casters, seen from the sun. Its size changes in steps and its middle moves by
// whole texels, so that shadows of moving objects do not flicker.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#define WEFT_OWN_PUSH
#include "render/shading/frame.data.h"

layout(local_size_x = 1) in;
layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer Bounds { uint at[]; };
layout(buffer_reference, std430, buffer_reference_align = 16) writeonly buffer Light { LightData data; };
layout(push_constant, std430) uniform Push {
    FrameRef frame;
    Bounds bounds;
    Light light;
    float texels;
} push;

float unordered(uint bits) { return uintBitsToFloat((bits & 0x80000000u) != 0u ? bits & 0x7fffffffu : ~bits); }

void main() {
    vec3 least = vec3(-0.5), most = vec3(0.5);
    if (push.bounds.at[0] <= push.bounds.at[3]) {
        for (int axis = 0; axis < 3; ++axis) {
            least[axis] = unordered(push.bounds.at[axis]);
            most[axis] = unordered(push.bounds.at[3 + axis]);
        }
    }
    vec3 z = push.frame.data.sun.xyz;
    vec3 x = normalize(abs(z.y) < 0.99 ? cross(vec3(0, 1, 0), z) : cross(vec3(0, 0, 1), z));
    vec3 y = cross(z, x);
    vec3 middle = 0.5 * (least + most), half_size = max(0.5 * (most - least), vec3(1e-3));
    vec3 extent = vec3(dot(abs(x), half_size), dot(abs(y), half_size), dot(abs(z), half_size));
    float across = 2.0 * max(extent.x, extent.y) * 1.02;
    across = exp2(ceil(log2(across) * 4.0) / 4.0);
    float texel = across / push.texels;
    vec2 at = round(vec2(dot(middle, x), dot(middle, y)) / texel) * texel;
    float from = dot(middle, z) + extent.z + 4.0 * texel, range = 2.0 * extent.z + 8.0 * texel;
    // Receivers may be far behind the casters. A depth beyond the map is clamped to its end.
    mat4 to = mat4(1.0);
    to[0] = vec4(x.x / across, y.x / across, -z.x / range, 0.0);
    to[1] = vec4(x.y / across, y.y / across, -z.y / range, 0.0);
    to[2] = vec4(x.z / across, y.z / across, -z.z / range, 0.0);
    to[3] = vec4(0.5 - at / across, from / range, 1.0);
    push.light.data.to_shadow = to;
    push.light.data.scale = vec4(texel, range, push.texels, 0.0);
}
