// DistanceBend: moves the tips of two triangles toward their rest distance. C = |c - d| - rest: a stretch constraint
// between them.

struct DistanceBendRow { WEFT_ROW_distance_bend(WEFT_ROW_MEMBER) };

WEFT_FN StretchRow between_tips(DistanceBendRow row)
{
    StretchRow between;
    between.rest = row.rest;
    between.compliance = row.compliance;
    between.compression = row.compliance;
    between.play = real(WEFT_NEVER_STRAIGHT);
    return between;
}

WEFT_FN void project_distance_bend(inout_(vec3) c, inout_(vec3) d, real wc, real wd,
                             inout_(real) lambda, DistanceBendRow row, Step step)
{
    project_stretch(c, d, wc, wd, lambda, between_tips(row), step);
}

WEFT_FN void damp_distance_bend(inout_(vec3) vc, inout_(vec3) vd, vec3 c, vec3 d, real wc, real wd,
                          DistanceBendRow row, real viscous)
{
    damp_stretch(vc, vd, c, d, wc, wd, between_tips(row), viscous);
}
