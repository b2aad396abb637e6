// A sweater's 2x2 rib, 14 wales per inch of soft wool.
{"ribknit", "sweater: 2x2 rib of soft yarn",
 {.color = {0.50f, 0.28f, 0.07f}, .weft_color = {0.50f, 0.28f, 0.07f}, .diffuse_roughness = 0.8f, .roughness = {0.8f, 0.8f}, .sheen_color = {0.12f, 0.10f, 0.07f}, .sheen_roughness = 0.5f, .transmission = 0.05f, .weave = Weave::rib, .thread_spacing = 1.8f}},
