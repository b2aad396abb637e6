// What holds one level of a hierarchy together, and ways along it: the ground that coarse levels are built on.
#pragma once

#include "physics/rest_shape.h"
#include "scene/fabric.h"

#include <algorithm>
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
    double reach = 0;   ///< m, as far as the two ends can come apart; at least `length`
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
        home,  ///< all is known
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
            if (go == Go::home) break;
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

}  // namespace weft
