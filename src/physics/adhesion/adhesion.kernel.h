// Adhesion: an attachment to a point that moves with a collider.

struct AdhesionRow { WEFT_ROW_adhesion(WEFT_ROW_MEMBER) };

// `gap`: distance between the surfaces of cloth and collider at the start of the frame, m.
WEFT_FN mask adheres(real gap, real range, real w) { return w > real(0) && gap < range; }

WEFT_FN void project_adhesion(inout_(vec3) x, real w, inout_(real) lambda, AdhesionRow row, Step step)
{
    vec3 target = vec3(row.target_x, row.target_y, row.target_z);
    AttachmentRow spring;
    spring.compliance = row.compliance;
    project_attachment(x, target, w, real(0), lambda, spring, step);
}
