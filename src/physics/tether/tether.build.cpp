#include "physics/constraint.h"
#include "physics/tether/geodesic.h"

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

// Held particles that hang together over edges between them: a corner, a hem, the tip of an ear.
std::vector<std::vector<std::uint32_t>> held_places(const RestShape& rest) {
    const Topology& topology = rest.topology;
    std::vector<std::vector<std::uint32_t>> places;
    std::vector<std::uint8_t> seen(topology.particle_count);
    for (std::uint32_t first = 0; first < topology.particle_count; ++first) {
        if (!rest.held[first] || seen[first]) continue;
        auto& place = places.emplace_back(1, first);
        seen[first] = 1;
        for (std::size_t i = 0; i < place.size(); ++i) {
            for (std::uint32_t e : topology.particle_edges[place[i]]) {
                const Edge& edge = topology.edges[e];
                const std::uint32_t other = edge.a == place[i] ? edge.b : edge.a;
                if (!rest.held[other] || seen[other]) continue;
                seen[other] = 1;
                place.push_back(other);
            }
        }
    }
    return places;
}

struct Tether {
    float distance;
    std::uint32_t anchor;
    friend bool operator<(const Tether& a, const Tether& b) {
        return a.distance != b.distance ? a.distance < b.distance : a.anchor < b.anchor;
    }
};

}  // namespace

RowList build_tether(const RestShape& rest, const TetherMaterial& material) {
    RowList rows = make_rows(ConstraintKind::tether);
    if (!material.enabled || rest.held.empty()) return rows;

    const auto places = held_places(rest);
    if (places.empty()) return rows;
    const auto most = static_cast<std::uint32_t>(std::min(places.size(), max_ways));
    const WaysToPlaces ways = ways_to_places(rest.topology, places, most);
    // Rank by rank, so that the rows of a color run through the particles in order.
    std::array<RowList, max_tethers> ranks;
    std::vector<Tether> tethers;
    for (std::uint32_t p = 0; p < rest.topology.particle_count; ++p) {
        if (rest.held[p]) continue;
        tethers.clear();
        for (const Way& way : ways[p]) tethers.push_back({static_cast<float>(way.distance), way.source});
        std::sort(tethers.begin(), tethers.end());
        for (std::size_t rank = 0; rank < std::min(tethers.size(), max_tethers); ++rank) {
            ranks[rank].add({p, tethers[rank].anchor}, {tethers[rank].distance * (1 + material.slack)});
        }
    }
    for (const RowList& rank : ranks) {
        rows.particles.insert(rows.particles.end(), rank.particles.begin(), rank.particles.end());
        rows.fields.insert(rows.fields.end(), rank.fields.begin(), rank.fields.end());
    }
    return rows;
}

}  // namespace weft
