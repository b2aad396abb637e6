// Fibers in all directions, no thread: a shallow grain of half a millimeter stands for where they mat, sheen for ends.
{"felt", "matted fibers: no thread, all fuzz",
 {.color = {0.055f, 0.16f, 0.085f}, .weft_color = {0.055f, 0.16f, 0.085f}, .roughness_matte = 1.0f, .roughness = {0.95f, 0.95f}, .sheen_color = {0.09f, 0.12f, 0.10f}, .sheen_roughness = 0.7f, .weave = Weave::grain, .thread = 0.5f, .relief = 0.5f}},
