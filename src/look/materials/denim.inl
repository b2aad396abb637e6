// 12 oz, 3/1 twill: indigo coats only the outside of the warp. The weft is raw cotton, grayed by indigo that rubs off.
// 62 threads per inch, hard and rough.
{"denim", "jeans: indigo warp over raw weft in 3/1 twill",
 {.color = {0.020f, 0.047f, 0.14f}, .weft_color = {0.40f, 0.41f, 0.42f}, .diffuse_roughness = 0.7f, .roughness = {0.7f, 0.75f}, .sheen_color = {0.03f, 0.035f, 0.045f}, .sheen_roughness = 0.5f, .weave = Weave::twill, .thread_spacing = 0.41f, .weave_depth = 1.1f}},
