// Reach: C = |a - b| - (limit + give tension) allowed, at most 0; beyond it as elastic as the cloth is.
// One-sided, so not damped.

struct ReachRow { WEFT_ROW_reach(WEFT_ROW_MEMBER) };

WEFT_FN void project_reach(inout_(vec3) a, inout_(vec3) b, real wa, real wb,
                           inout_(real) lambda, ReachRow row, Step step)
{
    vec3 d = a - b;
    real len2 = dot(d, d);
    real w = wa + wb;
    real limit = (row.limit + row.give * step.tension) * step.allowed;
    real len = sqrt(max(len2, real(1e-20)));
    // A row stands for a strip as wide as it is long.
    real alpha = row.give / max(row.limit, real(1e-20)) * step.inv_h2;
    real next = min(lambda - (len - limit + alpha * lambda) / max(w + alpha, real(1e-30)), real(0));
    mask able = len2 > real(1e-20) && w > real(0);
    real s = select(able, (next - lambda) / len, real(0));
    lambda = lambda + s * len;
    a = a + d * (wa * s);
    b = b - d * (wb * s);
}
