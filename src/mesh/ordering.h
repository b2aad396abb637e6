// Orders the particles in memory so that neighbors are close together and gathers hit the cache.
#pragma once

#include "mesh/topology.h"

#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// Mean of |a - b| over the edges; 0 without edges.
double mean_edge_span(std::span<const Edge> edges);

/// Old number -> new number by the reverse Cuthill-McKee method (Cuthill and McKee 1969, George 1971), from a
/// pseudo-peripheral particle of each component (George and Liu 1979). Components keep the order of their lowest
/// particles and stay contiguous. Deterministic. `edges` sorted by (a, b), as build_edges gives them.
std::vector<std::uint32_t> reverse_cuthill_mckee(std::span<const Edge> edges, std::uint32_t particle_count);

/// Old number -> new number; empty if the present order is good enough.
std::vector<std::uint32_t> better_order(std::span<const Edge> edges, std::uint32_t particle_count);

}  // namespace weft
