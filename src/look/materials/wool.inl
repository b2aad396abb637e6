// Charcoal flannel: napped 2/2 and 3/1 twills look alike, so the 3/1 twill of the weaves is used for both. The sheen
// models the nap, which hides most of the weave.
{"wool", "flannel: napped twill of a dark melange, soft at the rim",
 {.color = {0.075f, 0.078f, 0.09f}, .weft_color = {0.12f, 0.12f, 0.13f}, .diffuse_roughness = 0.8f, .roughness = {0.8f, 0.85f}, .sheen_color = {0.10f, 0.10f, 0.11f}, .sheen_roughness = 0.45f, .transmission = 0.03f, .weave = Weave::twill, .thread_spacing = 0.55f, .weave_depth = 0.7f}},
