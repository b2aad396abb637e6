#include "solver/world/tangle_watch.h"

#include <algorithm>
#include <vector>

namespace weft {

void TangleWatch::search(std::span<const WatchedCloth> cloths, std::span<const Seams* const> seams) {
    // Numbered over the world, where the ranges of cloths have gaps between them. No triangle uses these.
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    for (const WatchedCloth& cloth : cloths) {
        positions.resize(std::max(positions.size(), cloth.base + cloth.positions.size()));
        for (std::size_t p = 0; p < cloth.positions.size(); ++p) positions[cloth.base + p] = cloth.positions[p].xyz();
        for (const Triangle t : cloth.model->triangles())
            triangles.push_back({cloth.base + t[0], cloth.base + t[1], cloth.base + t[2]});
    }
    const auto cloth_of = [&](std::uint32_t particle) -> const WatchedCloth& {
        return *std::ranges::find_if(cloths, [&](const WatchedCloth& cloth) {
            return particle >= cloth.base && particle - cloth.base < cloth.positions.size();
        });
    };
    const auto can_cross = [&](std::uint32_t p, std::uint32_t q) {
        const WatchedCloth &a = cloth_of(p), &b = cloth_of(q);
        if (a.base == b.base) return !a.model->collision.surface;
        return can_collide(a.model->collision, b.model->collision);
    };
    const auto order = [&](std::uint32_t p, std::uint32_t q) {
        const std::uint32_t a = cloth_of(p).model->collision.layer, b = cloth_of(q).model->collision.layer;
        return a > b ? 1 : a < b ? -1 : 0;
    };
    const auto tied = [&](std::uint32_t p, std::uint32_t q) {
        return std::ranges::any_of(seams, [&](const Seams* one) { return !(one->distance(p, q) > 0); });
    };
    TangleRules rules{.can_cross = can_cross, .order = order};
    if (!seams.empty()) rules.tied = tied;
    tangle_ = find_tangle(positions, triangles, rules);
    least_particle_ = no_particle;
    for (const TangledPair& pair : tangle_.pairs)
        for (const std::uint32_t p : pair.particle)
            if (!cloth_of(p).model->collision.surface) least_particle_ = std::min(least_particle_, p);
}

void TangleWatch::count(ClothContactCounts& counts) const {
    counts.tangled = std::max(counts.tangled, std::uint64_t{tangle_.pairs.size()});
    counts.tangled_particle = std::min(counts.tangled_particle, least_particle_);
}

}  // namespace weft
