#version 460
// A square of the ground plane around the camera's target, up to where the ground has faded. The object's transform
// holds two directions along the plane, its normal, and a point of it.
#include "render/shaders/common.glsl"

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec4 tangent;
layout(location = 3) out vec2 uv;
layout(location = 4) out vec3 rest;
layout(location = 5) out float scalar;

void main() {
    const vec2 corners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1));
    vec2 corner = corners[gl_VertexIndex] * whole(frame.background).w;
    position = object.transform[3].xyz + object.transform[0].xyz * corner.x + object.transform[1].xyz * corner.y;
    normal = object.transform[2].xyz;
    tangent = vec4(object.transform[0].xyz, 1.0);
    rest = position;
    uv = vec2(dot(position, object.transform[0].xyz), dot(position, object.transform[1].xyz));
    scalar = 0.0;
    gl_Position = frame.to_clip * vec4(position, 1.0);
}
