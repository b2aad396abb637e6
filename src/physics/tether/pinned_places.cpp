#include "physics/tether/pinned_places.h"

namespace weft {

std::vector<std::vector<std::uint32_t>> pinned_places(const RestShape& rest) {
    const Topology& topology = rest.topology;
    std::vector<std::vector<std::uint32_t>> places;
    std::vector<std::uint8_t> seen(topology.particle_count);
    for (std::uint32_t first = 0; first < topology.particle_count; ++first) {
        if (!rest.pinned[first] || seen[first]) continue;
        auto& place = places.emplace_back(1, first);
        seen[first] = 1;
        for (std::size_t i = 0; i < place.size(); ++i) {
            for (std::uint32_t e : topology.particle_edges[place[i]]) {
                const Edge& edge = topology.edges[e];
                const std::uint32_t other = edge.a == place[i] ? edge.b : edge.a;
                if (!rest.pinned[other] || seen[other]) continue;
                seen[other] = 1;
                place.push_back(other);
            }
        }
    }
    return places;
}

}  // namespace weft
