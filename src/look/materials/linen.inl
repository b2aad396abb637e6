// Natural flax, 40 threads an inch, of which one sees each: stiffer and smoother than cotton, a dull luster, no fuzz.
{"linen", "natural flax: coarse plain weave, threads that one sees, a dull luster",
 {.color = {0.56f, 0.47f, 0.34f}, .weft_color = {0.61f, 0.53f, 0.41f}, .roughness_matte = 0.5f, .specular = 0.045f, .roughness = {0.5f, 0.6f}, .transmission = 0.12f, .weave = Weave::plain, .thread = 0.62f, .relief = 1.2f}},
