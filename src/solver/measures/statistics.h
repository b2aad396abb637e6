// What can be measured in a frame. Double precision, outside the step, single-threaded.
#pragma once

#include "solver/measures/measures.h"
#include "solver/state/frame.h"
#include "solver/world/collider.h"

#include <cstdint>
#include <span>

namespace weft {

/// Everything but the residual; what World::measure() finds without bringing the cloth to the host.
ClothMeasures measure(const Frame& frame);
/// Of these:
Strain measure_strain(const Frame& frame);
double kinetic_energy(const Frame& frame);
double max_speed(const Frame& frame);
bool all_finite(const Frame& frame);

/// How far cloth reaches beyond the colliders' true surfaces (thickness set aside), sampled at the corners, the middles
/// of the sides and the center of every triangle. A particle that has tunneled deep inside counts with its full depth.
struct Penetration {
    double max = 0;           ///< m
    std::uint64_t count = 0;  ///< triangles with a sample more than 1 µm inside
};
Penetration measure_penetration(const Frame& frame, std::span<const Collider> colliders);

/// Crossing pairs within and between all cloths.
struct Intersections {
    std::uint64_t triangles = 0;  ///< pairs of triangles
    std::uint64_t edges = 0;      ///< pairs of an edge and a triangle
};
Intersections count_intersections(const Frame& frame);

/// Mean displacement of the particles from one set of positions to another, m.
double mean_displacement(std::span<const Vec3> from, std::span<const Vec3> to);

/// The positions of all particles of all cloths, one after another.
void collect_positions(const Frame& frame, std::vector<Vec3>& out);

}  // namespace weft
