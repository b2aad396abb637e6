// A bounding volume hierarchy over boxes. Finds the boxes that overlap a given box, and all pairs that overlap.
#pragma once

#include <weft/bounds.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace weft {

/// A binary tree over numbered boxes. The same boxes give the same tree and the same order of visits. Empty boxes
/// overlap nothing; all others must be finite.
class Bvh {
  public:
    Bvh() = default;
    /// Splits at the median of the boxes' centers along the longest axis, so the depth is at most log2 of their number.
    explicit Bvh(std::span<const Bounds> boxes);

    /// Replaces the boxes without rebuilding the tree; needs as many boxes as before. Results are correct for any
    /// boxes. Queries stay fast while boxes that were close stay close.
    void refit(std::span<const Bounds> boxes);

    /// Depth-first order: the left child is the next node, the right child follows the left subtree. A traversal that
    /// has finished or rejected a node continues at `skip`, so it needs no stack.
    struct Node {
        Bounds bounds;
        std::uint32_t skip = 0;
        std::uint32_t first = 0;  ///< of the node's entries in items() and boxes()
        std::uint32_t count = 0;  ///< 0: an inner node
    };
    /// The largest count of a leaf. On a crumpled cloth of 70 000 triangles, sizes 2, 4 and 8 take the same time within
    /// 3 %. Larger leaves make smaller trees.
    static constexpr std::uint32_t leaf_size = 4;

    // For backends that search on a device.
    std::span<const Node> nodes() const { return nodes_; }
    std::span<const std::uint32_t> items() const { return items_; }
    std::span<const Bounds> boxes() const { return boxes_; }

    std::uint32_t size() const { return static_cast<std::uint32_t>(items_.size()); }
    Bounds bounds() const { return nodes_.empty() ? Bounds{} : nodes_[0].bounds; }

    /// Calls visit(i) for every box i that overlaps `box`, touching included.
    template <class Visit>
    void for_each_overlap(const Bounds& box, Visit&& visit) const {
        walk(0, box, [&](const Node& leaf) {
            for (std::uint32_t k = leaf.first; k < leaf.first + leaf.count; ++k) {
                if (boxes_[k].overlaps(box)) visit(items_[k]);
            }
        });
    }

    /// Calls visit(i, j), i < j, once for every two boxes that overlap, touching included.
    template <class Visit>
    void for_each_pair(Visit&& visit) const {
        for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
            const Node& leaf = nodes_[n];
            if (leaf.count == 0) continue;
            for (std::uint32_t k = leaf.first; k < leaf.first + leaf.count; ++k) {
                test_pairs(k, k + 1, leaf.first + leaf.count, visit);
            }
            // Nodes are in depth-first order: all leaves not yet paired with this one come after it.
            walk(leaf.skip, leaf.bounds, [&](const Node& other) {
                for (std::uint32_t k = leaf.first; k < leaf.first + leaf.count; ++k) {
                    test_pairs(k, other.first, other.first + other.count, visit);
                }
            });
        }
    }

    /// m², exact but for the rounding of doubles; infinite to an empty box.
    static double squared_distance(const Bounds& box, Vec3 p) {
        const auto gap = [](float min, float max, float x) {
            return std::max({double{min} - double{x}, 0.0, double{x} - double{max}});
        };
        const double x = gap(box.min.x, box.max.x, p.x), y = gap(box.min.y, box.max.y, p.y),
                     z = gap(box.min.z, box.max.z, p.z);
        return x * x + y * y + z * z;
    }

    /// Calls visit(i) for boxes whose squared distance to `point` is at most `limit` (m²), nearer parts of the tree
    /// first. visit() returns a new limit, used if it is smaller. Boxes exactly at the limit are visited too, so the
    /// caller sees every tie.
    template <class Visit>
    void for_each_nearest(Vec3 point, double limit, Visit&& visit) const {
        struct Pending {
            std::uint32_t node;
            double distance;
        };
        std::array<Pending, max_depth + 1> pending;  // one sibling for each level above, and the node itself
        std::size_t count = 0;
        const auto put = [&](std::uint32_t node) {
            pending[count++] = {node, squared_distance(nodes_[node].bounds, point)};
        };
        if (!nodes_.empty()) put(0);
        while (count > 0) {
            const auto [n, distance] = pending[--count];
            if (distance > limit) continue;
            const Node& node = nodes_[n];
            for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
                if (boxes_[k].empty() || squared_distance(boxes_[k], point) > limit) continue;
                limit = std::min(limit, visit(items_[k]));
            }
            if (node.count > 0) continue;
            put(n + 1), put(nodes_[n + 1].skip);
            if (pending[count - 1].distance > pending[count - 2].distance) {
                std::swap(pending[count - 1], pending[count - 2]);
            }
        }
    }

  private:
    /// Each level halves the number of boxes, which has 32 bits.
    static constexpr std::size_t max_depth = 32;

    template <class VisitLeaf>
    void walk(std::uint32_t from, const Bounds& box, VisitLeaf&& visit_leaf) const {
        for (std::uint32_t n = from; n < nodes_.size();) {
            const Node& node = nodes_[n];
            const bool overlaps = node.bounds.overlaps(box);
            if (overlaps && node.count > 0) visit_leaf(node);
            n = overlaps ? n + 1 : node.skip;
        }
    }

    template <class Visit>
    void test_pairs(std::uint32_t k, std::uint32_t begin, std::uint32_t end, Visit& visit) const {
        for (std::uint32_t other = begin; other < end; ++other) {
            if (!boxes_[k].overlaps(boxes_[other])) continue;
            visit(items_[k] < items_[other] ? items_[k] : items_[other],
                  items_[k] < items_[other] ? items_[other] : items_[k]);
        }
    }

    void build(std::uint32_t first, std::uint32_t count, std::span<const Bounds> boxes, std::span<const Vec3> centers);

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> items_;  // numbers of the boxes, leaf by leaf
    std::vector<Bounds> boxes_;         // the boxes in that order: neighbors in space are neighbors in memory
};

}  // namespace weft
