// Passes over triangles, and sums over the triangles at each particle.
#ifndef WEFT_FACES_GLSL
#define WEFT_FACES_GLSL

void corners_of(FaceArgsRef a, uint t, out uint corner[3], out vec3 x[3])
{
    for (uint k = 0u; k < 3u; ++k) {
        corner[k] = a.at.faces.at[k * a.at.stride + t];
        x[k] = load_point(a.at.position, corner[k]).xyz;
    }
}

void run_wind(FaceArgsRef a, uint t)
{
    uint corner[3];
    vec3 x[3];
    corners_of(a, t, corner, x);
    vec3 middle = (x[0] + x[1] + x[2]) * (1.0 / 3.0);
    vec3 u = vec3(0.0);
    for (uint i = 0u; i < a.at.frame.at.winds; ++i) {
        WindIn wind = a.at.winds.at[i];
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
    a.at.wind.at[t] = vec4(u, 0.0);
}

void run_air(FaceArgsRef a, uint t)
{
    uint corner[3];
    vec3 x[3];
    corners_of(a, t, corner, x);
    float third = 1.0 / 3.0;
    vec3 v = (a.at.velocity.at[corner[0]].xyz + a.at.velocity.at[corner[1]].xyz + a.at.velocity.at[corner[2]].xyz) * third;
    if (!is_none(uvec2(a.at.wind))) v = v - a.at.wind.at[t].xyz;
    float mass = a.at.mass.at[t];
    vec3 dv = air_velocity_change(v, face_normal(x[0], x[1], x[2]), mass,
                                  AirFabric(a.at.frame.at.drag, a.at.frame.at.lift, a.at.frame.at.listing), a.at.frame.at.h);
    a.at.by_face.at[t] = vec4(dv * (mass * third), 0.0);
}

void run_faces(FaceArgsRef a, uint t)
{
    uint corner[3];
    vec3 x[3];
    corners_of(a, t, corner, x);
    a.at.by_face.at[t] = vec4(face_normal(x[0], x[1], x[2]), 0.0);
}

vec3 sum_around(AroundArgsRef a, uint p)
{
    vec3 sum = vec3(0.0);
    uint end = a.at.offsets.at[p + 1u];
    for (uint k = a.at.offsets.at[p]; k < end; ++k) sum = sum + a.at.by_face.at[a.at.items.at[k]].xyz;
    return sum;
}

void run_push(AroundArgsRef a, uint p)
{
    float w = load_point(a.at.position, p).w;
    if (!(w > 0.0)) return;
    vec4 s = a.at.start.at[p], v = a.at.velocity.at[p], c = a.at.carry.at[p];
    Motion m = Motion(v.xyz, vec3(s.w, v.w, c.w), c.xyz);
    push_by_air(m, sum_around(a, p), w);
    a.at.start.at[p].w = m.v_dropped.x;
    a.at.velocity.at[p] = vec4(m.v, m.v_dropped.y);
    a.at.carry.at[p].w = m.v_dropped.z;
}

void run_normals(AroundArgsRef a, uint p)
{
    a.at.normals.at[p] = vec4(unit_normal(sum_around(a, p)), 0.0);
}

#endif
