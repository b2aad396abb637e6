#version 460
// A line as a strip of its width in pixels, plus half a pixel on each side for a soft edge.
#include "render/shaders/common.glsl"

layout(location = 0) out vec4 color;
layout(location = 1) noperspective out float across;  // pixels from the middle
layout(location = 2) out float half_width;

void main() {
    LineRef lines = LineRef(push.items);
    LineData line = lines.at[gl_VertexIndex / 6];
    const vec2 corners[6] = vec2[](vec2(0, -1), vec2(1, -1), vec2(1, 1), vec2(0, -1), vec2(1, 1), vec2(0, 1));
    vec2 corner = corners[gl_VertexIndex % 6];
    vec4 a = frame.to_clip * vec4(line.from.xyz, 1.0), b = frame.to_clip * vec4(line.to.xyz, 1.0);
    // Clip at the near plane.
    float near = whole(frame.eye).w;
    if (a.w < near && b.w < near) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
        return;
    }
    if (a.w < near) a = mix(a, b, (near - a.w) / (b.w - a.w));
    if (b.w < near) b = mix(b, a, (near - b.w) / (a.w - b.w));
    vec2 along = (b.xy / b.w - a.xy / a.w) * frame.size.xy;
    float size = length(along);
    along = size > 1e-6 ? along / size : vec2(1.0, 0.0);
    half_width = 0.5 * line.from.w;
    across = corner.y * (half_width + 0.5);
    color = line.color;
    vec4 p = corner.x < 0.5 ? a : b;
    vec2 offset = vec2(-along.y, along.x) * across + along * (corner.x - 0.5);
    p.xy += offset * 2.0 * frame.size.zw * p.w;
    p.z -= push.numbers.x * p.w;  // slightly in front of the surface that it lies on
    gl_Position = p;
}
