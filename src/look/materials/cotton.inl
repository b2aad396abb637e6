// Poplin, not bleached to pure white: 80 threads per inch of short fibers, some of which stand off the surface.
{"cotton", "shirting: staple fibers, matte, a little fuzz",
 {.color = {0.78f, 0.76f, 0.72f}, .weft_color = {0.78f, 0.76f, 0.72f}, .diffuse_roughness = 0.6f, .roughness = {0.7f, 0.75f}, .sheen_color = {0.05f, 0.05f, 0.05f}, .sheen_roughness = 0.6f, .transmission = 0.15f, .weave = Weave::plain, .thread_spacing = 0.32f}},
