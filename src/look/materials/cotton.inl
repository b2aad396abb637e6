// Bleached poplin, unbleached enough to be no pure white: 80 threads an inch of short fibers that stand off a little.
{"cotton", "shirting: staple fibers, matte, a little fuzz",
 {.color = {0.78f, 0.76f, 0.72f}, .weft_color = {0.78f, 0.76f, 0.72f}, .roughness_matte = 0.6f, .roughness = {0.7f, 0.75f}, .sheen_color = {0.05f, 0.05f, 0.05f}, .sheen_roughness = 0.6f, .transmission = 0.15f, .weave = Weave::plain, .thread = 0.32f}},
