// Numbers of contact between particles, shared by all backends.
#pragma once

#include "solver/model/cloth_model.h"

#include <algorithm>
#include <cstdint>

namespace weft {

// A substep has one sweep of pushes. A second one costs as much as the first and leaves no fewer crossings.

/// Diameter of a particle in mean edges. With 1, edges pass between particles.
inline constexpr float particle_diameter_in_edges = 1.4f;
/// Part of their distance at rest that two particles of one cloth keep at most. More hinders bending, and lists of
/// pairs would hold all neighbors.
inline constexpr float particle_part_at_rest = 0.5f;
/// m/s at which an overlap from before the substep is removed at most.
inline constexpr float particle_recovery_speed = 1;
/// Part of the mass splitting that a push uses. In full, folded cloth is pushed apart too slowly and crosses itself.
inline constexpr float particle_split = 0.35f;

/// m. Where the fabric's thickness asks for more, that wins.
inline float particle_diameter(const ClothModel& model) {
    return std::max(particle_diameter_in_edges * model.mean_edge, model.fabric.contact.thickness);
}
/// How much farther than their diameter listed pairs may be apart, m. Less than half of an edge, so that lists of a
/// flat cloth are empty: its neighbors keep half of their distance at rest.
inline float particle_margin(const ClothModel& model) {
    return 0.45f * model.mean_edge;
}

}  // namespace weft
