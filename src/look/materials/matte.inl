// For colliders: a gray in the middle, so that cloth of any color stands off it; chosen, nothing measured.
{"matte", "plain and matte, for what is no cloth",
 {.color = {0.55f, 0.55f, 0.56f}, .weft_color = {0.55f, 0.55f, 0.56f}, .roughness_matte = 0.3f, .roughness = {0.7f, 0.7f}}},
