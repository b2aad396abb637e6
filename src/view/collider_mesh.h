// What a collider looks like.
#pragma once

#include "solver/world/collider.h"

#include <weft/bounds.h>
#include <weft/mesh.h>

namespace weft {

/// In the collider's own frame, with normals; empty for a plane, which has no end.
TriangleMesh mesh_of(const Collider& collider);

/// In the world, where it is now; empty for a plane.
Bounds bounds_of(const Collider& collider);

}  // namespace weft
