// Islands: groups of cloths that are stitched together or can collide, directly or through others. An island is stepped
// as one.
#pragma once

#include "physics/stitch/stitch.h"
#include "solver/plan/world_plan.h"

#include <weft/ids.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// A tie between two points on cloth. Particles are numbered in their own cloth.
struct Stitch {
    ClothId a, b;  ///< may be the same one
    StitchPoint from, to;
    float gap = 0;         ///< m
    float compliance = 0;  ///< m/N
};

/// Groups the numbers [0, count) that ties connect. Numbers in a group are ascending; groups are sorted by their first
/// number.
std::vector<std::vector<std::uint32_t>> group_islands(std::uint32_t count,
                                                      std::span<const std::array<std::uint32_t, 2>> ties);

/// A stitch whose particles are numbered over the world.
struct PlacedStitch {
    StitchPoint from, to;
    float gap = 0, compliance = 0;
};
/// Packs the stitches of an island. Padding acts on dummies from `first_dummy` on; no other island may use these
/// dummies, because islands are projected in parallel. Stitches of a point to itself are left out. Stitches keep the
/// order of the list, so that the result is deterministic.
LinkTables make_links(std::span<const PlacedStitch> stitches, std::uint32_t first_dummy);

}  // namespace weft
