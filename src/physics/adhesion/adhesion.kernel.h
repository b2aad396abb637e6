// Adhesion: C = |x - target|, where the target is a point that a collider carries along.

struct AdhesionRow { WEFT_ROW_adhesion(WEFT_ROW_MEMBER) };

// `gap`: distance between the surfaces of cloth and collider where the frame begins, m.
WEFT_FN mask adheres(real gap, real range, real w) { return w > real(0) && gap < range; }

WEFT_FN void project_adhesion(inout_(vec3) x, real w, inout_(real) lambda, AdhesionRow row, Step step)
{
    vec3 d = x - vec3(row.target_x, row.target_y, row.target_z);
    real len2 = dot(d, d);
    real len = sqrt(len2);
    real alpha = row.compliance * step.inv_h2;
    mask able = w > real(0) && len2 > real(1e-20);
    real s = select(able, -(len + alpha * lambda) / ((w + alpha) * len), real(0));   // delta lambda / |d|
    lambda = lambda + s * len;
    x = x + d * (w * s);
}
