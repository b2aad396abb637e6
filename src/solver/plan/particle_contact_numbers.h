// Numbers of contact between particles, shared by all backends.
#pragma once

#include "collide/uneven_thickness.h"
#include "solver/model/cloth_model.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace weft {

/// Diameter of a particle in mean edges. With 1, edges pass between particles.
inline constexpr float particle_diameter_in_edges = 1.4f;
/// Two particles of one cloth keep at most this part of their distance at rest, or that distance less so many mean
/// edges, whichever is larger. The second is more than the margin, so lists of flat cloth are empty.
inline constexpr float particle_part_at_rest = 0.5f, particle_edges_less_at_rest = 0.45f;

/// One sweep of pushes over all pairs that overlap.
struct ParticleSweep {
    float deep;            ///< in diameters: only pairs nearer than this are pushed
    float recovery_speed;  ///< m/s at which an overlap from before the substep is removed at most
    float split;           ///< part of the mass splitting: in full, folded cloth is pushed apart too slowly
};
/// The sweeps of a substep. The first one alone acts on cloth at rest, and is slow enough not to move it. The others
/// act where cloth collides fast. They move particles farther than the first one, except for the last: it leaves less
/// overlap behind.
inline constexpr std::array<ParticleSweep, 4> particle_sweeps{{
    {.deep = 1, .recovery_speed = 1, .split = 0.35f},
    {.deep = 0.8f, .recovery_speed = 4, .split = 0.2f},
    {.deep = 0.8f, .recovery_speed = 4, .split = 0.2f},
    {.deep = 0.8f, .recovery_speed = 4, .split = 0.6f},
}};

/// m, of the largest particle; a pair has the mean of both. Where the thickness asks for more than the edges, that
/// wins.
inline float particle_diameter(const ClothModel& model) {
    return std::max(particle_diameter_in_edges * model.mean_edge,
                    model.fabric.contact.thickness * model.thickness_range[1]);
}
/// The same of every particle, if they differ.
inline UnevenThickness uneven_diameters(const ClothModel& model) {
    if (model.thickness_factors.empty()) return {};
    return {model.thickness_factors.data(), model.fabric.contact.thickness,
            particle_diameter_in_edges * model.mean_edge};
}
/// m, see particle_part_at_rest.
inline float particle_less_at_rest(const ClothModel& model) {
    return particle_edges_less_at_rest * model.mean_edge;
}
/// How much farther than their diameter listed pairs may be apart, m. Less than what neighbors on flat cloth are
/// farther apart than their diameter, so that its lists are empty.
inline float particle_margin(const ClothModel& model) {
    return 0.3f * model.mean_edge;
}

}  // namespace weft
