// 12 oz, 3/1: indigo coats the outside of the warp alone, the weft is raw cotton, grayed by what
// rubs off. 62 threads an inch, hard and rough.
{"denim", "jeans: indigo warp over raw weft in 3/1 twill",
 {.color = {0.020f, 0.047f, 0.14f}, .weft_color = {0.40f, 0.41f, 0.42f}, .roughness_matte = 0.7f, .roughness = {0.7f, 0.75f}, .sheen_color = {0.03f, 0.035f, 0.045f}, .sheen_roughness = 0.5f, .weave = Weave::twill, .thread = 0.41f, .relief = 1.1f}},
