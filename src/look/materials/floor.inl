// For the ground: a warm light gray like seamless paper in a photographer's studio, with hardly a highlight.
{"floor", "studio paper: light, warm, without a highlight",
 {.color = {0.47f, 0.465f, 0.46f}, .weft_color = {0.47f, 0.465f, 0.46f}, .roughness_matte = 0.5f, .specular = 0.02f, .roughness = {0.85f, 0.85f}}},
