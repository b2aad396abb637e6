#include "collide/bvh.h"

#include <cassert>
#include <numeric>

namespace weft {
namespace {

float along(Vec3 v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

int longest_axis(Vec3 size) {
    if (size.x >= size.y && size.x >= size.z) return 0;
    return size.y >= size.z ? 1 : 2;
}

}  // namespace

Bvh::Bvh(std::span<const Bounds> boxes) : items_(boxes.size()), boxes_(boxes.size()) {
    std::iota(items_.begin(), items_.end(), 0u);
    std::vector<Vec3> centers;
    centers.reserve(boxes.size());
    for (const Bounds& box : boxes) centers.push_back(box.center());
    nodes_.reserve(boxes.size());
    if (!boxes.empty()) build(0, size(), boxes, centers);
    refit(boxes);
}

// Recursion is safe here: the depth is that of a perfectly balanced tree.
void Bvh::build(std::uint32_t first, std::uint32_t count, std::span<const Bounds> boxes,
                std::span<const Vec3> centers) {
    const std::size_t self = nodes_.size();
    nodes_.push_back({.bounds = {}, .skip = 0, .first = first, .count = count <= leaf_size ? count : 0});
    if (count > leaf_size) {
        Bounds spread;
        for (std::uint32_t k = first; k < first + count; ++k) {
            if (!boxes[items_[k]].empty()) spread.include(centers[items_[k]]);
        }
        const int axis = longest_axis(spread.size());
        const auto closer = [&](std::uint32_t a, std::uint32_t b) {
            const float ca = along(centers[a], axis), cb = along(centers[b], axis);
            return ca < cb || (ca == cb && a < b);  // a total order: the tree depends only on the boxes
        };
        const auto begin = items_.begin() + first;
        std::nth_element(begin, begin + count / 2, begin + count, closer);
        build(first, count / 2, boxes, centers);
        build(first + count / 2, count - count / 2, boxes, centers);
    }
    nodes_[self].skip = static_cast<std::uint32_t>(nodes_.size());
}

void Bvh::refit(std::span<const Bounds> boxes) {
    assert(boxes.size() == items_.size());
    for (std::size_t k = 0; k < items_.size(); ++k) boxes_[k] = boxes[items_[k]];
    for (std::size_t n = nodes_.size(); n-- > 0;) {  // children come after their parents
        Node& node = nodes_[n];
        node.bounds = {};
        for (std::uint32_t k = node.first; k < node.first + node.count; ++k) node.bounds.include(boxes_[k]);
        if (node.count > 0) continue;
        const std::size_t left = n + 1;
        node.bounds.include(nodes_[left].bounds);
        node.bounds.include(nodes_[nodes_[left].skip].bounds);
    }
}

}  // namespace weft
