// Stretch: moves two ends toward their rest distance. C = |a - b| - rest.

struct StretchRow { WEFT_ROW_stretch(WEFT_ROW_MEMBER) };

// The spring of an edge at its present length, whose stiffness grows where its threads become straight: its force is
// (c / compliance) of a spring with these numbers, times the stiffness at rest.
struct StretchSpring {
    real c;      // m
    real share;  // of the compliance at rest
};

// `longer`: by how much it is longer than at rest, m. `play`: as in StretchRow.
WEFT_FN StretchSpring stretch_spring(real longer, real play)
{
    StretchSpring s;
    s.c = longer;
    s.share = real(1);
    real grown = longer - play * real(0.5);
    if (any(grown > real(0))) {
        real x = max(real(0), min(grown, play));
        mask stiffer = x > real(0);
        real divisor = real(1) / select(stiffer, play + x * real(WEFT_STRAIGHT_STIFFNESS - 1.0), real(1));
        real force = longer * play + real(WEFT_STRAIGHT_STIFFNESS - 1.0) * x * (grown - x * real(0.5));
        s.c = select(stiffer, force * divisor, longer);
        s.share = select(stiffer, play * divisor, real(1));
    }
    return s;
}

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
    StretchSpring spring = stretch_spring(s.len - row.rest, row.play);
    s.c = spring.c;
    real compliance = select(s.c > real(0), row.compliance, row.compression) * spring.share;
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
                      stretch_spring(sqrt(len2) - row.rest, row.play).share;
    real w = wa + wb;
    mask able = w > real(0) && len2 > real(1e-20) && !(compliance < real(0));
    real s = select(able, -dot(d, va - vb) / ((w + compliance / viscous) * len2), real(0));
    va = va + d * (wa * s);
    vb = vb - d * (wb * s);
}
