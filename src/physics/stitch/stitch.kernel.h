// Stitch: moves two points on cloth toward their gap. C = |d| - gap, d = sum of c_i x_i, the first point minus the second.

struct StitchRow { WEFT_ROW_stitch(WEFT_ROW_MEMBER) };

// The vector from the second point to the first. Shares sum to 0, so it can be computed from differences to one
// particle, which reduces rounding errors.
WEFT_FN vec3 across_stitch(vec3 x0, vec3 x1, vec3 x2, vec3 x3, vec3 x4, vec3 x5, StitchRow row)
{
    return (x1 - x0) * row.c1 + (x2 - x0) * row.c2 + (x3 - x0) * row.c3 + (x4 - x0) * row.c4 + (x5 - x0) * row.c5;
}

WEFT_FN real stitch_weight(real w0, real w1, real w2, real w3, real w4, real w5, StitchRow row)
{
    return w0 * (row.c0 * row.c0) + w1 * (row.c1 * row.c1) + w2 * (row.c2 * row.c2) + w3 * (row.c3 * row.c3) +
           w4 * (row.c4 * row.c4) + w5 * (row.c5 * row.c5);
}

WEFT_FN void project_stitch(inout_(vec3) x0, inout_(vec3) x1, inout_(vec3) x2, inout_(vec3) x3, inout_(vec3) x4,
                            inout_(vec3) x5, real w0, real w1, real w2, real w3, real w4, real w5,
                            inout_(real) lambda, StitchRow row, Step step)
{
    vec3 d = across_stitch(x0, x1, x2, x3, x4, x5, row);
    real len2 = dot(d, d);
    real len = sqrt(len2);
    real alpha = row.compliance * step.inv_h2;
    real w = stitch_weight(w0, w1, w2, w3, w4, w5, row);
    // All pinned: nothing to do. Coincident points: no direction to push in.
    mask able = w > real(0) && len2 > real(1e-20);
    real s = select(able, -(len - row.gap + alpha * lambda) / ((w + alpha) * len), real(0));   // delta lambda / |d|
    lambda = lambda + s * len;
    displace(x0, d * (w0 * row.c0 * s), step);
    displace(x1, d * (w1 * row.c1 * s), step);
    displace(x2, d * (w2 * row.c2 * s), step);
    displace(x3, d * (w3 * row.c3 * s), step);
    displace(x4, d * (w4 * row.c4 * s), step);
    displace(x5, d * (w5 * row.c5 * s), step);
}
