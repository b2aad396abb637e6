// Habotai of 8 momme, about 150 threads per inch of filaments without twist or ends. Warp and weft are alike, so the
// highlight is nearly round. It is small because the fibers are smooth.
{"silk", "habotai: light, smooth filaments in plain weave, a soft shine",
 {.color = {0.55f, 0.05f, 0.09f}, .weft_color = {0.55f, 0.05f, 0.09f}, .diffuse_roughness = 0.2f, .specular = 0.06f, .roughness = {0.3f, 0.38f}, .transmission = 0.12f, .weave = Weave::plain, .thread_spacing = 0.17f, .weave_depth = 0.35f}},
