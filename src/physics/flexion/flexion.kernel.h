// Flexion: moves the tips of two triangles toward their rest distance. C = |c - d| - rest: a row of stretch between them.

struct FlexionRow { WEFT_ROW_flexion(WEFT_ROW_MEMBER) };

WEFT_FN StretchRow between_tips(FlexionRow row)
{
    StretchRow between;
    between.rest = row.rest;
    between.compliance = row.compliance;
    between.compression = row.compliance;
    return between;
}

WEFT_FN void project_flexion(inout_(vec3) c, inout_(vec3) d, real wc, real wd,
                             inout_(real) lambda, FlexionRow row, Step step)
{
    project_stretch(c, d, wc, wd, lambda, between_tips(row), step);
}

WEFT_FN void damp_flexion(inout_(vec3) vc, inout_(vec3) vd, vec3 c, vec3 d, real wc, real wd,
                          FlexionRow row, real viscous)
{
    damp_stretch(vc, vd, c, d, wc, wd, between_tips(row), viscous);
}
