// Fibers in all directions, no threads: a shallow grain of half a millimeter models the matting, sheen the fiber ends.
{"felt", "matted fibers: no thread, all fuzz",
 {.color = {0.055f, 0.16f, 0.085f}, .weft_color = {0.055f, 0.16f, 0.085f}, .diffuse_roughness = 1.0f, .roughness = {0.95f, 0.95f}, .sheen_color = {0.09f, 0.12f, 0.10f}, .sheen_roughness = 0.7f, .weave = Weave::grain, .thread_spacing = 0.5f, .weave_depth = 0.5f}},
