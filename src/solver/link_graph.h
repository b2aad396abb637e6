// What holds one level of a hierarchy together, and ways along it: the ground that coarse levels are built on.
#pragma once

#include "physics/rest_shape.h"
#include "scene/fabric.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace weft {

/// For the particles an edge, for a coarse level a row.
struct Link {
    std::uint32_t to = 0;
    double length = 0;  ///< m, along the surface at rest
    double reach = 0;   ///< m, at least `length`: where threads turn, as far as the two ends can come apart
};

/// A link stands with both of its ends. One array for all of them, as a search reads little else.
struct LinkGraph {
    std::vector<std::uint32_t> offsets = {0};  ///< links of node i: links[offsets[i] … offsets[i + 1])
    std::vector<Link> links = {};              ///< those of a node ascending by `to`
    bool turns = true;                         ///< whether reach and length differ anywhere

    std::uint32_t size() const { return static_cast<std::uint32_t>(offsets.size() - 1); }
    std::span<const Link> operator[](std::uint32_t node) const {
        return std::span(links).subspan(offsets[node], offsets[node + 1] - offsets[node]);
    }
};

LinkGraph graph_of_edges(const RestShape& rest, const Fabric& fabric);

/// 0 if there is none.
double mean_length(const LinkGraph& graph);

/// The link from `node` to `to`, or null.
const Link* find_link(const LinkGraph& graph, std::uint32_t node, std::uint32_t to);

/// Shortest ways in the neighborhood of a node (Dijkstra 1959). Keeps its arrays from call to call, so that a search
/// costs what it visits and not what there is.
class LocalSearch {
  public:
    enum class Go {
        on,
        back,  ///< not beyond this node
    };

    explicit LocalSearch(const LinkGraph& graph) : graph_(graph), distance_(graph.size(), unseen) {}

    /// visit(node, distance) -> Go, the nearest first, itself at 0 among them, none farther than `limit`. `Measure` is
    /// &Link::length or &Link::reach.
    template <double Link::*Measure, class Visit>
    void run(std::uint32_t from, double limit, Visit&& visit) {
        offer(from, 0);
        while (!queue_.empty()) {
            const auto [d, node] = queue_.front();
            std::pop_heap(queue_.begin(), queue_.end(), std::greater());
            queue_.pop_back();
            if (d > distance_[node]) continue;
            const Go go = visit(node, d);
            if (go == Go::back) continue;
            for (const Link& link : graph_[node]) {
                if (d + link.*Measure <= limit) offer(link.to, d + link.*Measure);
            }
        }
        queue_.clear();
        for (const std::uint32_t node : touched_) distance_[node] = unseen;
        touched_.clear();
    }

  private:
    static constexpr double unseen = std::numeric_limits<double>::infinity();

    void offer(std::uint32_t node, double d) {
        if (!(d < distance_[node])) return;
        if (distance_[node] == unseen) touched_.push_back(node);
        distance_[node] = d;
        queue_.emplace_back(d, node);
        std::push_heap(queue_.begin(), queue_.end(), std::greater());
    }

    using Entry = std::pair<double, std::uint32_t>;
    const LinkGraph& graph_;
    std::vector<double> distance_;
    std::vector<std::uint32_t> touched_;
    std::vector<Entry> queue_;
};

/// The same where the goals are known and the order of visits is no matter: nodes wait in buckets of distance in place
/// of a heap (Meyer, Sanders 2003, "Δ-stepping"), and a node that was taken too early is taken again. What a shortest
/// way adds up to is the same.
class LocalWays {
  public:
    explicit LocalWays(const LinkGraph& graph) : graph_(graph), distance_(graph.size(), unreached) {}

    static constexpr double unreached = std::numeric_limits<double>::infinity();

    /// found(i, distance) for every goal within `limit`. No way leads on from nodes, `from` excepted, that are closed.
    template <double Link::*Measure, class Found, class Closed>
    void run(std::uint32_t from, std::span<const std::uint32_t> goals, double limit, Found&& found, Closed&& closed) {
        const double inverse_width = limit > 0 ? buckets / limit : 0;
        const auto bucket_of = [&](double d) {
            return std::min(static_cast<std::size_t>(d * inverse_width), buckets - 1);
        };
        distance_[from] = 0;
        touched_.push_back(from);
        waiting_[0].push_back({0, from});
        std::size_t missing = goals.size();  // from the last one on, all others are known
        for (std::size_t bucket = 0; bucket < buckets && missing > 0; ++bucket) {
            for (std::size_t i = 0; i < waiting_[bucket].size(); ++i) {
                const auto [d, node] = waiting_[bucket][i];
                if (d > distance_[node] || (node != from && closed(node))) continue;
                for (const Link& link : graph_[node]) {
                    const double along = d + link.*Measure;
                    if (!(along <= limit && along < distance_[link.to])) continue;
                    if (distance_[link.to] == unreached) touched_.push_back(link.to);
                    distance_[link.to] = along;
                    waiting_[bucket_of(along)].push_back({along, link.to});
                }
            }
            const auto is_known = [&](std::uint32_t goal) {
                return distance_[goal] <= limit && bucket_of(distance_[goal]) <= bucket;
            };
            while (missing > 0 && is_known(goals[missing - 1])) --missing;
        }
        for (auto& bucket : waiting_) bucket.clear();
        for (std::size_t i = 0; i < goals.size(); ++i) {
            if (distance_[goals[i]] < unreached) found(i, distance_[goals[i]]);
        }
        for (const std::uint32_t node : touched_) distance_[node] = unreached;
        touched_.clear();
    }

  private:
    static constexpr std::size_t buckets = 16;

    struct Waiting {
        double distance;
        std::uint32_t node;
    };
    const LinkGraph& graph_;
    std::vector<double> distance_;
    std::vector<std::uint32_t> touched_;
    std::array<std::vector<Waiting>, buckets> waiting_;
};

}  // namespace weft
