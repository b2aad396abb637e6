// Share of sunlight that reaches a point, 0…1. The penumbra widens with the distance of the blockers (PCSS, Fernando
// 2005).
layout(set = 0, binding = 0) uniform sampler2DShadow shadow_map;
layout(set = 0, binding = 1) uniform sampler2D shadow_depths;

const int blocker_taps = 12, shadow_taps = 24;
const float golden_angle = 2.39996323;

vec2 disc(int i, int count, float turn) {
    float radius = sqrt((float(i) + 0.5) / float(count)), angle = float(i) * golden_angle + turn;
    return radius * vec2(cos(angle), sin(angle));
}

float sun_reaching(vec3 position, vec3 normal, vec2 pixel) {
    vec4 scale = shadow.scale;
    vec3 sun = frame.sun.xyz;
    float facing = dot(normal, sun);
    // Normal offset against self-shadowing. It is larger at grazing light, where one texel covers a range of depths.
    vec3 side = facing < 0.0 ? -normal : normal;
    float grazing = sqrt(max(0.0, 1.0 - facing * facing));
    vec3 lifted = position + side * (scale.x * (0.7 + 1.3 * grazing));
    vec3 p = (shadow.to_shadow * vec4(lifted, 1.0)).xyz;
    bool outside = any(lessThan(p.xy, vec2(0.0))) || any(greaterThan(p.xy, vec2(1.0)));
    float beyond = max(0.0, p.z - 1.0) * scale.y;  // m: distance behind the range of the shadow map
    p = clamp(p, vec3(0.0), vec3(1.0));

    float across = 1.0 / (scale.x * scale.z);
    float turn = pixel_noise(pixel, whole(frame.light).w) * 2.0 * pi;
    float least = 2.2 * scale.x, most = max(least, (0.25 * scale.y + beyond) * whole(frame.sun).w);
    most = min(most, 60.0 * scale.x);
    float depth_per_meter = 1.0 / scale.y;
    float margin = 1.0 * scale.x * depth_per_meter;

    if (draft) {
        float lit = textureLod(shadow_map, vec3(p.xy, p.z - 1.5 * margin), 0.0);
        return outside ? 1.0 : lit;
    }

    float blockers = 0.0, depths = 0.0;
    for (int i = 0; i < blocker_taps; ++i) {
        vec2 offset = disc(i, blocker_taps, turn) * most;
        float depth = textureLod(shadow_depths, p.xy + offset * across, 0.0).r;
        // Only blockers within the cone of light count, so the required depth grows with the distance of the tap.
        if (depth < p.z - margin - length(offset) * depth_per_meter * 0.6) {
            blockers += 1.0;
            depths += depth;
        }
    }
    float radius = least;
    if (blockers > 0.0) radius = clamp(((p.z - depths / blockers) * scale.y + beyond) * whole(frame.sun).w, least, most);
    float reached = 0.0;
    for (int i = 0; i < shadow_taps; ++i) {
        vec2 offset = disc(i, shadow_taps, turn) * radius;
        float bias = margin + min(length(offset) * grazing / max(abs(facing), 0.25), 8.0 * scale.x) * depth_per_meter;
        reached += textureLod(shadow_map, vec3(p.xy + offset * across, p.z - bias), 0.0);
    }
    return outside ? 1.0 : reached / float(shadow_taps);
}
