#include "solver/model/hierarchy.h"

#include "mesh/grouping.h"
#include "physics/rest_frames.h"
#include "physics/tether/pinned_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft {
namespace {

// A level with fewer nodes does not improve on the level before.
constexpr std::uint32_t least_nodes = 12;

// Smallest distance of two nodes, relative to the mean link length of the finer level. On a square grid the next level
// then has every second node along warp and weft: two links apart along warp or weft, but not across one diagonal.
constexpr double spacing = 1.6;
// Radius of a node's influence, relative to the same length: on a square grid up to the center of four nodes.
constexpr double influence = 2.25;

// Factor on both for the first level of FinestLevel::every_fourth: four edges on a square grid. Fine constraints handle
// the shorter distances.
constexpr double far = 2;

// If the means of two nodes are nearer to each other than the nodes, their limit is shorter by the same ratio, but by
// no less than this one. The limit can be shorter because bending the cloth does not move the means farther apart. This
// does not hold for means that nearly coincide, nor for a pin, whose pull acts on the cloth on both sides of the line.
constexpr double closest = 0.9;

// A batch of few constraints takes as long as one constraint. On a level that one thread solves, only a batch of one
// gains nothing.
ColoringOptions coloring_of_level(std::uint32_t nodes) {
    return nodes < nodes_for_many_threads ? ColoringOptions{.min_rows = 2} : ColoringOptions{};
}

constexpr double unreached = LocalWays::unreached;

// The parents of a finer node: up to four coarse nodes, nearest first.
struct Parents {
    std::array<std::uint32_t, Prolongation::parents> node;
    std::array<double, Prolongation::parents> weight, distance;
    std::uint32_t count = 0;

    /// Parents of equal weight keep the order of insertion.
    void add(std::uint32_t new_node, double new_weight, double new_distance) {
        std::uint32_t at = count;
        while (at > 0 && weight[at - 1] < new_weight) --at;
        if (at == Prolongation::parents) return;
        count = std::min(count + 1, Prolongation::parents);
        for (std::uint32_t i = count - 1; i > at; --i) {
            node[i] = node[i - 1], weight[i] = weight[i - 1], distance[i] = distance[i - 1];
        }
        node[at] = new_node, weight[at] = new_weight, distance[at] = new_distance;
    }
    /// Whether four parents are within distance `d`. A coarse node at distance `d` is then no parent of this node, nor
    /// of the nodes behind it, because the four are at least as near to them. A search can stop here, which keeps the
    /// cost of searches around many nodes linear.
    bool complete_within(double d) const { return count == Prolongation::parents && std::ranges::max(distance) <= d; }
};

// Coarse nodes with a minimum distance from one another that cover the whole graph. Pinned nodes are chosen first,
// because the cloth hangs by them. `chosen` are finer nodes.
struct Selection {
    std::vector<std::uint32_t> chosen;
    std::vector<Parents> parents;  // of every node
};

Selection select_nodes(const LinkGraph& graph, double unit, const std::vector<std::uint8_t>& pinned) {
    Selection selection;
    selection.parents.resize(graph.size());
    auto& parents = selection.parents;
    LocalSearch search(graph);
    std::vector<std::uint8_t> taken(graph.size());
    const auto choose = [&](std::uint32_t from) {
        if (taken[from]) return;
        const auto node = static_cast<std::uint32_t>(selection.chosen.size());
        selection.chosen.push_back(from);
        search.run<&Link::length>(from, influence * unit, [&](std::uint32_t other, double distance) {
            if (parents[other].complete_within(distance)) return LocalSearch::Go::back;
            if (distance < spacing * unit) taken[other] = 1;
            parents[other].add(node, 1 - distance / (influence * unit * 1.001), distance);
            return LocalSearch::Go::on;
        });
    };
    for (const bool first : {true, false}) {
        for (std::uint32_t node = 0; node < graph.size(); ++node) {
            if (static_cast<bool>(pinned[node]) == first) choose(node);
        }
    }
    for (std::uint32_t node = 0; node < selection.chosen.size(); ++node) {
        Parents& own = parents[selection.chosen[node]];
        own.count = 1, own.node[0] = node, own.weight[0] = 1, own.distance[0] = 0;
    }
    for (Parents& of : parents) {
        double sum = 0;
        for (std::uint32_t k = 0; k < of.count; ++k) sum += of.weight[k];
        for (std::uint32_t k = 0; k < of.count; ++k) of.weight[k] /= sum;
    }
    return selection;
}

struct Neighbors {
    Adjacency of;               // every node, ascending
    std::vector<double> limit;  // m, per node: largest distance to a neighbor along links
};

// Two coarse nodes are neighbors if a finer node has both as parents, or if two linked finer nodes have them as their
// nearest parents.
Neighbors neighbors_of_nodes(const LinkGraph& fine, const Selection& selection) {
    constexpr double clearly = 0.15;
    const auto count = static_cast<std::uint32_t>(selection.chosen.size());
    const auto followers = group_items<std::uint32_t>(count, [&](auto put) {
        for (std::uint32_t i = 0; i < fine.size(); ++i) {
            const Parents& parents = selection.parents[i];
            for (std::uint32_t k = 0; k < parents.count; ++k) {
                if (k == 0 || parents.weight[k] > clearly) put(parents.node[k], i);
            }
        }
    });
    Neighbors result{.of = {.offsets = {0}, .items = {}}, .limit = {}};
    Adjacency& neighbors = result.of;
    struct Nearest {
        double distance;
        std::uint32_t node;
    };
    std::vector<Nearest> nearest(fine.size());  // nearest parent of each finer node
    for (std::uint32_t i = 0; i < fine.size(); ++i)
        nearest[i] = {selection.parents[i].distance[0], selection.parents[i].node[0]};
    std::vector<std::uint32_t> seen(count, none);  // the node that last added this one
    std::vector<double> way(count);                // shortest known distance to that node
    for (std::uint32_t node = 0; node < count; ++node) {
        const auto add = [&](std::uint32_t other, double length) {
            if (other == node) return;
            if (seen[other] == node) {
                way[other] = std::min(way[other], length);
                return;
            }
            seen[other] = node, way[other] = length;
            neighbors.items.push_back(other);
        };
        for (std::uint32_t f = followers.offsets[node]; f < followers.offsets[node + 1]; ++f) {
            const std::uint32_t follower = followers.items[f];
            const Parents& parents = selection.parents[follower];
            double weight = 0, to_node = 0;
            for (std::uint32_t k = 0; k < parents.count; ++k) {
                if (parents.node[k] == node) weight = parents.weight[k], to_node = parents.distance[k];
            }
            for (std::uint32_t k = 0; k < parents.count && weight > clearly; ++k) {
                if (parents.weight[k] > clearly) add(parents.node[k], to_node + parents.distance[k]);
            }
            if (parents.node[0] != node) continue;
            for (const Link& link : fine[follower]) {
                add(nearest[link.to].node, to_node + link.length + nearest[link.to].distance);
            }
        }
        std::sort(neighbors.items.begin() + neighbors.offsets.back(), neighbors.items.end());
        double limit = 0;
        for (std::size_t i = neighbors.offsets.back(); i < neighbors.items.size(); ++i) {
            limit = std::max(limit, way[neighbors.items[i]]);
        }
        result.limit.push_back(limit);
        neighbors.offsets.push_back(static_cast<std::uint32_t>(neighbors.items.size()));
    }
    return result;
}

// Replaces the length of a path along edges by the straight distance if the cloth is flat between its ends.
void straighten(Link& link, const StraightLine& straight, const Elasticity& elasticity, bool turns) {
    if (!follows(link.length, straight)) return;
    link.length = std::min(link.length, straight.length);
    if (!turns) {
        link.limit = link.length;
        return;
    }
    const Limit limit = limit_along(elasticity, straight.length, straight.along_warp, straight.along_weft);
    link.limit = std::min(link.limit, limit.length);
}

// The limit of a constraint between two nodes. If threads turn, link.limit already includes elasticity.
Limit limit_of(const Link& link, const StraightLine& straight, const Elasticity& elasticity, bool turns) {
    if (!turns) return limit_any_way(elasticity, link.limit);
    if (follows(link.length, straight)) {
        const Limit limit = limit_along(elasticity, straight.length, straight.along_warp, straight.along_weft);
        return {link.limit, limit.compliance};
    }
    // Compliance of the path: its elongation per tension, at most that of a path in the softest direction.
    const double compliance = (link.limit - link.length) / elasticity.tension;
    return {link.limit, std::min(compliance, limit_any_way(elasticity, link.length).compliance)};
}

// Builds the graph of the coarse nodes. Neighbors without a path shorter than four spacings are dropped. A hub (a node
// with very many links) is closed after a number of searches, because otherwise each of its thousands of neighbors
// would visit all others. This loses some constraints, and makes some longer than necessary. `frames` and `place`
// belong to the finer nodes.
LinkGraph graph_of_nodes(const LinkGraph& fine, double unit, const Selection& selection,
                         std::span<const RestFrame> frames, std::span<const Vec3> place, const Elasticity& elasticity) {
    const Neighbors neighbors = neighbors_of_nodes(fine, selection);
    LinkGraph graph{.offsets = {0}, .links = {}, .turns = fine.turns};
    graph.links.reserve(neighbors.of.items.size());
    LocalWays ways(fine);
    std::vector<Link> found;
    std::vector<std::uint32_t> goals;
    constexpr std::size_t hub_links = 64, hub_passes = 64;
    std::vector<std::uint8_t> passes(fine.size());
    const auto is_closed = [&](std::uint32_t at) {
        if (fine[at].size() <= hub_links) return false;
        if (passes[at] == hub_passes) return true;
        ++passes[at];
        return false;
    };
    for (std::uint32_t node = 0; node < neighbors.of.size(); ++node) {
        found.clear(), goals.clear();
        for (const std::uint32_t other : neighbors.of[node]) {
            found.push_back({other, unreached, unreached});
            goals.push_back(selection.chosen[other]);
        }
        const double limit = 1.000001 * neighbors.limit[node];  // a little more, for rounding
        const auto measure = [&]<double Link::*Measure>(double farthest) {
            const auto keep = [&](std::size_t i, double distance) { found[i].*Measure = distance; };
            ways.run<Measure>(selection.chosen[node], goals, std::min(farthest, 4 * spacing * unit), keep, is_closed);
        };
        // If threads turn, a limit is at most √2 times the length (two sides of a square stretched
        // along its diagonal), plus elasticity.
        measure.template operator()<&Link::limit>(fine.turns ? std::numbers::sqrt2 * (1 + elasticity.reserve()) * limit
                                                             : limit);
        if (fine.turns) measure.template operator()<&Link::length>(limit);
        for (const Link& link : found) {
            if (!(link.limit < unreached)) continue;
            const std::uint32_t a = selection.chosen[node], b = selection.chosen[link.to];
            Link& kept = graph.links.emplace_back(Link{link.to, std::min(link.length, link.limit), link.limit});
            straighten(kept, straight_line(frames[a], frames[b], place[b] - place[a]), elasticity, fine.turns);
        }
        graph.offsets.push_back(static_cast<std::uint32_t>(graph.links.size()));
    }
    return graph;
}

// Whether two other links together imply the limit of this one. The loop runs over the links of the end that has fewer,
// so that the links of a hub are not visited once per neighbor.
bool is_implied(const LinkGraph& graph, std::uint32_t from, const Link& link) {
    std::uint32_t few = from, many = link.to;
    if (graph[few].size() > graph[many].size()) std::swap(few, many);
    return std::ranges::any_of(graph[few], [&](const Link& first) {
        const Link* second = find_link(graph, many, first.to);
        return second && first.limit + second->limit <= 1.001 * link.limit;
    });
}

// `count`: number of coarse nodes.
Prolongation make_prolongation(std::span<const Parents> parents, std::span<const std::uint8_t> pinned,
                               std::uint32_t count) {
    Prolongation prolongation;
    prolongation.stride = padded(static_cast<std::uint32_t>(parents.size()));
    prolongation.weight.resize(std::size_t{Prolongation::parents} * prolongation.stride);
    const auto write = [&]<class Node>(AlignedVector<Node>& nodes) {
        nodes.resize(prolongation.weight.size());
        for (std::uint32_t i = 0; i < parents.size(); ++i) {
            for (std::uint32_t k = 0; k < parents[i].count && !pinned[i]; ++k) {
                const std::size_t at = std::size_t{k} * prolongation.stride + i;
                nodes[at] = static_cast<Node>(parents[i].node[k]);
                prolongation.weight[at] = static_cast<float>(parents[i].weight[k]);
            }
        }
    };
    constexpr std::uint32_t most_narrow = std::uint32_t{1} << 16;
    count <= most_narrow ? write(prolongation.narrow) : write(prolongation.wide);
    return prolongation;
}

// A hub may move thousands of finer nodes. The mean of the heaviest ones is accurate enough.
constexpr std::size_t most_members = 256;

struct Member {
    std::uint32_t node;
    double weight;
};

// The finer nodes whose mean is the position of a node, with normalized weights; empty if their weight is 0.
std::span<const Member> members_of(std::span<Member> members) {
    if (members.size() > most_members) {
        std::ranges::stable_sort(members, std::ranges::greater{}, &Member::weight);
        members = members.first(most_members);
        std::ranges::sort(members, {}, &Member::node);
    }
    double sum = 0;
    for (const Member& member : members) sum += member.weight;
    if (!(sum > 0)) return {};
    for (Member& member : members) member.weight /= sum;
    return members;
}

// `mass` belongs to the finer nodes. Pinned finer nodes belong to no mean.
Restriction restriction_of(std::span<const Parents> parents, std::span<const std::uint32_t> chosen,
                           std::span<const double> mass, std::span<const std::uint8_t> pinned) {
    const auto count = static_cast<std::uint32_t>(chosen.size());
    auto of_node = group_items<Member>(count, [&](auto put) {
        for (std::uint32_t i = 0; i < parents.size(); ++i) {
            for (std::uint32_t k = 0; k < parents[i].count && !pinned[i]; ++k) {
                if (pinned[chosen[parents[i].node[k]]]) continue;  // its position is its particle's
                put(parents[i].node[k], {i, parents[i].weight[k] * mass[i]});
            }
        }
    });
    std::vector<Member> itself(count);  // for nodes without other members
    std::vector<std::span<const Member>> lists(count);
    for (std::uint32_t node = 0; node < count; ++node) {
        itself[node] = {chosen[node], 1};
        const std::uint32_t begin = of_node.offsets[node], end = of_node.offsets[node + 1];
        lists[node] = members_of(std::span(of_node.items).subspan(begin, end - begin));
        if (lists[node].empty()) lists[node] = std::span(itself).subspan(node, 1);
    }
    Restriction restriction;
    restriction.begin.reserve(padded(count) / lane_padding + 1);
    restriction.begin.push_back(0);
    for (std::uint32_t first = 0; first < count; first += lane_padding) {
        std::size_t longest = 0;
        for (std::uint32_t node = first; node < std::min(first + lane_padding, count); ++node)
            longest = std::max(longest, lists[node].size());
        restriction.begin.push_back(restriction.begin.back() + static_cast<std::uint32_t>(longest));
    }
    restriction.node.resize(std::size_t{restriction.begin.back()} * lane_padding);
    restriction.weight.resize(restriction.node.size());
    for (std::uint32_t node = 0; node < count; ++node) {
        const std::uint32_t packet = node / lane_padding, begin = restriction.begin[packet];
        for (std::size_t k = 0; k < restriction.begin[packet + 1] - begin; ++k) {
            const Member member = k < lists[node].size() ? lists[node][k] : Member{lists[node][0].node, 0};
            const std::size_t at = (begin + k) * lane_padding + node % lane_padding;
            restriction.node[at] = member.node;
            restriction.weight[at] = static_cast<float>(member.weight);
        }
    }
    return restriction;
}

// Position of each node at rest: the mean of its members.
std::vector<Vec3> means_of(const Restriction& restriction, std::span<const Vec3> finer, std::uint32_t count) {
    std::vector<Vec3> means(count);
    for (std::uint32_t node = 0; node < count; ++node) {
        const std::uint32_t packet = node / lane_padding;
        for (std::uint32_t k = restriction.begin[packet]; k < restriction.begin[packet + 1]; ++k) {
            const std::size_t at = std::size_t{k} * lane_padding + node % lane_padding;
            means[node] += finer[restriction.node[at]] * restriction.weight[at];
        }
    }
    return means;
}

// How much longer the limit between a pin and another particle is.
struct Give {
    double length = 0, ease = 0;
};

Give give_between(const PinLoads& loads, std::uint32_t a, std::uint32_t b) {
    if (loads.empty() || loads.group[a] != loads.group[b]) return {};
    const std::uint32_t free = loads.give[a] > 0 ? a : b;  // pins have none
    return {loads.give[free], loads.ease[free]};
}

}  // namespace

Hierarchy build_hierarchy(const RestShape& rest, const Fabric& fabric, std::span<const Vec4> start,
                          FinestLevel finest) {
    Hierarchy result;
    std::vector<CoarseLevel>& levels = result.levels;
    if (rest.elasticity.reserve() > useless_reserve) return result;

    LinkGraph graph = graph_of_edges(rest, fabric);
    std::vector<RestFrame> frames = rest.frames;
    std::vector<std::uint32_t> particle(graph.size());
    std::vector<std::uint8_t> pinned(graph.size());
    std::vector<double> mass(graph.size());
    std::vector<Vec3> place = rest.topology.rest_positions, mean = place;
    for (std::uint32_t p = 0; p < graph.size(); ++p) {
        particle[p] = p;
        pinned[p] = !(start[p].w > 0);
        mass[p] = pinned[p] ? 0 : 1.0 / static_cast<double>(start[p].w);
    }
    PinLoads loads = find_pin_loads(graph, pinned_places(rest), mass, rest.mean_density,
                                    double{extent_of(rest.topology)}, rest.elasticity);
    while (true) {
        const bool far_apart = levels.empty() && finest == FinestLevel::every_fourth;
        const double unit = mean_length(graph) * (far_apart ? far : 1);
        const Selection selection = select_nodes(graph, unit, pinned);
        const auto count = static_cast<std::uint32_t>(selection.chosen.size());
        if (count < least_nodes || 4 * std::size_t{count} > 3 * graph.size()) break;
        CoarseLevel level{.count = count,
                          .particle = {},
                          .pinned = {},
                          .restriction = {},
                          .weight = {},
                          .limits = {},
                          .prolongation = {},
                          .ways = {}};
        level.prolongation = make_prolongation(selection.parents, pinned, count);
        level.restriction = restriction_of(selection.parents, selection.chosen, mass, pinned);
        std::vector<Vec3> means = means_of(level.restriction, mean, count);

        std::vector<double> node_mass(count);
        for (std::uint32_t i = 0; i < graph.size(); ++i) {
            const Parents& parents = selection.parents[i];
            for (std::uint32_t k = 0; k < parents.count; ++k) node_mass[parents.node[k]] += parents.weight[k] * mass[i];
        }
        std::vector<std::uint8_t> pinned_node(count);
        std::vector<std::uint32_t> nodes(count);
        std::vector<Vec3> places(count);
        level.particle.resize(padded(count));
        level.weight.resize(padded(count));
        for (std::uint32_t node = 0; node < count; ++node) {
            places[node] = place[selection.chosen[node]];
            pinned_node[node] = pinned[selection.chosen[node]];
            if (pinned_node[node]) level.pinned.push_back(node);
            nodes[node] = level.particle[node] = particle[selection.chosen[node]];
            level.weight[node] =
                pinned_node[node] || !(node_mass[node] > 0) ? 0 : static_cast<float>(1 / node_mass[node]);
        }
        LinkGraph coarse = graph_of_nodes(graph, unit, selection, frames, place, rest.elasticity);
        std::vector<RestFrame> kept_frames;
        for (const std::uint32_t node : selection.chosen) kept_frames.push_back(frames[node]);
        RowList rows = make_rows(ConstraintKind::coarse_limit);
        for (std::uint32_t node = 0; node < count; ++node) {
            for (const Link& link : coarse[node]) {
                if (link.to < node || is_implied(coarse, node, link)) continue;
                // Near borders and on irregular meshes, means are nearer to each other than their nodes, or farther
                // apart. The limit is scaled by the ratio, so that it neither pulls at the cloth at rest nor reduces
                // the stretch that it allows.
                const double apart = length(means[node] - means[link.to]);
                const StraightLine line =
                    straight_line(kept_frames[node], kept_frames[link.to], places[link.to] - places[node]);
                const Limit limit = limit_of(link, line, rest.elasticity, coarse.turns);
                const double least = pinned_node[node] || pinned_node[link.to] ? 1 : closest;
                const double allowed = link.length > 0 ? limit.length * std::max(least, apart / link.length) : apart;
                const Give give = pinned_node[node] != pinned_node[link.to]
                                      ? give_between(loads, nodes[node], nodes[link.to])
                                      : Give{};
                rows.add({node, link.to}, {static_cast<float>(allowed), static_cast<float>(limit.compliance),
                                           static_cast<float>(give.length), static_cast<float>(give.ease)});
            }
        }
        level.limits = pack_rows(ConstraintKind::coarse_limit, rows, count, coloring_of_level(count));
        level.ways = coarse;
        levels.push_back(std::move(level));
        graph = std::move(coarse);
        particle = std::move(nodes), pinned = std::move(pinned_node), mass = std::move(node_mass),
        place = std::move(places), mean = std::move(means), frames = std::move(kept_frames);
    }
    if (!levels.empty()) result.loads = std::move(loads);
    return result;
}

}  // namespace weft
