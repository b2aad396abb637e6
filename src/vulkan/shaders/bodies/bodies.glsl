// Rigid bodies: their state, and sides of contacts (bodies.data.h). One workgroup moves all bodies.
#ifndef WEFT_BODIES_GLSL
#define WEFT_BODIES_GLSL

#include "vulkan/shaders/workgroup_barrier.glsl"
#include "vulkan/args.data.h"

#include "physics/kernels.glsl"

#include "physics/body/faces.kernel.h"
#include "physics/body/pairs.kernel.h"

layout(local_size_x = WEFT_BODY_GROUP) in;

layout(push_constant) uniform Push { BodiesArgs args; };

#define WEFT_BODIES args.colliders.at.bodies.at
#define WEFT_BODY(i) args.colliders.at.bodies.at.bodies.at[i]
#define WEFT_NO_BODY 0xffffffffu

#include "vulkan/shaders/collider_lists.glsl"
#include "vulkan/shaders/sum_words.glsl"

uint me() { return gl_LocalInvocationID.x; }

Step substep_of_bodies() { return step_without_limits(WEFT_BODIES.h, WEFT_BODIES.inv_h, WEFT_BODIES.inv_h2); }
vec3 gravity_of_bodies() { return vec3(WEFT_BODIES.gravity_x, WEFT_BODIES.gravity_y, WEFT_BODIES.gravity_z); }

BodyMotion motion_of(uint body)
{
    vec4 q = WEFT_BODY(body).turn;
    BodyMotion m;
    m.place = WEFT_BODY(body).place.xyz;
    m.turn = Turn(q.x, q.y, q.z, q.w);
    m.v = WEFT_BODY(body).velocity.xyz;
    m.spin = WEFT_BODY(body).spin.xyz;
    m.v_dropped = WEFT_BODY(body).v_dropped.xyz;
    m.x_dropped = WEFT_BODY(body).x_dropped.xyz;
    return m;
}
void store_motion(uint body, BodyMotion m)
{
    WEFT_BODY(body).place = vec4(m.place, 0.0);
    WEFT_BODY(body).turn = vec4(m.turn.x, m.turn.y, m.turn.z, m.turn.w);
    WEFT_BODY(body).velocity = vec4(m.v, 0.0);
    WEFT_BODY(body).spin = vec4(m.spin, 0.0);
    WEFT_BODY(body).v_dropped = vec4(m.v_dropped, 0.0);
    WEFT_BODY(body).x_dropped = vec4(m.x_dropped, 0.0);
}

// Whole vectors are read, because lavapipe reads parts of a vector wrongly (docs/vulkan.md).
BodyInertia inertia_of(uint body)
{
    vec4 moments = WEFT_BODY(body).moments, products = WEFT_BODY(body).products;
    vec4 inverse_moments = WEFT_BODY(body).inverse_moments, inverse_products = WEFT_BODY(body).inverse_products;
    return BodyInertia(moments.xyz, products.xyz, inverse_moments.xyz, inverse_products.xyz);
}
float inverse_mass_of(uint body)
{
    vec4 moments = WEFT_BODY(body).moments;
    return moments.w;
}
float radius_of(uint body)
{
    vec4 products = WEFT_BODY(body).products;
    return products.w;
}

PoseIn pose_now(uint body) { return pose_of_body(args.colliders.at.bodies, body, WEFT_BODY_NOW); }
void store_pose(uint body, uint which, PoseIn pose) { WEFT_BODIES.poses.at[WEFT_BODY_POSES * body + which] = pose; }

// Computes the pose from the motion.
void place_body(uint body, BodyMotion m)
{
    vec3 x = turned(m.turn, vec3(1.0, 0.0, 0.0)), y = turned(m.turn, vec3(0.0, 1.0, 0.0)),
         z = turned(m.turn, vec3(0.0, 0.0, 1.0));
    vec4 center = WEFT_BODY(body).center;
    vec3 position = m.place - rotate(x, y, z, center.xyz);
    store_pose(body, WEFT_BODY_NOW, PoseIn(vec4(x, 0.0), vec4(y, 0.0), vec4(z, 0.0), vec4(position, 0.0)));
}

// The inverse tensor of inertia in world axes: R I⁻¹ Rᵀ, column by column.
vec3 inertia_column(PoseIn pose, BodyInertia inertia, vec3 row)
{
    return rotate(pose.x.xyz, pose.y.xyz, pose.z.xyz,
                  times_symmetric(inertia.inverse_moments, inertia.inverse_products, row));
}
void turn_inertia(uint body)
{
    PoseIn pose = pose_now(body);
    BodyInertia inertia = inertia_of(body);
    WEFT_BODY(body).ix = vec4(inertia_column(pose, inertia, vec3(pose.x.x, pose.y.x, pose.z.x)), 0.0);
    WEFT_BODY(body).iy = vec4(inertia_column(pose, inertia, vec3(pose.x.y, pose.y.y, pose.z.y)), 0.0);
    WEFT_BODY(body).iz = vec4(inertia_column(pose, inertia, vec3(pose.x.z, pose.y.z, pose.z.z)), 0.0);
}

// What an impulse changes.
#define WEFT_PUSH 0   // all: push_body
#define WEFT_HIT 1    // velocity and spin: hit_body
#define WEFT_SHIFT 2  // place and rotation: shift_body

void change_one(uint body, uint how, BodyPush by)
{
    BodyMotion m = motion_of(body);
    if (how == WEFT_PUSH) push_body(m, inverse_mass_of(body), inertia_of(body), by, substep_of_bodies());
    else if (how == WEFT_HIT) hit_body(m, inverse_mass_of(body), by);
    else shift_body(m, inverse_mass_of(body), inertia_of(body), by, substep_of_bodies());
    store_motion(body, m);
    if (how != WEFT_HIT) place_body(body, m);
}

ContactBody between_poses(PoseIn before, PoseIn now)
{
    return ContactBody(now.x.xyz, now.y.xyz, now.z.xyz, now.position.xyz, before.x.xyz, before.y.xyz, before.z.xyz,
                       before.position.xyz, 0.0, 0.0, 0.0, 0.0);
}

ColliderIn collider_at(uint collider) { return args.colliders.at.colliders.at[collider]; }
uint body_at(uint collider)
{
    ColliderIn of = collider_at(collider);
    return is_body(of) ? of.body : WEFT_NO_BODY;
}

// A body or a collider as a side of a contact, at the velocities of the start of the substep.
BodySide side_of(uint collider, uint body)
{
    BodySide side;
    if (body == WEFT_NO_BODY) {
        ColliderIn of = collider_at(collider);
        side.poses = between_poses(pose_after(args.colliders, of, args.substep),
                                   pose_after(args.colliders, of, args.substep + 1u));
        side.moved = immovable();
        side.v = vec3(0.0);
        side.rate = vec3(0.0);
        side.is_body = false;
        return side;
    }
    side.poses = between_poses(pose_of_body(args.colliders.at.bodies, body, WEFT_BODY_BEFORE), pose_now(body));
    side.moved = MovedBody(1.0, inverse_mass_of(body), WEFT_BODY(body).place.xyz, WEFT_BODY(body).ix.xyz,
                           WEFT_BODY(body).iy.xyz, WEFT_BODY(body).iz.xyz);
    vec4 v = WEFT_BODY(body).v;
    side.v = v.xyz;
    side.rate = WEFT_BODY(body).rate.xyz;
    side.is_body = true;
    return side;
}
// The same with the velocities of now.
BodySide side_now(uint collider, uint body)
{
    BodySide side = side_of(collider, body);
    if (body == WEFT_NO_BODY) return side;
    BodyMotion m = motion_of(body);
    side.v = m.v;
    side.rate = rate_of(m.turn, m.spin, inertia_of(body));
    return side;
}

shared uint partial[2u * WEFT_BODY_GROUP];

// Sum of `mine` over the invocations before this one, and over all (Hillis and Steele 1986).
uint sum_before(uint mine, out uint all)
{
    shared_barrier();  // a call before may still be read
    partial[me()] = mine;
    shared_barrier();
    uint at = 0u;
    for (uint reach = 1u; reach < WEFT_BODY_GROUP; reach *= 2u) {
        uint sum = partial[at + me()];
        if (me() >= reach) sum += partial[at + me() - reach];
        at ^= WEFT_BODY_GROUP;
        partial[at + me()] = sum;
        shared_barrier();
    }
    all = partial[at + WEFT_BODY_GROUP - 1u];
    return me() > 0u ? partial[at + me() - 1u] : 0u;
}

#endif
