// Charcoal flannel: 2/2 and 3/1 twills look alike once they are napped, so the twill that there is stands for both. The
// nap is the sheen; it hides most of the relief.
{"wool", "flannel: napped twill of a dark melange, soft at the rim",
 {.color = {0.075f, 0.078f, 0.09f}, .weft_color = {0.12f, 0.12f, 0.13f}, .roughness_matte = 0.8f, .roughness = {0.8f, 0.85f}, .sheen_color = {0.10f, 0.10f, 0.11f}, .sheen_roughness = 0.45f, .transmission = 0.03f, .weave = Weave::twill, .thread = 0.55f, .relief = 0.7f}},
