// A T-shirt of single jersey in gray melange, 34 wales per inch.
{"jersey", "T-shirt: fine single jersey of gray melange",
 {.color = {0.36f, 0.37f, 0.39f}, .weft_color = {0.36f, 0.37f, 0.39f}, .diffuse_roughness = 0.7f, .roughness = {0.75f, 0.75f}, .sheen_color = {0.07f, 0.07f, 0.07f}, .sheen_roughness = 0.5f, .transmission = 0.12f, .weave = Weave::knit, .thread_spacing = 0.75f}},
