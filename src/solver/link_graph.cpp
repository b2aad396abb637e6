#include "solver/link_graph.h"

#include "mesh/grouping.h"

#include <cmath>

namespace weft {

LinkGraph graph_of_edges(const RestShape& rest, const Fabric& fabric) {
    const auto [warp, weft] = std::array{fabric.stretch.stretch[0], fabric.stretch.stretch[1]};
    const bool turns = !fabric.stretch.inextensible && fabric.stretch.shear < std::min(warp, weft) / 3;
    const Topology& topology = rest.topology;
    LinkGraph graph{.offsets = topology.particle_edges.offsets, .links = {}, .turns = turns};
    graph.links.resize(graph.offsets.back());
    std::vector<std::uint32_t> next(graph.offsets.begin(), graph.offsets.end() - 1);
    // Sorted by (a, b), edges come to each particle with the other end ascending.
    for (const Edge& edge : topology.edges) {
        const double length_at_rest = length(topology.rest_positions[edge.a] - topology.rest_positions[edge.b]);
        double reach = length_at_rest;
        if (turns) {
            const double cos2 = std::clamp(static_cast<double>(cos2_to_warp(rest, edge)), 0.0, 1.0);
            reach *= std::sqrt(cos2) + std::sqrt(1 - cos2);
        }
        graph.links[next[edge.a]++] = {edge.b, length_at_rest, reach};
        graph.links[next[edge.b]++] = {edge.a, length_at_rest, reach};
    }
    return graph;
}

double mean_length(const LinkGraph& graph) {
    double sum = 0;
    for (const Link& link : graph.links) sum += link.length;
    return graph.links.empty() ? 0 : sum / static_cast<double>(graph.links.size());
}

const Link* find_link(const LinkGraph& graph, std::uint32_t node, std::uint32_t to) {
    const std::span<const Link> links = graph[node];
    const auto found = std::ranges::lower_bound(links, to, {}, &Link::to);
    return found != links.end() && found->to == to ? &*found : nullptr;
}

}  // namespace weft
