#include "solver/model/link_graph.h"

#include "mesh/grouping.h"

#include <cmath>

namespace weft {

namespace {

// Distance from c to d in m, straight across the edge after its two triangles are unfolded into one plane; 0 if that
// line leaves the triangles.
double distance_across(const Topology& topology, const Hinge& hinge) {
    const auto from_a = [&](std::uint32_t p) {
        const Vec3 x = topology.rest_positions[p] - topology.rest_positions[hinge.a];
        return std::array<double, 3>{x.x, x.y, x.z};
    };
    const auto dot = [](const auto& a, const auto& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    const auto e = from_a(hinge.b), c = from_a(hinge.c), d = from_a(hinge.d);
    const double edge = std::sqrt(dot(e, e));
    const double cx = dot(c, e) / edge, dx = dot(d, e) / edge;
    const double cy = std::sqrt(std::max(dot(c, c) - cx * cx, 0.0)), dy = std::sqrt(std::max(dot(d, d) - dx * dx, 0.0));
    if (!(cy + dy > 0)) return 0;
    const double crossing = cx + (dx - cx) * cy / (cy + dy);
    return crossing >= 0 && crossing <= edge ? std::hypot(cx - dx, cy + dy) : 0;
}

// Paths along edges are longer than geodesics: by 41 % across the diagonals of squares. Links from the tip of a
// triangle to the tip of its neighbor remove most of this error.
void add_hinges(const Topology& topology, LinkGraph& graph) {
    std::vector<std::uint32_t> offsets(graph.offsets.size());
    std::vector<double> across(topology.hinges.size());
    for (std::size_t i = 0; i < across.size(); ++i) {
        const Hinge& hinge = topology.hinges[i];
        across[i] = distance_across(topology, hinge);
        if (across[i] > 0) ++offsets[hinge.c + 1], ++offsets[hinge.d + 1];
    }
    for (std::uint32_t node = 0; node < graph.size(); ++node) {
        offsets[node + 1] += offsets[node] + graph.offsets[node + 1] - graph.offsets[node];
    }
    std::vector<Link> links(offsets.back());
    std::vector<std::uint32_t> next(offsets.begin(), offsets.end() - 1);
    for (std::uint32_t node = 0; node < graph.size(); ++node) {
        for (const Link& link : graph[node]) links[next[node]++] = link;
    }
    for (std::size_t i = 0; i < across.size(); ++i) {
        const Hinge& hinge = topology.hinges[i];
        if (!(across[i] > 0)) continue;
        links[next[hinge.c]++] = {hinge.d, across[i], across[i]};
        links[next[hinge.d]++] = {hinge.c, across[i], across[i]};
    }
    for (std::uint32_t node = 0; node < graph.size(); ++node) {
        std::sort(links.begin() + static_cast<std::ptrdiff_t>(offsets[node]),
                  links.begin() + static_cast<std::ptrdiff_t>(offsets[node + 1]),
                  [](const Link& a, const Link& b) { return a.to != b.to ? a.to < b.to : a.length < b.length; });
    }
    graph.offsets = std::move(offsets);
    graph.links = std::move(links);
}

}  // namespace

LinkGraph graph_of_edges(const RestShape& rest, const Fabric& fabric) {
    const auto [warp, weft] = std::array{fabric.stretch.stretch[0], fabric.stretch.stretch[1]};
    const bool turns = !fabric.stretch.inextensible && fabric.stretch.shear < std::min(warp, weft) / 3;
    const Topology& topology = rest.topology;
    LinkGraph graph{.offsets = topology.particle_edges.offsets, .links = {}, .turns = turns};
    graph.links.resize(graph.offsets.back());
    std::vector<std::uint32_t> next(graph.offsets.begin(), graph.offsets.end() - 1);
    // Edges are sorted by (a, b), so the links of each particle are sorted by `to`.
    for (std::size_t e = 0; e < topology.edges.size(); ++e) {
        const Edge& edge = topology.edges[e];
        const double length_at_rest = length(topology.rest_positions[edge.a] - topology.rest_positions[edge.b]);
        double reach = length_at_rest;
        if (turns) {
            const double cos2 = std::clamp(static_cast<double>(rest.cos2_to_warp[e]), 0.0, 1.0);
            reach = limit_along(rest.elasticity, reach, reach * std::sqrt(cos2), reach * std::sqrt(1 - cos2)).length;
        }
        graph.links[next[edge.a]++] = {edge.b, length_at_rest, reach};
        graph.links[next[edge.b]++] = {edge.a, length_at_rest, reach};
    }
    // If threads turn, limits follow the threads, which run along the edges.
    if (!turns) add_hinges(topology, graph);
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
