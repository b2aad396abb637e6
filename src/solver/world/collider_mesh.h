// Meshes and bounds of colliders.
#pragma once

#include "solver/world/collider.h"

#include <weft/bounds.h>
#include <weft/mesh.h>

namespace weft {

/// In the collider's own frame, with normals; empty for a plane, which is unbounded.
TriangleMesh mesh_of(const Collider& collider);

/// In world space, at the current pose; empty for a plane.
Bounds bounds_of(const Collider& collider);

}  // namespace weft
