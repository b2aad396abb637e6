// Measures of a frame, computed in double precision on the calling thread, outside the step.
#pragma once

#include "collide/sheet_order.h"
#include "solver/measures/measures.h"
#include "solver/measures/penetration.h"
#include "solver/state/frame.h"
#include "solver/world/collider.h"

#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// Everything but the residual. World::measure() computes the same without copying the cloth to the host.
ClothMeasures measure(const Frame& frame);
/// Parts of measure():
Strain measure_strain(const Frame& frame);
double kinetic_energy(const Frame& frame);
double max_speed(const Frame& frame);
bool all_finite(const Frame& frame);

/// PenetrationSearch, without keeping the search trees of meshes.
Penetration measure_penetration(const Frame& frame, std::span<const Collider> colliders);

/// Numbers of crossing pairs, within and between all cloths, and of cloths with the surfaces that they meet
/// (Collider::surface).
struct Intersections {
    std::uint64_t triangles = 0;  ///< pairs of triangles
    std::uint64_t edges = 0;      ///< pairs of an edge and a triangle
};
Intersections count_intersections(const Frame& frame, std::span<const Collider> colliders = {});

/// The cloths of a frame as sheets, for SheetOrder.
std::vector<SheetPose> sheet_poses(const Frame& frame);
/// How far sheets that lie on each other may be apart, m: twice the longest mean edge of any cloth, and its thickness.
double stack_distance(const Frame& frame);

/// Mean distance between corresponding positions, m.
double mean_displacement(std::span<const Vec3> from, std::span<const Vec3> to);

/// The positions of the particles in a frame, by cloth.
using Positions = std::vector<std::vector<Vec3>>;
Positions positions_of(const Frame& frame);

/// Mean distance of all particles from their positions in an earlier frame, m. A particle that was appended since then
/// was where its original was.
double mean_displacement(const Positions& from, const Frame& to);

/// The positions of all particles of all cloths, one after another.
void collect_positions(const Frame& frame, std::vector<Vec3>& out);

}  // namespace weft
