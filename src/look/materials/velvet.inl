// Upright hairs reflect sideways: the distribution of Ashikhmin and Premože 2007 ("Distribution-based BRDFs"), with
// intensity and width chosen by eye. The hairs are dyed through, so their reflection has their color.
{"velvet", "pile that stands up: bright toward the rim, dark where it is seen straight on",
 {.color = {0.11f, 0.003f, 0.010f}, .weft_color = {0.11f, 0.003f, 0.010f}, .specular = 0.45f, .sheen_color = {1.0f, 0.22f, 0.28f}, .velvet = 40, .velvet_alpha = 0.5f}},
