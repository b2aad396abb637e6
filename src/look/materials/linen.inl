// Natural flax: 40 visible threads per inch, stiffer and smoother than cotton, with a dull luster and no fuzz.
{"linen", "natural flax: coarse plain weave, threads that one sees, a dull luster",
 {.color = {0.56f, 0.47f, 0.34f}, .weft_color = {0.61f, 0.53f, 0.41f}, .diffuse_roughness = 0.5f, .specular = 0.045f, .roughness = {0.5f, 0.6f}, .transmission = 0.12f, .weave = Weave::plain, .thread_spacing = 0.62f, .weave_depth = 1.2f}},
