// Air: drag and lift of a triangle, as a change of its velocity (law: air.md).

struct AirFabric {
    real drag;     // 1/2 rho C_D, kg/m3
    real lift;     // 1/2 rho C_L, kg/m3
    real sine_lift;  // 1: lift grows with the sine of the angle between flow and normal; 0: with its cosine
};

//   v       velocity of the triangle relative to the air, m/s
//   n2      its normal, twice its area long, m2
//   mass    kg
//
// Drag is solved implicitly, and lift turns the velocity without increasing it. So for any step the air never reverses
// a triangle's velocity relative to the air and never increases its magnitude.
WEFT_FN vec3 air_velocity_change(vec3 v, vec3 n2, real mass, AirFabric fabric, real h)
{
    real speed2 = dot(v, v);
    real area2 = dot(n2, n2);
    mask able = speed2 > real(1e-20) && area2 > real(1e-30) && mass > real(0);
    real speed = sqrt(max(speed2, real(1e-20)));
    real double_area = sqrt(max(area2, real(1e-30)));
    vec3 along = v * (real(1) / speed);
    vec3 n = n2 * (real(1) / double_area);
    real c = dot(along, n);
    n = select(c < real(0), -n, n);
    c = min(abs(c), real(1));

    // The volume of air that the triangle sweeps over its mass, m3/kg. Drag stops all motion long before this reaches
    // the bound.
    real swept = min(real(0.5) * double_area * speed * h / max(mass, real(1e-30)), real(1e12));
    real keep = real(1) / (real(1) + fabric.drag * c * swept);
    real share = select(fabric.sine_lift > real(0.5), sqrt(real(1) - c * c), c);
    vec3 turned = along + (along * c - n) * (fabric.lift * share * swept);
    vec3 after = turned * (speed * keep * inversesqrt(dot(turned, turned)));
    return select(able, after - v, v - v);   // zero, or NaN if the wind is NaN, so that it is detected
}

// Adds the air's impulse, the sum over a particle's triangles, to its velocity with compensated summation.
WEFT_FN void push_by_air(inout_(Motion) m, vec3 impulse, real w)
{
    vec3 dv = impulse * w + m.v_dropped;
    vec3 v = m.v + dv;
    mask moves = w > real(0);
    m.v_dropped = select(moves, dv - (v - m.v), m.v_dropped);
    m.v = select(moves, v, m.v);
}
