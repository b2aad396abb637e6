// The graph of one level of the hierarchy, and shortest-path searches in it. Coarse levels are built from it.
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

/// A mesh edge on the finest graph, a constraint on a coarse level.
struct Link {
    std::uint32_t to = 0;
    double length = 0;  ///< m, along the surface at rest
    double limit = 0;   ///< m, ≥ `length`: largest distance of the two ends; longer if shear lets threads turn
};

/// Each link is stored with both of its ends. All links are in one array, because a search reads little else.
struct LinkGraph {
    std::vector<std::uint32_t> offsets = {0};  ///< links of node i: links[offsets[i] … offsets[i + 1])
    std::vector<Link> links = {};              ///< links of a node are sorted by `to`
    bool turns = true;                         ///< whether `limit` and `length` differ on any link

    std::uint32_t size() const { return static_cast<std::uint32_t>(offsets.size() - 1); }
    std::span<const Link> operator[](std::uint32_t node) const {
        return std::span(links).subspan(offsets[node], offsets[node + 1] - offsets[node]);
    }
};

LinkGraph graph_of_edges(const RestShape& rest, const Fabric& fabric);

/// Mean length of the links, m; 0 if there are none.
double mean_length(const LinkGraph& graph);

/// The link from `node` to `to`, or null.
const Link* find_link(const LinkGraph& graph, std::uint32_t node, std::uint32_t to);

/// Shortest paths in the neighborhood of a node (Dijkstra 1959). Keeps its arrays between calls, so that the cost of a
/// search depends on the visited nodes, not on the size of the graph.
class LocalSearch {
  public:
    enum class Go {
        on,
        back,  ///< do not search beyond this node
    };

    explicit LocalSearch(const LinkGraph& graph) : graph_(graph), distance_(graph.size(), unseen) {}

    /// Calls visit(node, distance) -> Go for all nodes within `limit`, nearest first, including `from` at distance 0.
    /// `Measure` is &Link::length or &Link::limit.
    template <double Link::*Measure, class Visit>
    void run(std::uint32_t from, double limit, Visit&& visit) {
        inverse_width_ = limit > 0 ? buckets / limit : 0;
        offer(from, 0);
        for (bucket_ = 0; bucket_ < buckets; ++bucket_) {
            auto& here = waiting_[bucket_];
            std::make_heap(here.begin(), here.end(), std::greater());
            while (!here.empty()) {
                const auto [d, node] = here.front();
                std::pop_heap(here.begin(), here.end(), std::greater());
                here.pop_back();
                if (d > distance_[node]) continue;
                const Go go = visit(node, d);
                if (go == Go::back) continue;
                for (const Link& link : graph_[node]) {
                    if (d + link.*Measure <= limit) offer(link.to, d + link.*Measure);
                }
            }
        }
        bucket_ = buckets;
        for (const std::uint32_t node : touched_) distance_[node] = unseen;
        touched_.clear();
    }

  private:
    static constexpr double unseen = std::numeric_limits<double>::infinity();

    void offer(std::uint32_t node, double d) {
        if (!(d < distance_[node])) return;
        if (distance_[node] == unseen) touched_.push_back(node);
        distance_[node] = d;
        const std::size_t bucket = std::min(static_cast<std::size_t>(d * inverse_width_), buckets - 1);
        auto& there = waiting_[bucket];
        there.emplace_back(d, node);
        if (bucket == bucket_) std::push_heap(there.begin(), there.end(), std::greater());
    }

    using Entry = std::pair<double, std::uint32_t>;
    static constexpr std::size_t buckets = 16;
    const LinkGraph& graph_;
    std::vector<double> distance_;
    std::vector<std::uint32_t> touched_;
    // Pending nodes are stored in buckets of distance. The nearest nonempty bucket is a heap.
    std::array<std::vector<Entry>, buckets> waiting_;
    std::size_t bucket_ = buckets;
    double inverse_width_ = 0;
};

/// Shortest paths to given goals, in any order of visits. Pending nodes are stored in buckets of distance instead of a
/// heap (Meyer, Sanders 2003, "Δ-stepping"); a node that was processed too early is processed again. The resulting
/// distances are those of LocalSearch.
class LocalWays {
  public:
    explicit LocalWays(const LinkGraph& graph) : graph_(graph), distance_(graph.size(), unreached) {}

    static constexpr double unreached = std::numeric_limits<double>::infinity();

    /// Calls found(i, distance) for every goal i within `limit`. Paths do not continue through nodes for which `closed`
    /// returns true, except `from`.
    template <double Link::*Measure, class Found, class Closed>
    void run(std::uint32_t from, std::span<const std::uint32_t> goals, double limit, Found&& found, Closed&& closed) {
        const double inverse_width = limit > 0 ? buckets / limit : 0;
        const auto bucket_of = [&](double d) {
            return std::min(static_cast<std::size_t>(d * inverse_width), buckets - 1);
        };
        if (waiting_.size() <= buckets) waiting_.resize(1024);
        std::array<std::uint32_t, buckets> last;  // of each bucket
        for (std::uint32_t bucket = 0; bucket < buckets; ++bucket) {
            waiting_[bucket].next = none;
            last[bucket] = bucket;
        }
        std::uint32_t count = buckets;
        waiting_[count] = {0, from, none};
        waiting_[0].next = last[0] = count++;
        distance_[from] = 0;
        std::size_t missing = goals.size();  // goals from this index on are known
        for (std::size_t bucket = 0; bucket < buckets && missing > 0; ++bucket) {
            for (std::uint32_t at = waiting_[bucket].next; at != none; at = waiting_[at].next) {
                const double d = waiting_[at].distance;
                const std::uint32_t node = waiting_[at].node;
                if (d > distance_[node] || (node != from && closed(node))) continue;
                const std::span<const Link> links = graph_[node];
                if (count + links.size() > waiting_.size()) waiting_.resize(2 * (count + links.size()));
                Waiting* const waiting = waiting_.data();
                double* const distance = distance_.data();
                for (const Link& link : links) {
                    const double along = d + link.*Measure;
                    if (!(along <= limit && along < distance[link.to])) continue;
                    distance[link.to] = along;
                    waiting[count] = {along, link.to, none};
                    std::uint32_t& end = last[bucket_of(along)];
                    waiting[end].next = count;
                    end = count++;
                }
            }
            const auto is_known = [&](std::uint32_t goal) {
                return distance_[goal] <= limit && bucket_of(distance_[goal]) <= bucket;
            };
            while (missing > 0 && is_known(goals[missing - 1])) --missing;
        }
        for (std::size_t i = 0; i < goals.size(); ++i) {
            if (distance_[goals[i]] < unreached) found(i, distance_[goals[i]]);
        }
        for (std::uint32_t i = buckets; i < count; ++i) distance_[waiting_[i].node] = unreached;
    }

  private:
    static constexpr std::size_t buckets = 16;

    // Element of a linked list. Each bucket has one list, in order of insertion; the first elements are the list heads.
    struct Waiting {
        double distance = 0;
        std::uint32_t node = 0, next = none;
    };
    const LinkGraph& graph_;
    std::vector<double> distance_;
    std::vector<Waiting> waiting_;
};

}  // namespace weft
