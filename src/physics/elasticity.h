// Bounds on the distance between two particles; one-sided limits are computed from them.
#pragma once

#include "mesh/topology.h"
#include "physics/stretch/stretch.data.h"

#include <limits>

namespace weft {

/// How a fabric stretches under tension, as strain per N/m. All zeros: inextensible.
struct Elasticity {
    double warp = 0, weft = 0;  ///< along the threads
    double shear = 0;           ///< of the angle between them; infinite without shear stiffness
    /// N/m: three times the weight of a strip that hangs over the cloth's whole extent. Limits always leave room for
    /// this tension. Without that room they would take the load off the stretch constraints, from which the tension is
    /// measured.
    double tension = 0;
    /// N/m: the tension at `stretch_limit` without what stiffens the cloth before. Beyond it cloth is at least
    /// WEFT_STRAIGHT_STIFFNESS times as stiff, if both directions have a limit.
    double straight = std::numeric_limits<double>::infinity();

    /// The tension at which cloth without `stretch_limit` would give as much as this cloth does under this one, or a
    /// little more.
    double eased(double of) const;
    /// Strain per N/m along a direction at this cos² to the warp.
    double along(double cos2) const;
    /// Strain of the softer thread direction under `tension`.
    double reserve() const;
};

/// `extent`: m, of the cloth at rest.
Elasticity elasticity_of(const StretchMaterial& material, float density, float extent);
float extent_of(const Topology& topology);

/// With a larger reserve, limits are too long to have an effect. At half of it they still help: without limits, a soft
/// hanging cloth with few substeps stretches to ten times its length.
inline constexpr double useless_reserve = 2;

struct Limit {
    double length = 0;      ///< m, under `tension`
    double compliance = 0;  ///< additional length per additional tension, m per N/m
};

/// Limits the distance of two points at geodesic distance `length`, whose geodesic extends by `along_warp` and
/// `along_weft` (m) along the threads. Returns the smaller of two bounds: the elastic one, which includes shear, and
/// the sum along warp and weft, the most that threads can reach by rotating toward the pull.
Limit limit_along(const Elasticity& elasticity, double length, double along_warp, double along_weft);

/// The same for a geodesic of unknown direction.
Limit limit_any_way(const Elasticity& elasticity, double length);

}  // namespace weft
