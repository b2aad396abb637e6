#include "mesh/ordering.h"

#include "mesh/grouping.h"

#include <algorithm>
#include <cstddef>

namespace weft {
namespace {

// Files are often in a good order already: grids row by row, or meshes that a modeler or an optimizer exported in a
// cache-aware order. Renumbering those gains nothing and only separates particle numbers from the file's numbers, so
// the file's order stays unless the new mean span is clearly shorter than the noise between orders of equal quality.
// The mean span does not measure streaming access: a sheet in row order is read along a few parallel lines, which is as
// fast as a short span. For a mesh with such an order, switch TopologyOptions::reorder off.
constexpr double worthwhile_ratio = 0.9;

// Each sweep moves the start further out or ends the search; two or three are enough in practice. The bound keeps the
// time linear for unusual graphs.
constexpr int max_peripheral_sweeps = 8;

/// Neighbors of each particle, ascending.
Groups<std::uint32_t> neighbors_of(std::span<const Edge> edges, std::uint32_t particle_count) {
    return group_items<std::uint32_t>(particle_count, [&](auto put) {
        // One pass over both ends keeps the neighbors sorted: the edges (*, v) come before the edges (v, *).
        for (const Edge& e : edges) put(e.a, e.b), put(e.b, e.a);
    });
}

class Walker {
  public:
    Walker(std::span<const Edge> edges, std::uint32_t particle_count)
        : neighbors_(neighbors_of(edges, particle_count)), seen_(particle_count, 0) {
        queue_.reserve(particle_count);
    }

    bool placed(std::uint32_t particle) const { return seen_[particle] == placed_mark; }

    /// A particle at the periphery of the component of `start`. The component must not be placed yet.
    std::uint32_t pseudo_peripheral(std::uint32_t start) {
        std::uint32_t depth = 0;
        for (int sweep = 0; sweep < max_peripheral_sweeps; ++sweep) {
            const Levels levels = walk_levels(start);
            if (sweep > 0 && levels.depth <= depth) break;
            depth = levels.depth;
            start = *std::min_element(queue_.begin() + levels.last_begin, queue_.end(),
                                      [&](std::uint32_t p, std::uint32_t q) { return comes_first(p, q); });
        }
        return start;
    }

    /// The component of `start` in Cuthill-McKee order: breadth first, few neighbors first. Marks it as placed.
    std::span<const std::uint32_t> cuthill_mckee(std::uint32_t start) {
        queue_.assign(1, start);
        seen_[start] = placed_mark;
        for (std::size_t head = 0; head < queue_.size(); ++head) {
            const std::size_t first_new = queue_.size();
            for (const std::uint32_t q : neighbors(queue_[head])) {
                if (seen_[q] == placed_mark) continue;
                seen_[q] = placed_mark;
                queue_.push_back(q);
            }
            std::sort(queue_.begin() + static_cast<std::ptrdiff_t>(first_new), queue_.end(),
                      [&](std::uint32_t p, std::uint32_t q) { return comes_first(p, q); });
        }
        return queue_;
    }

  private:
    struct Levels {
        std::uint32_t depth;
        std::ptrdiff_t last_begin;  ///< of the last level in queue_
    };

    static constexpr std::uint32_t placed_mark = none;

    std::span<const std::uint32_t> neighbors(std::uint32_t p) const {
        return std::span(neighbors_.items)
            .subspan(neighbors_.offsets[p], neighbors_.offsets[std::size_t{p} + 1] - neighbors_.offsets[p]);
    }

    bool comes_first(std::uint32_t p, std::uint32_t q) const {
        const std::size_t degree_p = neighbors(p).size(), degree_q = neighbors(q).size();
        return degree_p != degree_q ? degree_p < degree_q : p < q;
    }

    Levels walk_levels(std::uint32_t start) {
        ++walk_;
        queue_.assign(1, start);
        seen_[start] = walk_;
        Levels levels{0, 0};
        for (std::size_t begin = 0, end = 1;; begin = end, end = queue_.size(), ++levels.depth) {
            levels.last_begin = static_cast<std::ptrdiff_t>(begin);
            for (std::size_t i = begin; i < end; ++i)
                for (const std::uint32_t q : neighbors(queue_[i])) {
                    if (seen_[q] == walk_) continue;
                    seen_[q] = walk_;
                    queue_.push_back(q);
                }
            if (queue_.size() == end) return levels;
        }
    }

    Groups<std::uint32_t> neighbors_;
    std::vector<std::uint32_t> seen_;  ///< the last walk that visited the particle, or placed_mark
    std::vector<std::uint32_t> queue_;
    std::uint32_t walk_ = 0;
};

}  // namespace

double mean_edge_span(std::span<const Edge> edges) {
    if (edges.empty()) return 0;
    std::uint64_t sum = 0;
    for (const Edge& e : edges) sum += e.b > e.a ? e.b - e.a : e.a - e.b;
    return static_cast<double>(sum) / static_cast<double>(edges.size());
}

std::vector<std::uint32_t> reverse_cuthill_mckee(std::span<const Edge> edges, std::uint32_t particle_count) {
    Walker walker(edges, particle_count);
    std::vector<std::uint32_t> new_number(particle_count);
    std::uint32_t placed = 0;
    for (std::uint32_t particle = 0; particle < particle_count; ++particle) {
        if (walker.placed(particle)) continue;
        const auto component = walker.cuthill_mckee(walker.pseudo_peripheral(particle));
        placed += static_cast<std::uint32_t>(component.size());
        for (std::uint32_t i = 0; i < component.size(); ++i) new_number[component[i]] = placed - 1 - i;
    }
    return new_number;
}

std::vector<std::uint32_t> better_order(std::span<const Edge> edges, std::uint32_t particle_count) {
    std::vector<std::uint32_t> new_number = reverse_cuthill_mckee(edges, particle_count);
    std::vector<Edge> renumbered(edges.begin(), edges.end());
    for (Edge& e : renumbered) e.a = new_number[e.a], e.b = new_number[e.b];
    if (mean_edge_span(renumbered) < worthwhile_ratio * mean_edge_span(edges)) return new_number;
    return {};
}

}  // namespace weft
