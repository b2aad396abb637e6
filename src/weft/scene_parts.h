// Parts of a scene by name and without their meshes, and errors at their places.
#pragma once

#include "scene/scene_desc.h"

#include <weft/result.h>

#include <algorithm>
#include <string>
#include <vector>

namespace weft {

/// Puts the place of an object before the places of its values.
Errors placed_at(const std::string& pointer, Errors errors);

/// Null if there is none.
template <class Named>
const Named* find_named(const std::vector<Named>& all, const std::string& name) {
    const auto it = std::ranges::find(all, name, &Named::name);
    return it != all.end() ? &*it : nullptr;
}

/// The parts of a cloth that can change while it moves. Avoids a copy of the meshes, which are large.
SceneCloth without_meshes(const SceneCloth& cloth);

}  // namespace weft
