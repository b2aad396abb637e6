// For colliders: a mid gray that contrasts with cloth of any color. The values are chosen, not measured.
{"matte", "plain and matte, for what is no cloth",
 {.color = {0.55f, 0.55f, 0.56f}, .weft_color = {0.55f, 0.55f, 0.56f}, .diffuse_roughness = 0.3f, .roughness = {0.7f, 0.7f}}},
