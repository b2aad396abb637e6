// Hairs that stand up mirror sideways: the distribution of Ashikhmin and Premože 2007 ("Distribution-based BRDFs"),
// strength and width chosen by eye.
{"velvet", "pile that stands up: bright toward the rim, dark where it is seen straight on",
 {.color = {0.25f, 0.01f, 0.025f}, .weft_color = {0.25f, 0.01f, 0.025f}, .specular = 0.04f, .velvet = 4, .velvet_alpha = 0.3f}},
