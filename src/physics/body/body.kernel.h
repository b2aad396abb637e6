// Rigid body: free motion, and what impulses do to it (scheme: body.md).

// A unit quaternion: a rotation.
struct Turn { real x, y, z, w; };

// A tensor of inertia along the body's axes and its inverse: the elements xx, yy, zz, and yz, zx, xy.
struct BodyInertia { vec3 moments, products, inverse_moments, inverse_products; };

struct BodyMotion {
    vec3 place;      // m        of the center of mass
    Turn turn;       //          from the body's axes to the world's
    vec3 v;          // m/s      of the center of mass
    vec3 spin;       // kg m2/s  angular momentum about the center of mass
    vec3 v_dropped;  // m/s      what rounding drops when a small increment meets a large velocity
    vec3 x_dropped;  // m        the same for the place
};

// Sums of what touches a body in one go.
struct BodyPush {
    vec3 impulse;  // N s
    vec3 twist;    // N m s  about the center of mass
};

WEFT_FN vec3 times_symmetric(vec3 diagonal, vec3 others, vec3 v)
{
    return vec3(diagonal.x * v.x + others.z * v.y + others.y * v.z,
                others.z * v.x + diagonal.y * v.y + others.x * v.z,
                others.y * v.x + others.x * v.y + diagonal.z * v.z);
}

WEFT_FN vec3 turned(Turn q, vec3 v)
{
    vec3 axis = vec3(q.x, q.y, q.z);
    vec3 t = cross(axis, v) * real(2);
    return v + t * q.w + cross(axis, t);
}
WEFT_FN vec3 turned_back(Turn q, vec3 v)
{
    vec3 axis = vec3(-q.x, -q.y, -q.z);
    vec3 t = cross(axis, v) * real(2);
    return v + t * q.w + cross(axis, t);
}

// Turns on about `by`, in world axes, by 2 atan(|by| / 2) rad: by |by|, with an error of |by|³/12. `by` counts as at most
// 3 rad, so that the turn is finite whatever the spin.
WEFT_FN Turn turned_by(Turn q, vec3 by)
{
    real len2 = dot(by, by);
    vec3 half_way = by * (real(0.5) * select(len2 > real(9), real(3) * inversesqrt(max(len2, real(9))), real(1)));
    vec3 axis = vec3(q.x, q.y, q.z);
    vec3 to = half_way * q.w + axis + cross(half_way, axis);
    real w = q.w - dot(half_way, axis);
    real inv = real(1) / sqrt(dot(to, to) + w * w);
    Turn turn;
    turn.x = to.x * inv;
    turn.y = to.y * inv;
    turn.z = to.z * inv;
    turn.w = w * inv;
    return turn;
}

// rad/s
WEFT_FN vec3 rate_of(Turn turn, vec3 spin, BodyInertia inertia)
{
    return turned(turn, times_symmetric(inertia.inverse_moments, inertia.inverse_products, turned_back(turn, spin)));
}

// Sums with what rounding has dropped before (Kahan). `dropped` takes what it drops now.
WEFT_FN vec3 plus_dropped(vec3 x, vec3 by, inout_(vec3) dropped)
{
    vec3 t = by + dropped;
    vec3 sum = x + t;
    dropped = t - (sum - x);
    return sum;
}

// Moves a body as if nothing touched it. Its angular momentum is exactly constant; the rotation follows from it by the
// midpoint rule.
//   slowing, spin_slowing  factors on the velocity and the angular momentum
WEFT_FN void predict_body(inout_(BodyMotion) m, BodyInertia inertia, vec3 gravity, real slowing, real spin_slowing,
                          Step step)
{
    m.v = plus_dropped(m.v, gravity * step.h, m.v_dropped) * slowing;
    m.v_dropped = m.v_dropped * slowing;
    m.spin = m.spin * spin_slowing;
    m.place = plus_dropped(m.place, m.v * step.h, m.x_dropped);
    Turn middle = turned_by(m.turn, rate_of(m.turn, m.spin, inertia) * (real(0.5) * step.h));
    m.turn = turned_by(m.turn, rate_of(middle, m.spin, inertia) * step.h);
}

// Changes velocity and spin alone.
WEFT_FN void hit_body(inout_(BodyMotion) m, real inverse_mass, BodyPush push)
{
    m.v = plus_dropped(m.v, push.impulse * inverse_mass, m.v_dropped);
    m.spin = m.spin + push.twist;
}

// Changes place and rotation alone: by what the impulse at the start of the substep would have moved them.
WEFT_FN void shift_body(inout_(BodyMotion) m, real inverse_mass, BodyInertia inertia, BodyPush push, Step step)
{
    m.place = plus_dropped(m.place, push.impulse * inverse_mass * step.h, m.x_dropped);
    m.turn = turned_by(m.turn, rate_of(m.turn, push.twist, inertia) * step.h);
}

// Changes velocity and spin, and place and rotation as if the impulse had come at the start of the substep.
WEFT_FN void push_body(inout_(BodyMotion) m, real inverse_mass, BodyInertia inertia, BodyPush push, Step step)
{
    hit_body(m, inverse_mass, push);
    shift_body(m, inverse_mass, inertia, push, step);
}
