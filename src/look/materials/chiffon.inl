// Silk chiffon: fine, hard-twisted threads with gaps as wide as the threads. Half of the light passes through the gaps.
{"chiffon", "sheer plain weave of hard-twisted threads: half of it is holes",
 {.color = {0.80f, 0.52f, 0.50f}, .weft_color = {0.80f, 0.52f, 0.50f}, .diffuse_roughness = 0.3f, .roughness = {0.45f, 0.5f}, .transmission = 0.4f, .coverage = 0.5f, .weave = Weave::plain, .thread_spacing = 0.26f, .weave_depth = 0.6f}},
