// Habotai of 8 momme, some 150 threads an inch of filaments without twist or ends. Warp and weft are alike, so the
// highlight is nearly round; it is the fibers' smoothness that makes it small.
{"silk", "habotai: light, smooth filaments in plain weave, a soft shine",
 {.color = {0.55f, 0.05f, 0.09f}, .weft_color = {0.55f, 0.05f, 0.09f}, .roughness_matte = 0.2f, .specular = 0.06f, .roughness = {0.3f, 0.38f}, .transmission = 0.12f, .weave = Weave::plain, .thread = 0.17f, .relief = 0.35f}},
