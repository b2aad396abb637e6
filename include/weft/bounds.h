// Axis-aligned bounding boxes.
#pragma once

#include <weft/vector.h>

#include <algorithm>
#include <limits>
#include <span>

namespace weft {

/// An axis-aligned box, in m. A new one is empty: `min` is +infinity and `max` is -infinity until a point is included.
struct Bounds {
    Vec3 min{std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(),
             std::numeric_limits<float>::infinity()};
    Vec3 max{-std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
             -std::numeric_limits<float>::infinity()};

    /// Grows the box to contain `p`.
    void include(Vec3 p) {
        min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
        max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
    }
    /// An empty box changes nothing.
    void include(const Bounds& b) {
        if (!b.empty()) include(b.min), include(b.max);
    }
    bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
    /// Points on the surface are inside.
    bool contains(Vec3 p) const {
        return p.x >= min.x && p.y >= min.y && p.z >= min.z && p.x <= max.x && p.y <= max.y && p.z <= max.z;
    }
    /// Boxes that only touch overlap.
    bool overlaps(const Bounds& b) const {
        return min.x <= b.max.x && b.min.x <= max.x && min.y <= b.max.y && b.min.y <= max.y && min.z <= b.max.z &&
               b.min.z <= max.z;
    }
    /// Zero for an empty box.
    Vec3 size() const { return empty() ? Vec3{} : max - min; }
    /// Zero for an empty box.
    Vec3 center() const { return empty() ? Vec3{} : (min + max) * 0.5f; }
    friend bool operator==(const Bounds&, const Bounds&) = default;
};

/// The smallest box that contains all points; empty if there are none.
inline Bounds bounds_of(std::span<const Vec3> points) {
    Bounds bounds;
    for (Vec3 p : points) bounds.include(p);
    return bounds;
}

}  // namespace weft
