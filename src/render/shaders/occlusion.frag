#version 460
// Ambient occlusion from horizons in the depth image along a few directions (Bavoil and others 2008; weighted by the
// cosine as in Jimenez and others 2016). At half the resolution; also writes the depth.
#include "render/shaders/common.glsl"

layout(location = 0) in vec2 place;
layout(location = 0) out vec2 left;
layout(set = 0, binding = 0) uniform sampler2D depths;

const int directions = 3, steps = 5;

// Exponent that darkens the result. It compensates for occluders beyond the radius and folds behind folds, which the
// depth image does not show.
const float contrast = 1.8;

vec3 view_position(ivec2 pixel) {
    float depth = texelFetch(depths, pixel, 0).r;
    vec4 p = frame.from_clip * vec4((vec2(pixel) + 0.5) * frame.size.zw * 2.0 - 1.0, depth, 1.0);
    return (frame.to_view * vec4(p.xyz / p.w, 1.0)).xyz;
}

// Difference to the neighbor with the nearer depth, so that normals at an edge do not mix both sides.
vec3 slope(ivec2 pixel, ivec2 step, vec3 here) {
    ivec2 most = textureSize(depths, 0) - 1;
    vec3 after = view_position(min(pixel + step, most)) - here, before = here - view_position(max(pixel - step, ivec2(0)));
    return abs(after.z) < abs(before.z) ? after : before;
}

void main() {
    ivec2 pixel = min(ivec2(gl_FragCoord.xy) * 2, textureSize(depths, 0) - 1);
    bool nothing = texelFetch(depths, pixel, 0).r >= 1.0;
    vec3 here = view_position(pixel);
    vec3 normal = normalize(cross(slope(pixel, ivec2(0, 1), here), slope(pixel, ivec2(1, 0), here)));
    vec3 to_eye = normalize(-here);
    if (dot(normal, to_eye) < 0.0) normal = -normal;
    float radius = whole(frame.light).z;
    // The radius in pixels at this depth.
    float scale = radius / -here.z * 0.5 * whole(frame.size).y * length(vec3(whole(frame.to_clip[0]).y, whole(frame.to_clip[1]).y, whole(frame.to_clip[2]).y));
    scale = min(scale, 0.35 * whole(frame.size).y);
    float noise = pixel_noise(gl_FragCoord.xy, whole(frame.light).w);
    float jitter = pixel_noise(gl_FragCoord.yx + 17.0, whole(frame.light).w);
    float hidden = 0.0;
    for (int i = 0; i < directions; ++i) {
        float angle = (float(i) + noise) * pi / float(directions);
        vec2 along = vec2(cos(angle), sin(angle));
        for (int side = -1; side <= 1; side += 2) {
            float highest = 0.0;
            for (int j = 0; j < steps; ++j) {
                float part = (float(j) + jitter) / float(steps);
                ivec2 tap = pixel + ivec2(round(along * float(side) * max(part * part * scale, float(j) + 1.0)));
                if (any(lessThan(tap, ivec2(0))) || any(greaterThanEqual(tap, ivec2(frame.size.xy)))) continue;
                vec3 d = view_position(tap) - here;
                float distance2 = dot(d, d);
                float above = dot(d, normal) * inversesqrt(max(distance2, 1e-12)) - 0.04;
                float near2 = distance2 / (radius * radius), fading = clamp(1.0 - near2 * near2, 0.0, 1.0);
                highest = max(highest, above * fading);
            }
            hidden += highest * highest;  // share of the cosine-weighted half circle below the horizon
        }
    }
    left = nothing ? vec2(1.0, 1e4) : vec2(pow(clamp(1.0 - hidden / float(2 * directions), 0.0, 1.0), contrast), -here.z);
}
