// Color scales. Shared by C++ and GLSL, so that the legend matches what the shader draws.
#ifndef WEFT_COLOR_SCALE_H
#define WEFT_COLOR_SCALE_H

#define WEFT_SCALE_BALANCE 0  // compressed … at rest … stretched: blue, light gray, red
#define WEFT_SCALE_AMOUNT 1   // none … much: dark violet, green, yellow

#include "render/shading/glsl.h"

WEFT_SHADING_BEGIN

// The cool-warm map of Moreland, "Diverging Color Maps for Scientific Visualization" (2009): even steps in Msh, the
// same lightness on both sides. Approximated within 0.03 by cubics in the distance from the middle. `s` in -1…1.
WEFT_SHADE vec3 color_of_balance(float s) {
    vec3 middle = vec3(0.8654f, 0.8654f, 0.8654f);
    float d = s < 0.0f ? -s : s;
    vec3 cold = vec3(-0.4968f, -0.0290f, 0.6426f) +
                d * (vec3(-0.3660f, -0.7628f, -0.7872f) + d * vec3(0.2292f, 0.2243f, 0.0316f));
    vec3 warm = vec3(0.5811f, -0.3634f, -0.7073f) +
                d * (vec3(-0.8441f, -0.0952f, -0.2266f) + d * vec3(0.1033f, -0.3805f, 0.2179f));
    return middle + d * (s < 0.0f ? cold : warm);
}

// Viridis by Smith and van der Walt (CC0): lightness rises evenly with the value. Approximated within 0.016 by a
// polynomial. `t` in 0…1.
WEFT_SHADE vec3 color_of_amount(float t) {
    vec3 high = vec3(5.1906f, 11.6437f, 58.6809f) +
                t * (vec3(4.9187f, -11.4636f, -68.1625f) + t * vec3(-5.2909f, 3.8791f, 27.5786f));
    vec3 low = vec3(-0.9185f, -0.0386f, -0.0030f) + t * (vec3(-3.4088f, -4.5383f, -19.7036f) + t * high);
    return vec3(0.2667f, 0.0039f, 0.3294f) + t * (vec3(0.2342f, 1.4198f, 1.4252f) + t * low);
}

// Color in sRGB, 0…1. `t`: 0 at the lower end of the scale, 1 at the upper end; clamped.
WEFT_SHADE vec3 color_scale(float t, int kind) {
    t = t < 1.0f ? (t > 0.0f ? t : 0.0f) : 1.0f;
    vec3 color = kind == WEFT_SCALE_AMOUNT ? color_of_amount(t) : color_of_balance(t * 2.0f - 1.0f);
    return clamp(color, vec3(0.0f), vec3(1.0f));
}

WEFT_SHADING_END

#endif
