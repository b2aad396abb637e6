// Where cloth touches colliders, from the contacts that a frame has recorded.
#pragma once

#include "view/world_frame.h"

#include <vector>

namespace weft {

/// A point of a cloth that touches a collider.
struct Touch {
    Vec3 point;            ///< m, at the end of the frame
    Vec3 impulse;          ///< N·s, on the cloth, summed over the frame
    bool of_face = false;  ///< within a triangle or on its edge; otherwise a particle
};

/// Records of contacts name particles only (Contact): what a triangle is pushed by is divided among its corners. A
/// corner that does not touch the collider itself was pushed by triangles. Its impulse moves to the nearest points of
/// those triangles around it that touch, in equal parts; the sum of all impulses stays. If none of them touches at the
/// end of the frame any more, the impulse stays at the particle.
///
/// Empty if the world has no contacts of this frame.
std::vector<Touch> touches_of(const WorldFrame& world, const Frame& frame);

/// Whether the world has the contacts of this frame.
bool has_contacts_of(const WorldFrame& world, const Frame& frame);

}  // namespace weft
