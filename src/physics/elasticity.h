// How far apart two particles can come: the ground that one-sided limits stand on.
#pragma once

#include "mesh/topology.h"
#include "physics/stretch/stretch.data.h"

namespace weft {

/// What a fabric stretches by under a tension, as strain per N/m. All zeros: not at all.
struct Elasticity {
    double warp = 0, weft = 0;  ///< along the threads
    double shear = 0;           ///< of the angle between them; infinite where nothing holds it
    /// N/m: of three times the cloth's weight, hung over its whole extent. Limits leave room for that from the
    /// beginning. Without it they would take the load off the rows that tell how much there is.
    double tension = 0;

    /// Strain per N/m along a direction at this cos² to the warp.
    double along(double cos2) const;
    /// Strain of the softer threads under `tension`.
    double reserve() const;
};

/// `extent`: m, of the cloth at rest.
Elasticity elasticity_of(const StretchMaterial& material, float density, float extent);
float extent_of(const Topology& topology);

/// Beyond such a reserve limits let anything pass. Half of it is a help yet: without one, a soft cloth with few
/// substeps is left at ten times its length where it hangs.
inline constexpr double useless_reserve = 2;

struct Limit {
    double length = 0;  ///< m, under `tension`
    double give = 0;    ///< m more for every N/m more
};

/// Of two places that are `length` apart over the cloth, on a way that goes so far along the warp and the weft, m.
/// Where the fabric shears, threads that turn toward the pull let it go farther than its elasticity tells, but no
/// farther than along the one and then along the other.
Limit limit_along(const Elasticity& elasticity, double length, double along_warp, double along_weft);

/// The same where nobody knows how the way runs.
Limit limit_any_way(const Elasticity& elasticity, double length);

}  // namespace weft
