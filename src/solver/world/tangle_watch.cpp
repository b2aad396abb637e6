#include "solver/world/tangle_watch.h"

#include <algorithm>
#include <vector>

namespace weft {

void TangleWatch::search(std::span<const WatchedCloth> cloths) {
    // Numbered over the world, where the ranges of cloths have gaps between them. No triangle uses these.
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    for (const WatchedCloth& cloth : cloths) {
        positions.resize(std::max(positions.size(), cloth.base + cloth.positions.size()));
        for (std::size_t p = 0; p < cloth.positions.size(); ++p) positions[cloth.base + p] = cloth.positions[p].xyz();
        for (const Triangle t : cloth.model->triangles())
            triangles.push_back({cloth.base + t[0], cloth.base + t[1], cloth.base + t[2]});
    }
    tangle_ = find_tangle(positions, triangles);
}

void TangleWatch::count(ClothContactCounts& counts) const {
    counts.tangled = std::max(counts.tangled, std::uint64_t{tangle_.pairs.size()});
    for (const TangledPair& pair : tangle_.pairs)
        counts.tangled_particle = std::min(counts.tangled_particle, std::ranges::min(pair.particle));
}

}  // namespace weft
