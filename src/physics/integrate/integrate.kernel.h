// Moving particles: the substep's start and end (integrate.md has the scheme).

struct Step {
    real h;       // s    length of the substep
    real inv_h;   // 1/s
    real inv_h2;  // 1/s2
    real tension; // N/m  in the cloth, for one-sided limits: they give way to it
    real allowed; //      and are this many times as long
};

// A particle's velocity with the part that float drops when gravity's small increment meets a large velocity.
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

// Where a particle would go without constraints. A weight of 0 stays. Returns where the cap acted.
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

// The velocity that carried the particle from `start` to `x`. The prediction is computed once more rather than stored:
// the same operations on the same numbers, so the same bits. Returns where the cap acted.
WEFT_FN mask update_velocity(inout_(Motion) m, vec3 x, vec3 start, real w, real max_speed, Step step)
{
    vec3 t = m.v * step.h + m.x_dropped;
    vec3 predicted = start + t;
    mask moves = w > real(0);
    m.x_dropped = select(moves, t - (predicted - start), vec3(real(0)));
    // What is held has the velocity of the hand that moves it, and none when that stands.
    vec3 v = select(moves, m.v + (x - predicted) * step.inv_h, (x - start) * step.inv_h);
    m.v = cap_speed(v, max_speed);
    return too_fast(v, max_speed);
}
