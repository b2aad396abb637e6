// Passes over triangles, and sums over the triangles at each particle.
#ifndef WEFT_FACES_GLSL
#define WEFT_FACES_GLSL

void corners_of(FaceArgs a, uint t, out uint corner[3], out vec3 x[3])
{
    for (uint k = 0u; k < 3u; ++k) {
        corner[k] = a.faces.at[k * a.stride + t];
        x[k] = load_point(a.position, corner[k]).xyz;
    }
}

void run_wind(FaceArgs a, uint t)
{
    uint corner[3];
    vec3 x[3];
    corners_of(a, t, corner, x);
    vec3 middle = (x[0] + x[1] + x[2]) * (1.0 / 3.0);
    vec3 u = vec3(0.0);
    for (uint i = 0u; i < a.frame.at.winds; ++i) {
        WindIn wind = a.winds.at[i];
        WindNumbers numbers = WindNumbers(wind.n0.xyz, wind.n1.xyz, wind.n2.xyz);
        WindLife life = WindLife(wind.n0.w, wind.n1.w, wind.n2.w, wind.noise_offset.w, wind.turbulence,
                                 wind.noise_per_meter, wind.noise_time, wind.noise_offset.xyz);
        Flow flow = Flow(vec3(0.0), 0.0, 0.0);
        uint kind = 0u;
#define WEFT_WIND(name, Name) if (wind.kind == kind++) flow = flow_##name(middle, numbers);
#include "physics/air/winds.def"
#undef WEFT_WIND
        u = u + live_wind(flow, float(t), life);
    }
    a.wind.at[t] = vec4(u, 0.0);
}

void run_air(FaceArgs a, uint t)
{
    uint corner[3];
    vec3 x[3];
    corners_of(a, t, corner, x);
    float third = 1.0 / 3.0;
    vec3 v = (a.velocity.at[corner[0]].xyz + a.velocity.at[corner[1]].xyz + a.velocity.at[corner[2]].xyz) * third;
    if (!is_none(uvec2(a.wind))) v = v - a.wind.at[t].xyz;
    float mass = a.mass.at[t];
    vec3 dv = air_velocity_change(v, face_normal(x[0], x[1], x[2]), mass,
                                  AirFabric(a.frame.at.drag, a.frame.at.lift, a.frame.at.listing), a.frame.at.h);
    a.by_face.at[t] = vec4(dv * (mass * third), 0.0);
}

void run_faces(FaceArgs a, uint t)
{
    uint corner[3];
    vec3 x[3];
    corners_of(a, t, corner, x);
    a.by_face.at[t] = vec4(face_normal(x[0], x[1], x[2]), 0.0);
}

vec3 sum_around(AroundArgs a, uint p)
{
    vec3 sum = vec3(0.0);
    uint end = a.offsets.at[p + 1u];
    for (uint k = a.offsets.at[p]; k < end; ++k) sum = sum + a.by_face.at[a.items.at[k]].xyz;
    return sum;
}

void run_push(AroundArgs a, uint p)
{
    float w = load_point(a.position, p).w;
    if (!(w > 0.0)) return;
    vec4 s = a.start.at[p], v = a.velocity.at[p], c = a.carry.at[p];
    Motion m = Motion(v.xyz, vec3(s.w, v.w, c.w), c.xyz);
    push_by_air(m, sum_around(a, p), w);
    a.start.at[p].w = m.v_dropped.x;
    a.velocity.at[p] = vec4(m.v, m.v_dropped.y);
    a.carry.at[p].w = m.v_dropped.z;
}

void run_normals(AroundArgs a, uint p)
{
    a.normals.at[p] = vec4(unit_normal(sum_around(a, p)), 0.0);
}

#endif
