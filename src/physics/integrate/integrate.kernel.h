// Integration of particles at the start and end of a substep (scheme: integrate.md).

struct Step {
    real h;       // s    length of the substep
    real inv_h;   // 1/s
    real inv_h2;  // 1/s2
    real tension; // N/m  in the cloth; lengthens one-sided limits
    real allowed; //      factor on their length
    real shift_c; // rad  of the rest angle of a moment, by the triangle with c
    real shift_d; //      by that with d
    real undone;  //      part of its weight by which a constraint of bending is softer after the sweep; 0 if unknown
    bool apart;   //      projections return displacements in place of places, for move_exactly()
};

// A step in which limits do not give way and rest angles do not move.
WEFT_FN Step step_without_limits(real h, real inv_h, real inv_h2)
{
    Step step;
    step.h = h;
    step.inv_h = inv_h;
    step.inv_h2 = inv_h2;
    step.tension = real(0);
    step.allowed = real(1);
    step.shift_c = real(0);
    step.shift_d = real(0);
    step.undone = real(0);
    step.apart = false;
    return step;
}

// Moves a particle by a projection.
WEFT_FN void displace(inout_(vec3) x, vec3 by, Step step)
{
    if (step.apart) x = by;
    else x = x + by;
}

// A particle's velocity and the compensation for what rounding drops when a small increment meets a large velocity.
struct Motion {
    vec3 v;         // m/s
    vec3 v_dropped; // m/s
    vec3 x_dropped; // m    the same for positions
};

WEFT_FN mask too_fast(vec3 v, real max_speed) { return dot(v, v) > max_speed * max_speed; }

WEFT_FN vec3 cap_speed(vec3 v, real max_speed)
{
    return select(too_fast(v, max_speed), v * (max_speed * inversesqrt(max(dot(v, v), real(1e-30)))), v);
}

// Moves a particle as if there were no constraints; one of inverse mass 0 stays. Returns where the speed cap acted.
WEFT_FN mask predict(inout_(vec3) x, inout_(Motion) m, real w, vec3 acceleration, real max_speed, Step step)
{
    mask moves = w > real(0);
    vec3 dv = acceleration * step.h + m.v_dropped;
    vec3 v = m.v + dv;
    mask capped = moves && too_fast(v, max_speed);
    m.v_dropped = select(moves, dv - (v - m.v), vec3(real(0)));
    m.v = select(moves, cap_speed(v, max_speed), m.v);
    x = select(moves, x + (m.v * step.h + m.x_dropped), x);
    return capped;
}

// Computes the velocity from the motion from `start` to `x`. Recomputes the prediction instead of storing it: the same
// operations on the same numbers give the same bits. Returns where the speed cap acted.
WEFT_FN mask update_velocity(inout_(Motion) m, vec3 x, vec3 start, real w, real max_speed, Step step)
{
    vec3 t = m.v * step.h + m.x_dropped;
    vec3 predicted = start + t;
    mask moves = w > real(0);
    m.x_dropped = select(moves, t - (predicted - start), vec3(real(0)));
    // A kinematic particle has the velocity of its prescribed motion.
    vec3 v = select(moves, m.v + (x - predicted) * step.inv_h, (x - start) * step.inv_h);
    m.v = cap_speed(v, max_speed);
    return too_fast(v, max_speed);
}

// Moves a particle, and keeps what rounding drops.
WEFT_FN void move_exactly(inout_(vec3) x, inout_(vec3) remainder, vec3 by)
{
    vec3 t = remainder + by;
    vec3 moved = x + t;
    remainder = t - (moved - x);
    x = moved;
}

// As update_velocity(), where projections keep what rounding drops from them: `x` and `remainder` are the place together. The change
// of the velocity keeps its rounding error too.
WEFT_FN mask update_velocity_exactly(inout_(Motion) m, vec3 x, vec3 remainder, vec3 start, real w, real max_speed, Step step)
{
    vec3 t = m.v * step.h + m.x_dropped;
    vec3 predicted = start + t;
    mask moves = w > real(0);
    m.x_dropped = select(moves, (t - (predicted - start)) + remainder, vec3(real(0)));
    vec3 dv = ((x - predicted) + remainder) * step.inv_h + m.v_dropped;
    vec3 v = select(moves, m.v + dv, (x - start) * step.inv_h);
    m.v_dropped = select(moves, dv - (v - m.v), vec3(real(0)));
    m.v = cap_speed(v, max_speed);
    return too_fast(v, max_speed);
}
