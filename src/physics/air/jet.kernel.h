// A round turbulent jet (law: air.md). n0 is the velocity at the nozzle [m/s]; n1 and n2 are unit vectors perpendicular
// to it; s0 is the diameter of the nozzle [m].

WEFT_FN Flow flow_jet(vec3 p, WindNumbers n)
{
    Flow flow;
    flow.q1 = dot(p, n.n1);
    flow.q2 = dot(p, n.n2);
    real r = sqrt(flow.q1 * flow.q1 + flow.q2 * flow.q2);
    real x = dot(p, cross(n.n2, n.n1));   // along the axis

    // The core, in which the air has the full velocity, narrows from the nozzle to a point at x = 6 d. Around it the
    // velocity falls by half over a tenth of x, or of half a diameter at the nozzle, where it would fall at once.
    real core = max(real(0.5) * n.s0 - x * real(1.0 / 12.0), real(0));
    real half_width = real(0.1) * max(x, real(0.5) * n.s0);
    real outside = max(r - core, real(0)) / half_width;
    real profile = exp_of_minus(real(0.6931471805599453) * (outside * outside));
    real on_axis = min(real(6) * n.s0 / max(x, n.s0), real(1));
    flow.velocity = n.n0 * select(x < real(0), real(0), on_axis * profile);
    return flow;
}
