// Silk chiffon: fine threads, hard-twisted, as far apart as they are thick. Half of the light goes between them.
{"chiffon", "sheer plain weave of hard-twisted threads: half of it is holes",
 {.color = {0.80f, 0.52f, 0.50f}, .weft_color = {0.80f, 0.52f, 0.50f}, .roughness_matte = 0.3f, .roughness = {0.45f, 0.5f}, .transmission = 0.4f, .coverage = 0.5f, .weave = Weave::plain, .thread = 0.26f, .relief = 0.6f}},
