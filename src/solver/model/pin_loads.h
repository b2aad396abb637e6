// The load of cloth near pins (law: physics/pin_load/pin_load.md). Cloth that hangs by a pin carries its weight through
// the few threads that end there, so the tension near the pin is many times that of the rest of the cloth.
#pragma once

#include "physics/elasticity.h"
#include "solver/model/link_graph.h"

#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// Per particle. Zero where no pin bears much.
struct PinLoads {
    std::vector<double> steadiness;  ///< 1/s²: times h², how many times its mass is added to the particle
    std::vector<double> give;        ///< m: how much farther from its pin the cloth lets it be
    std::vector<double> ease;        ///< 1/s²: divides `give` by 1 + ease h²
    std::vector<std::uint32_t> pin;  ///< the nearest pinned particle along the cloth; itself if there is none
    std::vector<std::uint32_t>
        group;  ///< number of its group of pins: those that share an edge; `none` if there is none

    bool empty() const { return steadiness.empty(); }
};

/// Pinned particles that are connected by edges (physics/tether/pinned_places.h).
using PinGroups = std::vector<std::vector<std::uint32_t>>;

/// Static estimate: each particle hangs by the group of pins that is nearest to it. Empty if no group bears much more
/// than a sheet that hangs by a whole side, and for inextensible cloth. `mass`: kg per particle, 0 for pinned ones.
/// `density`: kg/m². `extent`: m, of the cloth at rest.
PinLoads find_pin_loads(const LinkGraph& edges, const PinGroups& groups, std::span<const double> mass, double density,
                        double extent, const Elasticity& elasticity);

}  // namespace weft
