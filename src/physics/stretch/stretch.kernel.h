// Stretch: moves two ends toward their rest distance. C = |a - b| - rest. Beyond the length `straight` it is the spring
// that has the same force there and WEFT_STRAIGHT_COMPLIANCE times the compliance.

struct StretchRow { WEFT_ROW_stretch(WEFT_ROW_MEMBER) };

// A constraint at the current positions of its points.
struct StretchState {
    vec3 d;               // from the second point to the first
    real len2;
    real len;
    real c;
    real alpha;
    mask slack;           // no stiffness on this side: any remaining lambda is undone
};

WEFT_FN StretchState measure_stretch(vec3 a, vec3 b, StretchRow row, Step step)
{
    StretchState s;
    s.d = a - b;
    s.len2 = dot(s.d, s.d);
    s.len = sqrt(s.len2);
    s.c = s.len - row.rest;
    real compliance = select(s.c > real(0), row.compliance, row.compression);
    mask straight = s.len > row.straight;
    s.c = s.c - select(straight, (row.straight - row.rest) * (real(1) - real(WEFT_STRAIGHT_COMPLIANCE)), real(0));
    compliance = compliance * select(straight, real(WEFT_STRAIGHT_COMPLIANCE), real(1));
    s.alpha = compliance * step.inv_h2;
    s.slack = compliance < real(0);
    return s;
}

WEFT_FN void project_stretch(inout_(vec3) a, inout_(vec3) b, real wa, real wb,
                             inout_(real) lambda, StretchRow row, Step step)
{
    StretchState now = measure_stretch(a, b, row, step);
    real num = select(now.slack, lambda, now.c + now.alpha * lambda);
    real w = wa + wb;
    real den = select(now.slack, real(1), w + now.alpha) * now.len;
    // Both ends pinned: nothing to do. Coincident ends: no direction to push in.
    mask able = w > real(0) && now.len2 > real(1e-20);
    real s = select(able, -num / den, real(0));   // delta lambda / |d|: one division instead of two
    lambda = lambda + s * now.len;
    displace(a, now.d * (wa * s), step);
    displace(b, now.d * -(wb * s), step);
}

// Viscosity parallel to the spring: an implicit impulse along the edge against the rate of change of its length, which
// can at most stop that change. `viscous` is the retardation time times the time step, s2.
WEFT_FN void damp_stretch(inout_(vec3) va, inout_(vec3) vb, vec3 a, vec3 b, real wa, real wb,
                          StretchRow row, real viscous)
{
    vec3 d = a - b;
    real len2 = dot(d, d);
    real compliance = select(len2 > row.rest * row.rest, row.compliance, row.compression) *
                      select(len2 > row.straight * row.straight, real(WEFT_STRAIGHT_COMPLIANCE), real(1));
    real w = wa + wb;
    mask able = w > real(0) && len2 > real(1e-20) && !(compliance < real(0));
    real s = select(able, -dot(d, va - vb) / ((w + compliance / viscous) * len2), real(0));
    va = va + d * (wa * s);
    vb = vb - d * (wb * s);
}
