#version 450
// Passes over the listed pairs. Only the device knows their number, so each invocation takes several.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/particle_contact/spheres.glsl"

// A list that is too short makes the frame run again.
void check_room()
{
    head.outdated = 0u;
    head.wanted = max(head.wanted, head.listed);
    if (head.listed <= spheres.capacity) return;
    for (uint m = 0u; m < spheres.report_count; ++m)
        atomicOr(Uints(spheres.reports.at[m]).at[0], WEFT_REPORT_LIST_FULL);
}

void run_overlap(uint i)
{
    SpherePairIn pair = spheres.pairs.at[i];
    vec4 x0 = spheres.position.at[pair.one], x1 = spheres.position.at[pair.two];
    bool pushes = spheres_overlap(x0.xyz, x1.xyz, x0.w, x1.w, pair.diameter);
    spheres.pairs.at[i].depth = pushes ? 0.0 : -1.0;
    if (!pushes) return;
    atomicAdd(spheres.pushes.at[pair.one], 1u);
    atomicAdd(spheres.pushes.at[pair.two], 1u);
    atomicAdd(head.contacts, 1u);
}

float resistance_of(uint p, float w, float split) { return sphere_resistance(w, float(spheres.pushes.at[p]), split); }

void run_push(uint i)
{
    SpherePairIn pair = spheres.pairs.at[i];
    if (pair.depth < 0.0) return;
    vec4 x0 = spheres.position.at[pair.one], x1 = spheres.position.at[pair.two];
    vec4 start0 = spheres.start.at[pair.one], start1 = spheres.start.at[pair.two];
    vec4 friction0 = spheres.friction.at[pair.one / WEFT_PARTICLE_BLOCK];
    vec4 friction1 = spheres.friction.at[pair.two / WEFT_PARTICLE_BLOCK];
    float resistance =
        resistance_of(pair.one, x0.w, args.split) + resistance_of(pair.two, x1.w, args.split);
    SpherePush result = push_spheres(x0.xyz, x1.xyz, start0.xyz, start1.xyz, pair.diameter, pair.diameter * args.deep,
                                     args.recovery_speed * spheres.frame.at.h, resistance,
                                     friction0.x * friction1.x, friction0.y * friction1.y);
    if (!(result.depth > 0.0)) return;
    spheres.pairs.at[i].depth = pair.depth + result.depth;
    add_push(pair.one, result.push * x0.w);
    add_push(pair.two, result.push * -x1.w);
}

void run_hold(uint i)
{
    SpherePairIn pair = spheres.pairs.at[i];
    if (!(pair.depth > 0.0)) return;
    vec4 x0 = spheres.position.at[pair.one], x1 = spheres.position.at[pair.two];
    vec4 start0 = spheres.start.at[pair.one], start1 = spheres.start.at[pair.two];
    float resistance = resistance_of(pair.one, x0.w, 1.0) + resistance_of(pair.two, x1.w, 1.0);
    vec3 hold = hold_spheres(x0.xyz, x1.xyz, start0.xyz, start1.xyz, pair.depth, resistance);
    add_push(pair.one, hold * x0.w);
    add_push(pair.two, hold * -x1.w);
}

void main()
{
    uint count = min(head.listed, spheres.capacity);
    uint together = gl_NumWorkGroups.x * gl_NumWorkGroups.y * gl_WorkGroupSize.x;
#ifdef WEFT_CHECKS_ROOM
    if (invocation() == 0u) check_room();
#endif
    for (uint i = invocation(); i < count; i += together) WEFT_PASS(i);
}
