// Passes over triangles, and sums over the triangles at each particle.
#ifndef WEFT_FACES_GLSL
#define WEFT_FACES_GLSL

void corners_of(uint t, out uint corner[3], out vec3 x[3])
{
    for (uint k = 0u; k < 3u; ++k) {
        corner[k] = face_args.at.faces.at[k * face_args.at.stride + t];
        x[k] = load_point(face_args.at.position, corner[k]).xyz;
    }
}

// Whether a collider of the box stands within `reach` m of the point against the wind.
bool in_shelter(vec3 p, vec3 wind, float reach)
{
    float speed2 = dot(wind, wind);
    if (!(reach > 0.0) || !(speed2 > 1e-20) || is_none(uvec2(face_args.at.colliders))) return false;
    vec3 ray = wind * (-1.0 / sqrt(max(speed2, 1e-20)));
    vec3 end = p + ray * reach, room = vec3(1e-3) + 1e-5 * (abs(p) + abs(end));
    vec3 low = min(p, end) - room, high = max(p, end) + room;
    bool hit = false;
    for (uint node = 0u; node < face_args.at.colliders.at.node_count && !hit;) {
        vec4 node_low = face_args.at.colliders.at.nodes.at[2u * node];
        vec4 node_high = face_args.at.colliders.at.nodes.at[2u * node + 1u];
        uint number = floatBitsToUint(node_high.w);
        bool inside = overlap(node_low, node_high, low, high);
        node = inside ? node + 1u : floatBitsToUint(node_low.w);
        if (!inside || number == WEFT_NO_COLLIDER) continue;
        ColliderIn collider = face_args.at.colliders.at.colliders.at[number];
        PoseIn pose = pose_after(face_args.at.colliders, collider, 0u);
        hit = is_sheltered(solid_of(collider),
                           unrotate(pose.x.xyz, pose.y.xyz, pose.z.xyz, p - pose.position.xyz),
                           unrotate(pose.x.xyz, pose.y.xyz, pose.z.xyz, ray), reach);
    }
    return hit;
}

void run_wind(uint t)
{
    uint corner[3];
    vec3 x[3];
    corners_of(t, corner, x);
    vec3 middle = (x[0] + x[1] + x[2]) * (1.0 / 3.0);
    vec3 u = vec3(0.0);
    for (uint i = 0u; i < face_args.at.frame.at.winds; ++i) {
        WindIn wind = face_args.at.winds.at[i];
        vec3 p = middle - wind.position.xyz;
        WindNumbers numbers = WindNumbers(wind.n0.xyz, wind.n1.xyz, wind.n2.xyz, wind.s0, wind.s1, wind.s2);
        WindBounds bounds = WindBounds(wind.axis_x.xyz, wind.axis_y.xyz, wind.axis_z.xyz,
                                       vec3(wind.axis_x.w, wind.axis_y.w, wind.axis_z.w), wind.per_border,
                                       wind.position.w);
        WindLife life = WindLife(wind.n0.w, wind.n1.w, wind.n2.w, wind.noise_offset.w, wind.turbulence,
                                 wind.noise_per_meter, wind.noise_time, wind.noise_offset.xyz);
        Flow flow = Flow(vec3(0.0), 0.0, 0.0);
        uint kind = 0u;
#define WEFT_WIND(name, Name) if (wind.kind == kind++) flow = flow_##name(p, numbers);
#include "physics/air/winds.def"
#undef WEFT_WIND
        vec3 blown = live_wind(flow, float(t), life) * wind_share(p, bounds);
        if (!in_shelter(middle, blown, wind.shelter)) u = u + blown;
    }
    face_args.at.wind.at[t] = vec4(u, 0.0);
}

void run_air(uint t)
{
    uint corner[3];
    vec3 x[3];
    corners_of(t, corner, x);
    float third = 1.0 / 3.0;
    vec3 v = (face_args.at.velocity.at[corner[0]].xyz + face_args.at.velocity.at[corner[1]].xyz +
              face_args.at.velocity.at[corner[2]].xyz) * third;
    if (!is_none(uvec2(face_args.at.wind))) v = v - face_args.at.wind.at[t].xyz;
    float mass = face_args.at.mass.at[t];
    vec3 dv = air_velocity_change(v, face_normal(x[0], x[1], x[2]), mass,
                                  AirFabric(face_args.at.frame.at.drag, face_args.at.frame.at.lift,
                                            face_args.at.frame.at.sine_lift),
                                  face_args.at.frame.at.h);
    face_args.at.by_face.at[t] = vec4(dv * (mass * third), 0.0);
}

void run_faces(uint t)
{
    uint corner[3];
    vec3 x[3];
    corners_of(t, corner, x);
    face_args.at.by_face.at[t] = vec4(face_normal(x[0], x[1], x[2]), 0.0);
}

void run_smooth_faces(uint t)
{
    vec3 n[3];
    for (uint k = 0u; k < 3u; ++k)
        n[k] = face_args.at.normals.at[face_args.at.faces.at[k * face_args.at.stride + t]].xyz;
    face_args.at.by_face.at[t] = vec4(smooth_face(face_args.at.by_face.at[t].xyz, n[0], n[1], n[2]), 0.0);
}

vec3 sum_around(uint p)
{
    vec3 sum = vec3(0.0);
    uint end = around_args.at.offsets.at[p + 1u];
    for (uint k = around_args.at.offsets.at[p]; k < end; ++k)
        sum = sum + around_args.at.by_face.at[around_args.at.items.at[k]].xyz;
    return sum;
}

void run_push(uint p)
{
    float w = load_point(around_args.at.position, p).w;
    if (!(w > 0.0)) return;
    vec4 s = around_args.at.start.at[p], v = around_args.at.velocity.at[p], c = around_args.at.compensation.at[p];
    Motion m = Motion(v.xyz, vec3(s.w, v.w, c.w), c.xyz);
    push_by_air(m, sum_around(p), w);
    around_args.at.start.at[p].w = m.v_dropped.x;
    around_args.at.velocity.at[p] = vec4(m.v, m.v_dropped.y);
    around_args.at.compensation.at[p].w = m.v_dropped.z;
}

void run_normals(uint p)
{
    around_args.at.normals.at[p] = vec4(unit_normal(sum_around(p)), 0.0);
}

#endif
