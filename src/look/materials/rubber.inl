// Latex sheet with carbon black: it scatters light only at the surface, index 1.52.
{"rubber", "black latex sheet: smooth, a broad highlight",
 {.color = {0.022f, 0.022f, 0.024f}, .weft_color = {0.022f, 0.022f, 0.024f}, .specular = 0.043f, .roughness = {0.42f, 0.42f}}},
