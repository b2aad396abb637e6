// Stretch: moves two ends toward their rest distance. C = |a - b| - rest.

struct StretchRow { WEFT_ROW_stretch(WEFT_ROW_MEMBER) };

WEFT_FN void project_stretch(inout_(vec3) a, inout_(vec3) b, real wa, real wb,
                             inout_(real) lambda, StretchRow row, Step step)
{
    vec3 d = a - b;
    real len2 = dot(d, d);
    real len = sqrt(len2);
    real c = len - row.rest;
    real compliance = select(c > real(0), row.compliance, row.compression);
    real alpha = compliance * step.inv_h2;
    mask slack = compliance < real(0);            // no stiffness on this side: any lambda left over unwinds
    real num = select(slack, lambda, c + alpha * lambda);
    real w = wa + wb;
    real den = select(slack, real(1), w + alpha) * len;
    // Both ends pinned: nothing to do. Coincident ends: no direction to push in.
    mask able = w > real(0) && len2 > real(1e-20);
    real s = select(able, -num / den, real(0));   // delta lambda / |d|: one division instead of two
    lambda = lambda + s * len;
    a = a + d * (wa * s);
    b = b - d * (wb * s);
}

// Viscosity beside the spring: an impulse along the edge against the rate at which its length changes, implicit, so
// that it stops that change at most. `viscous` is the retardation time times the time step, s2.
WEFT_FN void damp_stretch(inout_(vec3) va, inout_(vec3) vb, vec3 a, vec3 b, real wa, real wb,
                          StretchRow row, real viscous)
{
    vec3 d = a - b;
    real len2 = dot(d, d);
    real compliance = select(len2 > row.rest * row.rest, row.compliance, row.compression);
    real w = wa + wb;
    mask able = w > real(0) && len2 > real(1e-20) && !(compliance < real(0));
    real s = select(able, -dot(d, va - vb) / ((w + compliance / viscous) * len2), real(0));
    va = va + d * (wa * s);
    vb = vb - d * (wb * s);
}
