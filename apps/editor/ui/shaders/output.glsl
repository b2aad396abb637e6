// Colors for the target.

layout(constant_id = 0) const uint decode = 0u;  // 1: the target encodes sRGB by itself

vec3 srgb_decoded(vec3 c) { return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045))); }

vec4 for_target(vec4 color) { return decode != 0u ? vec4(srgb_decoded(color.rgb), color.a) : color; }
