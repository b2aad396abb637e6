#include "solver/hierarchy.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>

namespace weft {
namespace {

// A level with fewer nodes brings nothing that the one before has not done.
constexpr std::uint32_t least_nodes = 12;

// Of the mean length of a level's rows. On a square grid the nodes of the next level are then every second one along
// warp and weft: two rows apart, but not across one diagonal.
constexpr double spacing = 1.6;
// How far a node's influence goes, likewise: on a square grid to the middle of four.
constexpr double influence = 2.25;

// What holds a level together: for the particles its edges, for a coarse level its rows.
struct Link {
    std::uint32_t to = 0;
    double length = 0;  // m, along the surface at rest
    double reach = 0;   // m, as far as the two ends can come apart
};
using Graph = std::vector<std::vector<Link>>;

// m: from c to d, straight across the edge once its two triangles lie in one plane; 0 if that line leaves them.
double distance_across(const Topology& topology, const Hinge& hinge) {
    const auto at = [&](std::uint32_t p) {
        const Vec3 x = topology.rest_positions[p];
        return std::array<double, 3>{x.x, x.y, x.z};
    };
    const auto minus = [](const auto& a, const auto& b) { return std::array{a[0] - b[0], a[1] - b[1], a[2] - b[2]}; };
    const auto dot = [](const auto& a, const auto& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    const auto a = at(hinge.a), e = minus(at(hinge.b), a), c = minus(at(hinge.c), a), d = minus(at(hinge.d), a);
    const double along = std::sqrt(dot(e, e));
    const double cx = dot(c, e) / along, dx = dot(d, e) / along;
    const double cy = std::sqrt(std::max(dot(c, c) - cx * cx, 0.0)), dy = std::sqrt(std::max(dot(d, d) - dx * dx, 0.0));
    if (!(cy + dy > 0)) return 0;
    const double crossing = cx + (dx - cx) * cy / (cy + dy);
    return crossing >= 0 && crossing <= along ? std::hypot(cx - dx, cy + dy) : 0;
}

Graph graph_of_edges(const RestShape& rest, const Fabric& fabric) {
    const auto [warp, weft] = std::array{fabric.stretch.stretch[0], fabric.stretch.stretch[1]};
    const bool turns = !fabric.stretch.inextensible && fabric.stretch.shear < std::min(warp, weft) / 3;
    Graph graph(rest.topology.particle_count);
    for (const Edge& edge : rest.topology.edges) {
        const double length_at_rest =
            length(rest.topology.rest_positions[edge.a] - rest.topology.rest_positions[edge.b]);
        const double cos2 = std::clamp(static_cast<double>(cos2_to_warp(rest, edge)), 0.0, 1.0);
        const double reach = length_at_rest * (turns ? std::sqrt(cos2) + std::sqrt(1 - cos2) : 1.0);
        graph[edge.a].push_back({edge.b, length_at_rest, reach});
        graph[edge.b].push_back({edge.a, length_at_rest, reach});
    }
    // What turns goes the way of its threads, which is that of the edges.
    for (const Hinge& hinge : turns ? std::span<const Hinge>() : std::span<const Hinge>(rest.topology.hinges)) {
        const double across = distance_across(rest.topology, hinge);
        if (!(across > 0)) continue;
        graph[hinge.c].push_back({hinge.d, across, across});
        graph[hinge.d].push_back({hinge.c, across, across});
    }
    return graph;
}

double mean_length(const Graph& graph) {
    double sum = 0, count = 0;
    for (const auto& links : graph) {
        for (const Link& link : links) sum += link.length, count += 1;
    }
    return count > 0 ? sum / count : 0;
}

struct Near {
    std::uint32_t node = 0;
    double distance = 0;
};

// Every node within a distance of one, by one of the two measures of a link. Keeps its arrays from call to call.
class Neighborhood {
  public:
    explicit Neighborhood(std::size_t count) : distance_(count, unseen) {}

    const std::vector<Near>& around(const Graph& graph, std::uint32_t from, double limit, double Link::*measure) {
        for (const Near& near : found_) distance_[near.node] = unseen;
        for (std::uint32_t node : touched_) distance_[node] = unseen;
        found_.clear(), touched_.clear();
        offer(from, 0);
        while (!queue_.empty()) {
            const auto [d, node] = queue_.top();
            queue_.pop();
            if (d > distance_[node]) continue;
            found_.push_back({node, d});
            for (const Link& link : graph[node]) {
                if (d + link.*measure <= limit) offer(link.to, d + link.*measure);
            }
        }
        return found_;
    }

  private:
    static constexpr double unseen = 1e300;

    void offer(std::uint32_t node, double d) {
        if (!(d < distance_[node])) return;
        if (distance_[node] == unseen) touched_.push_back(node);
        distance_[node] = d;
        queue_.push({d, node});
    }

    using Entry = std::pair<double, std::uint32_t>;
    std::vector<double> distance_;
    std::vector<std::uint32_t> touched_;
    std::vector<Near> found_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

struct Parent {
    std::uint32_t node = 0;
    double weight = 0;
};

// Nodes that keep a distance from one another and leave no gap; pinned ones come first, as everything hangs on them.
// Each leaves its mark on those around it.
struct Selection {
    std::vector<std::uint32_t> chosen;
    std::vector<std::vector<Parent>> parents;  // of every node
};

Selection select_nodes(const Graph& graph, const std::vector<std::uint8_t>& pinned) {
    const double unit = mean_length(graph);
    Neighborhood neighborhood(graph.size());
    Selection selection;
    selection.parents.resize(graph.size());
    std::vector<std::uint8_t> taken(graph.size());
    const auto choose = [&](std::uint32_t from) {
        if (taken[from]) return;
        const auto node = static_cast<std::uint32_t>(selection.chosen.size());
        selection.chosen.push_back(from);
        for (const auto& [other, distance] : neighborhood.around(graph, from, influence * unit, &Link::length)) {
            if (distance < spacing * unit) taken[other] = 1;
            selection.parents[other].push_back({node, 1 - distance / (influence * unit * 1.001)});
        }
    };
    for (const bool first : {true, false}) {
        for (std::uint32_t node = 0; node < graph.size(); ++node) {
            if (static_cast<bool>(pinned[node]) == first) choose(node);
        }
    }
    for (std::uint32_t node = 0; node < selection.chosen.size(); ++node) {
        selection.parents[selection.chosen[node]] = {{node, 1}};
    }
    for (auto& parents : selection.parents) {
        std::ranges::stable_sort(parents, std::ranges::greater(), &Parent::weight);
        parents.resize(std::min<std::size_t>(parents.size(), Carry::parents));
        double sum = 0;
        for (const Parent& parent : parents) sum += parent.weight;
        for (Parent& parent : parents) parent.weight /= sum;
    }
    return selection;
}

// Two nodes are neighbors if a node between them follows both, or if nodes that follow them most are linked.
Graph graph_of_nodes(const Graph& fine, const Selection& selection) {
    constexpr double clearly = 0.15;
    std::vector<std::map<std::uint32_t, double>> neighbors(selection.chosen.size());
    for (std::uint32_t node = 0; node < fine.size(); ++node) {
        for (const Parent& a : selection.parents[node]) {
            for (const Parent& b : selection.parents[node]) {
                if (a.node != b.node && std::min(a.weight, b.weight) > clearly) neighbors[a.node].emplace(b.node, 0);
            }
        }
        for (const Link& link : fine[node]) {
            const std::uint32_t a = selection.parents[node].front().node, b = selection.parents[link.to].front().node;
            if (a != b) neighbors[a].emplace(b, 0), neighbors[b].emplace(a, 0);
        }
    }
    std::vector<std::uint32_t> node_of(fine.size(), none);
    for (std::uint32_t node = 0; node < selection.chosen.size(); ++node) node_of[selection.chosen[node]] = node;

    const double unit = mean_length(fine);
    Neighborhood by_reach(fine.size()), by_length(fine.size());
    Graph graph(selection.chosen.size());
    for (std::uint32_t node = 0; node < selection.chosen.size(); ++node) {
        std::map<std::uint32_t, Link> links;
        for (const Near& near : by_reach.around(fine, selection.chosen[node], 4 * spacing * unit, &Link::reach)) {
            const std::uint32_t other = node_of[near.node];
            if (other != none && neighbors[node].contains(other)) links[other] = {other, 0, near.distance};
        }
        for (const Near& near : by_length.around(fine, selection.chosen[node], 4 * spacing * unit, &Link::length)) {
            const std::uint32_t other = node_of[near.node];
            if (other != none && links.contains(other)) links[other].length = near.distance;
        }
        for (const auto& [other, link] : links) graph[node].push_back(link);
    }
    return graph;
}

// A link that says no more than two others together do.
bool is_implied(const Graph& graph, std::uint32_t from, const Link& link) {
    for (const Link& first : graph[from]) {
        for (const Link& second : graph[first.to]) {
            if (second.to == link.to && first.reach + second.reach <= 1.001 * link.reach) return true;
        }
    }
    return false;
}

Carry carry_to(const std::vector<std::vector<Parent>>& parents, std::span<const std::uint8_t> pinned) {
    Carry carry;
    carry.stride = padded(static_cast<std::uint32_t>(parents.size()));
    carry.node.resize(std::size_t{Carry::parents} * carry.stride);
    carry.weight.resize(std::size_t{Carry::parents} * carry.stride);
    for (std::uint32_t i = 0; i < parents.size(); ++i) {
        for (std::uint32_t k = 0; k < parents[i].size() && !pinned[i]; ++k) {
            carry.node[std::size_t{k} * carry.stride + i] = parents[i][k].node;
            carry.weight[std::size_t{k} * carry.stride + i] = static_cast<float>(parents[i][k].weight);
        }
    }
    return carry;
}

// What three times its own weight, hung over its whole extent, stretches the cloth by.
double reserve_of(const RestShape& rest, const Fabric& fabric) {
    if (fabric.stretch.inextensible) return 0;
    constexpr double gravity = 9.81;
    const double extent = length(bounds_of(rest.topology.rest_positions).size());
    const double softest = std::min(fabric.stretch.stretch[0], fabric.stretch.stretch[1]);
    return softest > 0 ? 3 * static_cast<double>(fabric.body.density) * gravity * extent / softest : 1e3;
}

}  // namespace

std::vector<CoarseLevel> build_hierarchy(const RestShape& rest, const Fabric& fabric, std::span<const Vec4> start) {
    // Beyond this the levels would let anything pass.
    constexpr double useless_reserve = 0.1;
    std::vector<CoarseLevel> levels;
    const double reserve = reserve_of(rest, fabric);
    if (reserve > useless_reserve) return levels;

    Graph graph = graph_of_edges(rest, fabric);
    std::vector<std::uint32_t> particle(graph.size());
    std::vector<std::uint8_t> pinned(graph.size());
    std::vector<double> mass(graph.size());
    for (std::uint32_t p = 0; p < graph.size(); ++p) {
        particle[p] = p;
        pinned[p] = !(start[p].w > 0);
        mass[p] = pinned[p] ? 0 : 1.0 / static_cast<double>(start[p].w);
    }
    while (true) {
        const Selection selection = select_nodes(graph, pinned);
        const auto count = static_cast<std::uint32_t>(selection.chosen.size());
        if (count < least_nodes || 4 * std::size_t{count} > 3 * graph.size()) return levels;
        CoarseLevel level{.count = count, .particle = {}, .weight = {}, .reach = {}, .carry = {}};
        level.carry = carry_to(selection.parents, pinned);

        std::vector<double> carried(count);
        for (std::uint32_t i = 0; i < graph.size(); ++i) {
            for (const Parent& parent : selection.parents[i]) carried[parent.node] += parent.weight * mass[i];
        }
        std::vector<std::uint8_t> held(count);
        std::vector<std::uint32_t> nodes(count);
        level.particle.resize(padded(count));
        level.weight.resize(padded(count));
        for (std::uint32_t node = 0; node < count; ++node) {
            held[node] = pinned[selection.chosen[node]];
            nodes[node] = level.particle[node] = particle[selection.chosen[node]];
            level.weight[node] = held[node] || !(carried[node] > 0) ? 0 : static_cast<float>(1 / carried[node]);
        }
        Graph coarse = graph_of_nodes(graph, selection);
        RowList rows = make_rows(ConstraintKind::reach);
        for (std::uint32_t node = 0; node < count; ++node) {
            for (const Link& link : coarse[node]) {
                if (link.to > node && !is_implied(coarse, node, link))
                    rows.add({node, link.to}, {static_cast<float>(link.reach * (1 + reserve))});
            }
        }
        level.reach = pack_rows(ConstraintKind::reach, rows, count);
        levels.push_back(std::move(level));
        graph = std::move(coarse);
        particle = std::move(nodes), pinned = std::move(held), mass = std::move(carried);
    }
}

}  // namespace weft
