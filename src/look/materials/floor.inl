// For the ground: a warm light gray like seamless paper in a photo studio, with almost no highlight.
{"floor", "studio paper: light, warm, without a highlight",
 {.color = {0.47f, 0.465f, 0.46f}, .weft_color = {0.47f, 0.465f, 0.46f}, .diffuse_roughness = 0.5f, .specular = 0.02f, .roughness = {0.85f, 0.85f}}},
