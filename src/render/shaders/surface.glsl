// The light that a point of a surface sends to the eye.
#include "render/shaders/shadows.glsl"
layout(set = 0, binding = 2) uniform sampler2D occlusion_map;    // ambient visibility, and the depth
layout(set = 0, binding = 3) uniform sampler2D environment_map;  // prefiltered; roughness grows with the level
layout(set = 0, binding = 4) uniform sampler2D background_map;
layout(set = 1, binding = 0) uniform sampler2D color_map;
layout(set = 1, binding = 1) uniform sampler2D relief_map;
layout(set = 1, binding = 2) uniform sampler2D relief_squares;

struct Place {
    vec3 position, normal;  // turned to the eye
    vec3 u, v;              // along warp and weft
    vec3 to_eye;
    vec2 pixel;
    float cavity;
    bool back;
    Fiber fiber;
};

vec4 albedos(float cosine) {
    if (draft) return material.table[table_size / 2u];
    float at = clamp(cosine, 0.0, 1.0) * float(table_size) - 0.5;
    int below = int(clamp(floor(at), 0.0, float(table_size) - 2.0));
    return mix(material.table[below], material.table[below + 1], clamp(at - float(below), 0.0, 1.0));
}

// Coverage of the threads. It is larger at grazing view directions.
float coverage_at(float cosine) { return 1.0 - pow(1.0 - whole(material.velvet).z, 1.0 / max(cosine, 0.15)); }

// Samples the occlusion at half resolution, from pixels of similar depth.
float occlusion_at(vec2 pixel, vec3 position) {
    if (draft) return 1.0;
    float depth = dot(position - frame.eye.xyz, -vec3(whole(frame.to_view[0]).z, whole(frame.to_view[1]).z, whole(frame.to_view[2]).z));
    vec2 at = pixel * 0.5 - 0.5;
    ivec2 corner = ivec2(floor(at)), most = textureSize(occlusion_map, 0) - 1;
    vec2 part = at - vec2(corner);
    float sum = 0.0, weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 tap = ivec2(i & 1, i >> 1);
        vec2 found = texelFetch(occlusion_map, clamp(corner + tap, ivec2(0), most), 0).rg;
        vec2 share = mix(1.0 - part, part, vec2(tap));
        float weight = (share.x * share.y + 1e-3) / (1e-3 + abs(found.g - depth) / depth);
        sum += weight * found.r;
        weights += weight;
    }
    return whole(frame.light).y > 0.0 ? mix(1.0, sum / weights, whole(frame.light).y) : 1.0;
}

// Screen-space derivatives, taken before any branch: after one, software drivers leave the values of pixels outside of
// the triangle undefined, and derivatives along its edges are wrong.
struct Derivatives {
    vec3 position_x, position_y, rest_x, rest_y;
    vec2 uv_x, uv_y;
};

vec2 along_axis(vec3 v, vec3 facing) {
    return facing.y >= facing.x && facing.y >= facing.z ? v.xz : facing.x >= facing.z ? v.zy : v.xy;
}

// The thread directions: from the tangents, or from derivatives of UVs or rest positions.
void find_threads(vec3 smooth_normal, vec4 tangent, inout vec2 uv, vec3 rest, inout Derivatives d, out vec3 u, out vec3 v) {
    float sign_v = tangent.w < 0.0 ? -1.0 : 1.0;
    vec3 along = tangent.xyz;
    if ((object.flags & object_has_tangents) == 0u) {
        if ((object.flags & object_has_uvs) == 0u) {  // projected along the dominant axis
            vec3 facing = abs(cross(d.rest_x, d.rest_y));
            uv = along_axis(rest, facing);
            d.uv_x = along_axis(d.rest_x, facing);
            d.uv_y = along_axis(d.rest_y, facing);
        }
        vec3 px = d.position_x, py = d.position_y;
        vec2 ux = d.uv_x, uy = d.uv_y;
        float area = ux.x * uy.y - uy.x * ux.y;
        along = (px * uy.y - py * ux.y) * sign(area);
        vec3 other = (py * ux.x - px * uy.x) * sign(area);
        sign_v = dot(cross(smooth_normal, along), other) < 0.0 ? -1.0 : 1.0;
    }
    along -= smooth_normal * dot(smooth_normal, along);
    float size = dot(along, along);
    if (!(size > 1e-20)) {
        along = abs(smooth_normal.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0);
        along -= smooth_normal * dot(smooth_normal, along);
    }
    u = normalize(along);
    v = sign_v * cross(smooth_normal, u);
}

Place find_place(vec3 normal, vec4 tangent, vec2 uv, vec3 rest, bool front, vec2 pixel) {
    Derivatives d = Derivatives(dFdx(position), dFdy(position), dFdx(rest), dFdy(rest), dFdx(uv), dFdy(uv));
    Place place;
    place.position = position;
    place.pixel = pixel;
    place.back = !front;
    place.to_eye = normalize(frame.eye.xyz - position);
    float size = dot(normal, normal);
    vec3 outward = size > 1e-12 ? normal * inversesqrt(size) : normalize(cross(d.position_x, d.position_y));
    find_threads(outward, tangent, uv, rest, d, place.u, place.v);

    vec2 per_uv = (whole(material.tile).z > 0.5 ? vec2(1.0) : object.scale.xy) * material.tile.xy;
    vec2 tiles = uv * per_uv;
    float relief = whole(material.roughness).z;
    vec2 texels = per_uv * vec2(textureSize(relief_map, 0)), across = d.uv_x * texels, down = d.uv_y * texels;
    float level = 0.5 * log2(max(dot(across, across), dot(down, down)) + 1e-12);
    vec4 first;
    vec3 squares;
    if (draft) {  // as from afar
        int last = textureQueryLevels(relief_map) - 1;
        first = texelFetch(relief_map, ivec2(0), last);
        squares = texelFetch(relief_squares, ivec2(0), last).xyz;
    } else {
        first = textureLod(relief_map, tiles, level);
        squares = textureLod(relief_squares, tiles, level).xyz;
    }
    squares *= relief * relief;
    vec2 slope = first.xy * relief;
    // The far side of a thread is not visible, so normals that face away from the eye are turned back.
    place.normal = normalize(outward - slope.x * place.u - slope.y * place.v);
    if (!front) place.normal = -place.normal;
    float toward = dot(place.normal, place.to_eye);
    if (toward < 0.02) place.normal = normalize(place.normal + (0.02 - toward) * place.to_eye);
    place.u = normalize(place.u - place.normal * dot(place.normal, place.u));
    place.v = cross(place.normal, place.u) * (dot(cross(place.normal, place.u), place.v) < 0.0 ? -1.0 : 1.0);
    place.cavity = mix(1.0, first.z, min(relief, 1.0));

    float warp = whole(material.velvet).w > 0.5 && !front ? 1.0 - first.w : first.w;
    vec3 color = mix(material.weft_color.rgb, material.color.rgb, warp);
    vec2 to_map = vec2(1.0, -1.0) * material.map.xy;  // v points up, rows of an image down
    if (draft) {
        for (int i = 0; i < rounds(whole(material.map).z > 0.5); ++i) {
            vec2 side = to_map * vec2(textureSize(color_map, 0)), x = d.uv_x * side, y = d.uv_y * side;
            color *= textureLod(color_map, uv * to_map, 0.5 * log2(max(dot(x, x), dot(y, y)) + 1e-12)).rgb;
        }
    } else if (whole(material.map).z > 0.5) {
        color *= textureGrad(color_map, uv * to_map, d.uv_x * to_map, d.uv_y * to_map).rgb;
    }
    vec2 lost = max(squares.xy - slope * slope, vec2(0.0));  // variance lost by filtering, adds roughness (LEAN)
    vec2 alpha = material.roughness.xy;
    Fiber fiber;
    fiber.color = color;
    fiber.sheen_color = material.sheen.rgb;
    fiber.sheen_alpha = whole(material.sheen).w;
    fiber.diffuse_roughness = whole(material.color).w;
    fiber.specular = whole(material.weft_color).w;
    fiber.alpha_warp = min(sqrt(alpha * alpha + 2.0 * lost), vec2(1.0));
    fiber.alpha_weft = min(sqrt(alpha.yx * alpha.yx + 2.0 * lost), vec2(1.0));
    fiber.warp = warp;
    fiber.velvet = whole(material.velvet).x;
    fiber.velvet_alpha = whole(material.velvet).y;
    place.fiber = fiber;
    return place;
}

vec3 mirrored_around(vec3 direction, float alpha) {
    if (draft) return around_at(direction);
    float level = sqrt(clamp(alpha, 0.0, 1.0)) * whole(frame.environment).w;
    return textureLod(environment_map, environment_place(direction), level).rgb;
}

vec3 sunlight(Place place, vec4 to_viewer) {
    vec3 sun = frame.sun.xyz, light = vec3(0.0);
    float nl = dot(place.normal, sun), through = whole(material.roughness).w;
    if (whole(frame.sun_color).w > 0.5 && (nl > 0.0 || through > 0.0)) {
        Fiber fiber = place.fiber;
        vec3 l = vec3(dot(sun, place.u), dot(sun, place.v), nl);
        vec3 v = vec3(dot(place.to_eye, place.u), dot(place.to_eye, place.v), dot(place.to_eye, place.normal));
        Lobes lobes;
        if (draft) {
            Fiber plain = fiber;
            plain.sheen_color = vec3(0.0);
            plain.velvet = 0.0;
            lobes = layered(plain, lobes_before_layering(plain, l, v), to_viewer.xy, albedos(nl).xy);
            bool fuzzy = whole(material.velvet).x > 0.0 || any(greaterThan(material.sheen.rgb, vec3(0.0)));
            for (int i = 0; i < rounds(fuzzy); ++i)
                lobes = layered(fiber, lobes_before_layering(fiber, l, v), to_viewer.xy, albedos(nl).xy);
        } else {
            lobes = layered(fiber, lobes_before_layering(fiber, l, v), to_viewer.xy, albedos(nl).xy);
        }
        // Threads shadow the gaps between them: deep places get less light.
        vec3 back = lobes.matte * fiber.color * (1.0 - through) * place.cavity + lobes.sheen + vec3(lobes.gloss * place.cavity);
        vec3 sent = nl > 0.0 ? back * nl : fiber.color * (through * -nl / pi);
        light = sun_reaching(place.position, place.normal, place.pixel) * frame.sun_color.rgb * sent;
    }
    return light;
}

vec3 light_around(Place place, vec4 to_viewer, float occlusion) {
    Fiber fiber = place.fiber;
    float open = occlusion * place.cavity, through = whole(material.roughness).w;
    // Light reflected between folds keeps bright cloth from turning gray there (Jimenez and others 2016).
    vec3 a = 2.0404 * fiber.color - 0.3324, b = -4.7951 * fiber.color + 0.6417, c = 2.7552 * fiber.color + 0.6903;
    vec3 bright = max(vec3(open), ((open * a + b) * open + c) * open);
    bool velvet = fiber.velvet > 0.0;
    vec3 hairs = velvet_mirrored(fiber);
    vec3 matte = fiber.color * to_viewer.w * (velvet ? vec3(1.0) - hairs : vec3(1.0)) *
                 (around_at(place.normal) * (1.0 - through) * bright + around_at(-place.normal) * through * occlusion);
    vec3 mirrored = reflect(-place.to_eye, place.normal);
    vec3 wide = normalize(mirrored + place.normal);
    vec3 sheen = (velvet ? hairs * to_viewer.x + to_viewer.y : fiber.sheen_color * to_viewer.y) * mirrored_around(wide, 1.0);
    // Anisotropic lobes: bends the reflection across the smooth direction, as Filament does.
    vec2 alpha = mix(fiber.alpha_weft, fiber.alpha_warp, fiber.warp);
    float stretched = (alpha.y - alpha.x) / max(alpha.x + alpha.y, 1e-3);
    vec3 axis = stretched >= 0.0 ? place.v : place.u;
    vec3 bent = cross(cross(axis, place.to_eye), axis);
    vec3 around = reflect(-place.to_eye, normalize(mix(place.normal, bent, 0.5 * abs(stretched))));
    vec3 gloss_from = mirrored_around(around, sqrt(alpha.x * alpha.y));
    float gloss_open = clamp(pow(dot(place.normal, place.to_eye) + open, exp2(-16.0 * alpha.x - 1.0)) - 1.0 + open, 0.0, 1.0);
    return matte + sheen * open + gloss_from * to_viewer.z * gloss_open;
}

vec3 light_of(Place place) {
    vec4 to_viewer = albedos(dot(place.normal, place.to_eye));
    float occlusion = occlusion_at(place.pixel, place.position);
    return (sunlight(place, to_viewer) + light_around(place, to_viewer, occlusion)) * whole(frame.light).x;
}
