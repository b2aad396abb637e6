{"silk", "habotai: smooth filaments in plain weave, a highlight along each direction",
 {.color = {0.55f, 0.05f, 0.09f}, .weft_color = {0.55f, 0.05f, 0.09f}, .specular = 0.08f, .roughness = {0.28f, 0.5f}, .transmission = 0.1f, .weave = Weave::plain, .thread = 0.12f, .relief = 0.4f}},
