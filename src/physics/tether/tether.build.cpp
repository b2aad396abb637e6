#include "physics/constraint.h"
#include "physics/rest_frames.h"
#include "physics/tether/geodesic.h"
#include "physics/tether/held_places.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace weft {
namespace {

// Tethers per particle, each to another place where the cloth is held. More of them cost time and change little: what
// holds is the nearest few.
constexpr std::size_t max_tethers = 4;
// So many ways are followed for them: the last of them may be a little too long (geodesic.h).
constexpr std::size_t max_ways = max_tethers + 2;

struct Tether {
    double distance;
    std::uint32_t anchor;
    friend bool operator<(const Tether& a, const Tether& b) {
        return a.distance != b.distance ? a.distance < b.distance : a.anchor < b.anchor;
    }
};

// Where the cloth is flat, the way runs as the straight line does.
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
    if (material.use != Tethers::on || rest.held.empty()) return rows;

    const auto places = held_places(rest);
    if (places.empty()) return rows;
    const auto most = static_cast<std::uint32_t>(std::min(places.size(), max_ways));
    const WaysToPlaces ways = ways_to_places(rest.topology, places, most);
    const double slack = 1 + static_cast<double>(material.slack);
    // Rank by rank, so that the rows of a color run through the particles in order.
    std::array<RowList, max_tethers> ranks;
    std::vector<Tether> tethers;
    for (std::uint32_t p = 0; p < rest.topology.particle_count; ++p) {
        if (rest.held[p]) continue;
        tethers.clear();
        for (const Way& way : ways[p]) tethers.push_back({way.distance, way.source});
        std::sort(tethers.begin(), tethers.end());
        for (std::size_t rank = 0; rank < std::min(tethers.size(), max_tethers); ++rank) {
            const auto [distance, anchor] = tethers[rank];
            const Limit limit = limit_between(rest, anchor, p, distance * slack);
            if (!std::isfinite(limit.length + limit.give)) continue;  // no stiffness at all
            ranks[rank].add({p, anchor}, {static_cast<float>(limit.length), static_cast<float>(limit.give)});
        }
    }
    for (const RowList& rank : ranks) {
        rows.particles.insert(rows.particles.end(), rank.particles.begin(), rank.particles.end());
        rows.fields.insert(rows.fields.end(), rank.fields.begin(), rank.fields.end());
    }
    return rows;
}

}  // namespace weft
