// Tone mapping and sRGB encoding.
#ifndef WEFT_SHADING_TONE_H
#define WEFT_SHADING_TONE_H

#include "render/shading/glsl.h"

WEFT_SHADING_BEGIN

/// Khronos PBR Neutral tone mapper (2024): keeps colors of surfaces, and compresses only values brighter than white
/// paper, which it also desaturates toward white.
WEFT_SHADE vec3 tone_map(vec3 color) {
    const float begin = 0.8f - 0.04f, desaturation = 0.15f;
    float least = min(color.x, min(color.y, color.z));
    color -= vec3(least < 0.08f ? least - 6.25f * least * least : 0.04f);
    float peak = max(color.x, max(color.y, color.z));
    const float room = 1.0f - begin;
    float pressed = 1.0f - room * room / (max(peak, begin) + room - begin);
    float gray = 1.0f - 1.0f / (desaturation * (max(peak, begin) - pressed) + 1.0f);
    vec3 bright = mix(color * (pressed / max(peak, begin)), vec3(pressed), gray);
    return peak < begin ? color : bright;
}

/// IEC 61966-2-1.
WEFT_SHADE float srgb_encoded(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * pow(linear, 1.0f / 2.4f) - 0.055f;
}
WEFT_SHADE float srgb_decoded(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : pow((encoded + 0.055f) / 1.055f, 2.4f);
}
WEFT_SHADE vec3 srgb_encoded(vec3 linear) {
    return vec3(srgb_encoded(linear.x), srgb_encoded(linear.y), srgb_encoded(linear.z));
}
WEFT_SHADE vec3 srgb_decoded(vec3 encoded) {
    return vec3(srgb_decoded(encoded.x), srgb_decoded(encoded.y), srgb_decoded(encoded.z));
}

WEFT_SHADING_END

#endif
