// Attachment: C = |x - anchor|. The anchor's motion is prescribed, and its inverse mass 0, or it is a point of a body.

struct AttachmentRow { WEFT_ROW_attachment(WEFT_ROW_MEMBER) };

WEFT_FN void project_attachment(inout_(vec3) x, inout_(vec3) anchor, real w, real anchor_w,
                                inout_(real) lambda, AttachmentRow row, Step step)
{
    vec3 d = x - anchor;
    real len2 = dot(d, d);
    real len = sqrt(len2);
    real alpha = row.compliance * step.inv_h2;
    mask able = w > real(0) && len2 > real(1e-20);
    real s = select(able, -(len + alpha * lambda) / ((w + anchor_w + alpha) * len), real(0));  // delta lambda / |d|
    lambda = lambda + s * len;
    displace(x, d * (w * s), step);
    displace(anchor, select(anchor_w > real(0), d * -(anchor_w * s), vec3(real(-0.0))), step);   // -0 changes no bit
}
