// The part of a scene file that is about pictures.
#pragma once

#include "io/scenes/json_reader.h"
#include "scene/scene_desc.h"

namespace weft {

/// `camera`, `light` and `look`. Cloths and colliders have been read: how they look begins with what they are.
void read_pictures(ObjectReader& o, SceneDesc& scene);

}  // namespace weft
