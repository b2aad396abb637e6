// A Lamb-Oseen vortex (law: air.md). n0 is the velocity on the axis [m/s]; n1 is the axis, a unit vector; s0 is α over
// the square of the radius [1/m2]; s1 and s2 are the speed around and toward the axis per distance from it, near it
// [1/s].

// (1 - exp(-s))/s for s >= 0.
WEFT_FN real share_of_exp(real s)
{
    real near = real(1.0 / 24.0) - s * (real(1.0 / 120.0) - s * real(1.0 / 720.0));
    near = real(1) - s * (real(1.0 / 2.0) - s * (real(1.0 / 6.0) - s * near));
    real far = (real(1) - exp_of_minus(s)) / max(s, real(0.25));
    return select(s < real(0.25), near, far);
}

WEFT_FN Flow flow_vortex(vec3 p, WindNumbers n)
{
    Flow flow;
    flow.q2 = dot(p, n.n1);
    vec3 from_axis = p - n.n1 * flow.q2;
    real r2 = dot(from_axis, from_axis);
    flow.q1 = sqrt(r2);

    real s = n.s0 * r2;
    real turning = share_of_exp(s);
    flow.velocity = n.n0 * exp_of_minus(s) + cross(n.n1, from_axis) * (n.s1 * turning) - from_axis * (n.s2 * turning);
    return flow;
}
