#include "physics/constraint.h"
#include "physics/rest_frames.h"
#include "physics/tether/geodesic.h"
#include "physics/tether/pinned_places.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace weft {
namespace {

// Tethers per particle, each to a different pinned place. More cost time and change little, because the nearest few
// carry the load.
constexpr std::size_t max_tethers = 4;
// Geodesics computed per particle. More than the tethers, because the last ones may be slightly too long (geodesic.h).
constexpr std::size_t max_ways = max_tethers + 2;

struct Tether {
    double distance;
    std::uint32_t anchor;
    friend bool operator<(const Tether& a, const Tether& b) {
        return a.distance != b.distance ? a.distance < b.distance : a.anchor < b.anchor;
    }
};

// In flat cloth the geodesic follows the straight line.
Limit limit_between(const RestShape& rest, std::uint32_t a, std::uint32_t b, double way) {
    const auto& x = rest.topology.rest_positions;
    const StraightLine line = straight_line(rest.frames[a], rest.frames[b], x[b] - x[a]);
    if (!follows(way, line)) return limit_any_way(rest.elasticity, way);
    const double scale = way / line.length;
    return limit_along(rest.elasticity, way, scale * line.along_warp, scale * line.along_weft);
}

}  // namespace

RowList build_tether(const RestShape& rest, const TetherMaterial& material) {
    RowList rows = make_rows(ConstraintKind::tether);
    if (material.use != Tethers::on || rest.pinned.empty()) return rows;

    const auto places = pinned_places(rest);
    if (places.empty()) return rows;
    const auto most = static_cast<std::uint32_t>(std::min(places.size(), max_ways));
    const WaysToPlaces ways = ways_to_places(rest.topology, places, most);
    const double slack = 1 + static_cast<double>(material.slack);
    // Sorted by rank, so that the constraints of a color access the particles in order.
    std::array<RowList, max_tethers> ranks;
    std::vector<Tether> tethers;
    for (std::uint32_t p = 0; p < rest.topology.particle_count; ++p) {
        if (rest.pinned[p]) continue;
        tethers.clear();
        for (const Way& way : ways[p]) tethers.push_back({way.distance, way.source});
        std::sort(tethers.begin(), tethers.end());
        for (std::size_t rank = 0; rank < std::min(tethers.size(), max_tethers); ++rank) {
            const auto [distance, anchor] = tethers[rank];
            const Limit limit = limit_between(rest, anchor, p, distance * slack);
            if (!std::isfinite(limit.length + limit.compliance)) continue;  // no stiffness at all
            ranks[rank].add({p, anchor}, {static_cast<float>(limit.length), static_cast<float>(limit.compliance)});
        }
    }
    for (const RowList& rank : ranks) {
        rows.particles.insert(rows.particles.end(), rank.particles.begin(), rank.particles.end());
        rows.fields.insert(rows.fields.end(), rank.fields.begin(), rank.fields.end());
    }
    return rows;
}

}  // namespace weft
