// Grab: pulls a point in a triangle toward a target, with a limited force (law: grab.md).

struct GrabRow {
    vec3 target;      // m    at the end of the substep
    vec3 way;         // m    from the target at the start of the substep to `target`
    real c0;          // weights of the corners; their sum is 1
    real c1;
    real c2;
    real max_force;   // N
    real compliance;  // m/N
    real damping;     // s
    real reach;       // m    that the largest force moves the hand in a substep, from rest
};

// m: the target after a substep, with `left` substeps to go in the frame; at the end exactly `to`.
WEFT_FN vec3 grab_target(vec3 from, vec3 to, real left, real per_substep)
{
    return to - (to - from) * (left * per_substep);
}

// kg: the mass of the hand. The largest force moves it by `reach` in a substep. On a soft spring it is lighter, so that
// it does not swing.
WEFT_FN real hand_mass(GrabRow row, Step step)
{
    return real(1) / ((row.reach / row.max_force + row.compliance) * step.inv_h2);
}

// Adds the hand's mass to a corner of weight `c`. Hands do not fall: takes back their part of the fall in `gravity`.
// `free`: inverse mass of the corner without hands.
WEFT_FN void take_hold(inout_(vec3) x, inout_(real) w, real free, real c, vec3 gravity, GrabRow row, Step step)
{
    real held = w / (real(1) + w * c * hand_mass(row, step));
    x = x - gravity * (step.h * step.h * select(free > real(0), (w - held) / free, real(0)));
    w = held;
}

// `start`: positions at the start of the substep.
WEFT_FN void project_grab(inout_(vec3) x0, inout_(vec3) x1, inout_(vec3) x2, vec3 start0, vec3 start1, vec3 start2,
                          real w0, real w1, real w2, inout_(vec3) lambda, GrabRow row, Step step)
{
    // Differences to the target and to the start are small where the coordinates are large.
    vec3 d = (x0 - row.target) * row.c0 + (x1 - row.target) * row.c1 + (x2 - row.target) * row.c2;
    vec3 slip = (x0 - start0) * row.c0 + (x1 - start1) * row.c1 + (x2 - start2) * row.c2 - row.way;
    real w = w0 * (row.c0 * row.c0) + w1 * (row.c1 * row.c1) + w2 * (row.c2 * row.c2);
    real alpha = row.compliance * step.inv_h2;
    real gamma = row.damping * step.inv_h;
    real most = max(row.max_force * (step.h * step.h), real(1e-30));
    // Lambda in units of the largest one, which keeps its square in range.
    vec3 u = lambda * (real(1) / most) -
             (d + lambda * alpha + slip * gamma) * (real(1) / (((real(1) + gamma) * w + alpha) * most));
    real len2 = dot(u, u);
    u = u * select(len2 > real(1), inversesqrt(max(len2, real(1))), real(1));
    vec3 change = select(w > real(0), u * most - lambda, vec3(real(0)));   // all pinned: nothing to do
    lambda = lambda + change;
    x0 = x0 + change * (w0 * row.c0);
    x1 = x1 + change * (w1 * row.c1);
    x2 = x2 + change * (w2 * row.c2);
}
