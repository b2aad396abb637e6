#version 460
#include "render/shaders/common.glsl"

layout(location = 0) out vec4 color;
layout(location = 1) noperspective out vec2 place;  // pixels from the middle
layout(location = 2) out float radius;

void main() {
    PointRef points = PointRef(push.items);
    PointData one = points.at[gl_VertexIndex / 6];
    const vec2 corners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1));
    radius = 0.5 * one.position.w;
    place = corners[gl_VertexIndex % 6] * (radius + 1.0);
    color = one.color;
    gl_Position = frame.to_clip * vec4(one.position.xyz, 1.0);
    gl_Position.xy += place * 2.0 * frame.size.zw * gl_Position.w;
}
