// Reach: C = |a - b| - limit, at most 0. Hard.

struct ReachRow { WEFT_ROW_reach(WEFT_ROW_MEMBER) };

WEFT_FN void project_reach(inout_(vec3) a, inout_(vec3) b, real wa, real wb,
                           inout_(real) lambda, ReachRow row, Step step)
{
    vec3 d = a - b;
    real len2 = dot(d, d);
    real w = wa + wb;
    mask taut = len2 > row.limit * row.limit && len2 > real(1e-20) && w > real(0);
    real len = sqrt(max(len2, real(1e-20)));
    real s = select(taut, (row.limit - len) / (len * max(w, real(1e-30))), real(0));
    lambda = lambda + s * len;
    a = a + d * (wa * s);
    b = b - d * (wb * s);
}

// One-sided: nothing to damp.
WEFT_FN void damp_reach(inout_(vec3) va, inout_(vec3) vb, vec3 a, vec3 b, real wa, real wb, ReachRow row, real viscous)
{
}
