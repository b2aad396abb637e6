// Moment: turns two triangles toward their rest angle, which moves with the moments across the other edges of both.
//
//        c
//       / \        triangles (a, b, c) and (b, a, d)
//      a---b       theta > 0 when c and d rise toward the side that the normals point to
//       \ /
//        d

struct MomentRow { WEFT_ROW_moment(WEFT_ROW_MEMBER) };

// A triangle that is pinned by all its corners does not bend.
WEFT_FN real bending_part(real wa, real wb, real w_tip)
{
    return select(wa + wb + w_tip > real(0), real(1), real(0));
}

WEFT_FN void project_moment(inout_(vec3) a, inout_(vec3) b, inout_(vec3) c, inout_(vec3) d,
                            real wa, real wb, real wc, real wd,
                            inout_(real) lambda, MomentRow row, Step step)
{
    BendRow hinge;
    real part_c = bending_part(wa, wb, wc);
    real part_d = bending_part(wa, wb, wd);
    hinge.rest = row.rest + (step.shift_c * part_c + step.shift_d * part_d);
    hinge.compliance = row.compliance_c * part_c + row.compliance_d * part_d;
    project_bend(a, b, c, d, wa, wb, wc, wd, lambda, hinge, step);
}

WEFT_FN void damp_moment(inout_(vec3) va, inout_(vec3) vb, inout_(vec3) vc, inout_(vec3) vd,
                         vec3 a, vec3 b, vec3 c, vec3 d, real wa, real wb, real wc, real wd,
                         MomentRow row, real viscous)
{
    BendRow hinge;
    hinge.rest = row.rest;
    hinge.compliance = row.total;
    damp_bend(va, vb, vc, vd, a, b, c, d, wa, wb, wc, wd, hinge, viscous);
}

// The next shift of the rest angle by one of the triangles. `moment`: -lambda/h2, N m, of the constraint and of those across
// the other two edges of the triangle. The compliances by them are in 1/(N m). `rate`: part of its way that the shift goes.
WEFT_FN real shift_moment(real shift, real moment, real moment_0, real moment_1, real own, real by_0, real by_1, real rate)
{
    return shift + rate * (own * moment + by_0 * moment_0 + by_1 * moment_1 - shift);
}
