// Tether: C = |x - anchor| - (radius + compliance tension) allowed <= 0. Only the particle moves; the anchor is pinned.
// One-sided, so not damped.

struct TetherRow { WEFT_ROW_tether(WEFT_ROW_MEMBER) };

WEFT_FN void project_tether(inout_(vec3) x, inout_(vec3) anchor, real w, real anchor_w,
                            inout_(real) lambda, TetherRow row, Step step)
{
    vec3 d = x - anchor;
    real len2 = dot(d, d);
    real radius = (row.radius + row.compliance * step.tension) * step.allowed;
    mask taut = len2 > radius * radius && w > real(0);
    real len = sqrt(max(len2, real(1e-30)));
    real c = select(taut, len - radius, real(0));
    lambda = lambda - c / max(w, real(1e-30));
    displace(x, d * -(c / len), step);
}
