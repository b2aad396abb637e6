// Charmeuse: floats of the warp, 250 threads an inch, lie over everything. Filaments in parallel mirror as brushed metal
// does, narrow along them and wide across (Irawan and Marschner 2012 show it of silk charmeuse); numbers by eye.
{"satin", "charmeuse: long floats of silk, a highlight that is stretched across the warp",
 {.color = {0.62f, 0.50f, 0.36f}, .weft_color = {0.50f, 0.40f, 0.29f}, .roughness_matte = 0.1f, .specular = 0.09f, .roughness = {0.2f, 0.52f}, .transmission = 0.06f, .weave = Weave::satin, .thread = 0.1f, .relief = 0.3f}},
