// Coarse distance limit: C = |a - b| - (limit + compliance tension + give) allowed <= 0. Beyond the limit it is as elastic
// as the cloth. One-sided, so not damped.

struct CoarseLimitRow { WEFT_ROW_coarse_limit(WEFT_ROW_MEMBER) };

WEFT_FN void project_coarse_limit(inout_(vec3) a, inout_(vec3) b, real wa, real wb,
                           inout_(real) lambda, CoarseLimitRow row, Step step)
{
    vec3 d = a - b;
    real len2 = dot(d, d);
    real w = wa + wb;
    real give = row.give / (real(1) + row.ease * step.h * step.h);
    real limit = (row.limit + row.compliance * step.tension + give) * step.allowed;
    real len = sqrt(max(len2, real(1e-20)));
    // A constraint represents a strip as wide as it is long.
    real alpha = row.compliance / max(row.limit, real(1e-20)) * step.inv_h2;
    real next = min(lambda - (len - limit + alpha * lambda) / max(w + alpha, real(1e-30)), real(0));
    mask able = len2 > real(1e-20) && w > real(0);
    real s = select(able, (next - lambda) / len, real(0));
    lambda = lambda + s * len;
    displace(a, d * (wa * s), step);
    displace(b, d * -(wb * s), step);
}
