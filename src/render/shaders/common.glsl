// Common start of all drawing shaders.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#include "render/shading/frame.data.h"
#include "render/shading/tone.h"

// Less work per pixel, for images that must be ready soon (RendererOptions::draft).
layout(constant_id = 2) const bool draft = false;

// Software drivers run both sides of a branch, but no loop without a round. So `for (int i = 0; i < rounds(b); ++i)` is a
// branch that costs nothing where it is not taken, if all pixels agree.
int rounds(bool taken) { return taken ? 1 : 0; }

// The color that is written for light. Drafts have no later pass that maps tones.
vec4 written(vec3 light, float alpha) { return vec4(draft ? tone_map(light) : light, alpha); }

// Reads a whole vector from a buffer. Works around Lavapipe (Mesa 22.3), which reads the first component if a shader
// reads only the last one.
vec4 whole(vec4 v) { return v; }

vec3 around_at(vec3 n) {  // irradiance / pi
    vec4 sh[9] = frame.around;
    vec3 light = sh[0].rgb + sh[1].rgb * n.y + sh[2].rgb * n.z + sh[3].rgb * n.x + sh[4].rgb * (n.x * n.y) +
                 sh[5].rgb * (n.y * n.z) + sh[6].rgb * (3.0 * n.z * n.z - 1.0) + sh[7].rgb * (n.x * n.z) +
                 sh[8].rgb * (n.x * n.x - n.y * n.y);
    return max(light, vec3(0.0));
}

// Interleaved gradient noise (Jimenez 2014): 0…1, evenly distributed over any 3 by 3 pixels. Differs between samples.
float pixel_noise(vec2 pixel, float number) {
    pixel += 5.588238 * number;
    return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
}

// Texture coordinates of a direction in an equirectangular image with the middle toward -z.
vec2 environment_place(vec3 d) {
    return vec2(atan(d.x, -d.z) / (2.0 * pi) + 0.5, acos(clamp(d.y, -1.0, 1.0)) / pi);
}
vec3 picture_direction(vec3 d) {  // in the rotated environment
    return vec3(whole(frame.environment).y * d.x - whole(frame.environment).z * d.z, d.y,
                whole(frame.environment).z * d.x + whole(frame.environment).y * d.z);
}

vec3 sky_at(vec3 d) {
    vec3 above = mix(frame.sky[1].rgb, frame.sky[0].rgb, sqrt(max(d.y, 0.0)));
    return mix(above, frame.sky[2].rgb, smoothstep(0.0, 0.35, -d.y));
}
