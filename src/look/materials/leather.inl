// Vegetable-tanned and finished: a thin coat of index 1.5 covers the pigment and creases around grains of a millimeter.
{"leather", "tanned hide: grain of a millimeter under a thin coat",
 {.color = {0.18f, 0.066f, 0.026f}, .weft_color = {0.18f, 0.066f, 0.026f}, .diffuse_roughness = 0.2f, .specular = 0.045f, .roughness = {0.42f, 0.42f}, .weave = Weave::grain, .thread_spacing = 1.1f, .weave_depth = 0.45f}},
