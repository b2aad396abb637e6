#include "physics/constraint.h"
#include "physics/tether/geodesic.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

// Tethers per particle, each to another place where the cloth is held. More of them cost time and change little: what
// holds is the nearest few.
constexpr std::size_t max_tethers = 4;

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

    std::vector<std::vector<Tether>> tethers(rest.topology.particle_count);
    for (const auto& place : held_places(rest)) {
        const Geodesic way = geodesic_distance(rest.topology, place);
        for (std::uint32_t p = 0; p < rest.topology.particle_count; ++p) {
            if (rest.held[p] || way.nearest[p] == none) continue;
            auto& mine = tethers[p];
            mine.push_back({way.distance[p], way.nearest[p]});
            std::sort(mine.begin(), mine.end());
            if (mine.size() > max_tethers) mine.pop_back();
        }
    }
    // Rank by rank, so that the rows of a color run through the particles in order.
    for (std::size_t rank = 0; rank < max_tethers; ++rank) {
        for (std::uint32_t p = 0; p < rest.topology.particle_count; ++p) {
            if (rank >= tethers[p].size()) continue;
            const auto& [distance, anchor] = tethers[p][rank];
            rows.add({p, anchor}, {distance * (1 + material.slack)});
        }
    }
    return rows;
}

}  // namespace weft
