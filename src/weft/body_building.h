// Gives colliders what bodies need: their mass, and the parts that touch bodies first.
#pragma once

#include "solver/world/collider.h"

#include <weft/result.h>
#include <weft/scene.h>

#include <span>
#include <string>
#include <vector>

namespace weft {

/// Adds the body of the description, if it has one, and the features of a mesh to a collider made from it.
///
/// A mesh that is a body has the features of its convex hull. A mesh that keys move has the hull's points alone, which
/// lie on the mesh: the hull's edges may not. A mesh at rest has none.
///
/// `others`: a collider among them with the same shape and mass lends its own, which take long to compute for large
/// meshes. `pointer`: the place of the collider in errors. Appends one line per warning to `notes`.
Result<void> add_body(Collider& collider, const ColliderDesc& desc, std::span<const Collider> others,
                      const std::string& pointer, std::vector<std::string>& notes);

}  // namespace weft
