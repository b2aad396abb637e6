// Charmeuse: floats of the warp, 250 threads per inch, cover the surface. Parallel filaments reflect as brushed metal
// does: the highlight is narrow along them and wide across (Irawan and Marschner 2012 show this for silk charmeuse).
// The values are chosen by eye.
{"satin", "charmeuse: long floats of silk, a highlight that is stretched across the warp",
 {.color = {0.62f, 0.50f, 0.36f}, .weft_color = {0.50f, 0.40f, 0.29f}, .diffuse_roughness = 0.1f, .specular = 0.09f, .roughness = {0.2f, 0.52f}, .transmission = 0.06f, .weave = Weave::satin, .thread_spacing = 0.1f, .weave_depth = 0.3f}},
