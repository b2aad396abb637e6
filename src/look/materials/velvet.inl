{"velvet", "pile that stands up: bright toward the rim, dark where it is seen straight on",
 {.color = {0.25f, 0.01f, 0.025f}, .weft_color = {0.25f, 0.01f, 0.025f}, .specular = 0.04f, .velvet = 4, .velvet_alpha = 0.3f}},
