// 12 oz, 3/1: indigo coats the outside of the warp alone, the weft is raw cotton. 62 threads an inch, hard and rough.
{"denim", "jeans: indigo warp over raw weft in 3/1 twill",
 {.color = {0.028f, 0.052f, 0.13f}, .weft_color = {0.62f, 0.60f, 0.54f}, .roughness_matte = 0.7f, .roughness = {0.7f, 0.75f}, .sheen_color = {0.03f, 0.035f, 0.045f}, .sheen_roughness = 0.5f, .weave = Weave::twill, .thread = 0.41f, .relief = 1.1f}},
