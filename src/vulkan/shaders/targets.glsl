// Points whose positions are given: by keys, by a collider, or by a body, which constraints pull at them (body.md).
#ifndef WEFT_TARGETS_GLSL
#define WEFT_TARGETS_GLSL

#include "vulkan/shaders/collider_lists.glsl"
#include "vulkan/shaders/sums_of_bodies.glsl"

#define WEFT_BODIES_OF_TARGETS target_args.at.colliders.at.bodies

vec3 place_of_target(TargetIn target, uint which)
{
    PoseIn pose;
    if (target.body != WEFT_FOLLOWS_NO_BODY) {
        pose = pose_of_body(WEFT_BODIES_OF_TARGETS, target.body, which);
    } else {
        uint after = target_args.at.substep + substeps_before + 1u;
        pose = target_args.at.poses.at[after * target_args.at.frame.at.motions + target.motion];
    }
    return rotate(pose.x.xyz, pose.y.xyz, pose.z.xyz, target.local.xyz) + pose.position.xyz;
}

// The inverse mass that the point has while constraints act.
float weight_of_target(TargetIn target, vec3 place)
{
    BodiesRef bodies = WEFT_BODIES_OF_TARGETS;
    MovedBody moved = moved_body(bodies, target.body);
    moved.contacts = feels_cloth(bodies, target.body) ? float(bodies.at.bodies.at[target.body].attached) : 0.0;
    return most_weight_of(moved, place - moved.center);
}

// What the air gives to the particle in the substep.
vec3 impulse_of_air(uint p)
{
    vec3 sum = vec3(0.0);
    uint end = target_args.at.offsets.at[p + 1u];
    for (uint k = target_args.at.offsets.at[p]; k < end; ++k)
        sum = sum + target_args.at.by_face.at[target_args.at.items.at[k]].xyz;
    return sum;
}

void run_targets(uint i)
{
    TargetIn target = target_args.at.targets.at[i];
    uint pass = target_args.at.pass;
    bool on_body = target.body != WEFT_FOLLOWS_NO_BODY;
    if (!on_body && pass != WEFT_TARGETS_ALL) return;
    vec4 point = load_point(target_args.at.position, target.particle);
    bool places = pass == WEFT_TARGETS_ALL || pass == WEFT_TARGETS_ON_BODIES;
    vec3 place = place_of_target(target, places ? WEFT_BODY_NOW : WEFT_BODY_PLACED);
    if (pass == WEFT_TARGETS_WEIGH || pass == WEFT_TARGETS_WEIGH_FOR_LEVELS) {
        float weight = weight_of_target(target, place);
        point.w = pass == WEFT_TARGETS_WEIGH ? weight : -weight;
    } else if (pass == WEFT_TARGETS_PULL) {
        vec3 by = point.xyz - place;
        if (point.w > 0.0 && dot(by, by) > 0.0) add_to_body(WEFT_BODIES_OF_TARGETS, target.body, -by, place, point.w);
        bool blown = !is_none(uvec2(target_args.at.by_face)) && target.particle < target_args.at.particles;
        if (blown && feels_cloth(WEFT_BODIES_OF_TARGETS, target.body))
            add_impulse_to_body(WEFT_BODIES_OF_TARGETS, target.body, impulse_of_air(target.particle), place);
        point = vec4(place, 0.0);
    } else {
        point = vec4(place, point.w);
    }
    store_point(target_args.at.position, target.particle, point);
}

#endif
