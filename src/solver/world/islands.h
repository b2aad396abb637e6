// Islands: cloths that are tied together, directly or through others, are stepped together.
#pragma once

#include "physics/stitch/stitch.h"
#include "solver/plan/world_plan.h"

#include <weft/ids.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// A tie between two points on cloth. Particles are those of each cloth.
struct Stitch {
    ClothId a, b;  ///< may be the same one
    StitchPoint from, to;
    float gap = 0;         ///< m
    float compliance = 0;  ///< m/N
};

/// Numbers [0, count) in groups that ties hold together: numbers of a group ascending, groups by their first number.
std::vector<std::vector<std::uint32_t>> group_islands(std::uint32_t count,
                                                      std::span<const std::array<std::uint32_t, 2>> ties);

/// Stitches between particles that are numbered over the world. Padding acts on dummies from `first_dummy` on, which
/// must be the island's own: islands are projected side by side. Those of a point to itself are left out. In the order
/// of the list, so that the bits do not depend on anything else.
struct PlacedStitch {
    StitchPoint from, to;
    float gap = 0, compliance = 0;
};
LinkTables make_links(std::span<const PlacedStitch> stitches, std::uint32_t first_dummy);

}  // namespace weft
