#include "collide/hull_builder.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace weft {
namespace {

__extension__ using Int128 = __int128;

struct GridVector {
    std::int64_t x, y, z;
};

GridVector between(GridPoint from, GridPoint to) {
    return {std::int64_t{to.x} - from.x, std::int64_t{to.y} - from.y, std::int64_t{to.z} - from.z};
}

GridVector exact_cross(GridVector a, GridVector b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

double rounded_length(GridVector v) {
    const auto x = static_cast<double>(v.x), y = static_cast<double>(v.y), z = static_cast<double>(v.z);
    return std::sqrt(x * x + y * y + z * z);
}

bool comes_first(GridPoint a, GridPoint b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

/// The point whose measure is largest. Of equal ones, the first one in the order of coordinates: it is a vertex of the
/// hull, while one between others would be a vertex in the middle of a face.
template <class Measure>
std::uint32_t most_extreme(std::span<const GridPoint> points, Measure&& measure) {
    std::uint32_t best = 0;
    double most = -1;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const double value = measure(i);
        if (value < most || (value == most && !comes_first(points[i], points[best]))) continue;
        most = value;
        best = i;
    }
    return best;
}

}  // namespace

HullBuilder::HullBuilder(std::span<const GridPoint> points, double tolerance) : points_(points), tolerance_(tolerance) {
    if (start()) shape_ = Shape::volume;
}

// The rounding is far below a step: 2^-51 of the 2^25 steps that a point can be away.
double HullBuilder::distance(const Facet& facet, std::uint32_t point) const {
    const GridVector d = between(points_[facet.corners[0]], points_[point]);
    return (static_cast<double>(facet.normal[0]) * static_cast<double>(d.x) +
            static_cast<double>(facet.normal[1]) * static_cast<double>(d.y) +
            static_cast<double>(facet.normal[2]) * static_cast<double>(d.z)) /
           facet.length;
}

bool HullBuilder::in_front(const Facet& facet, std::uint32_t point) const {
    const GridVector d = between(points_[facet.corners[0]], points_[point]);
    return Int128{facet.normal[0]} * d.x + Int128{facet.normal[1]} * d.y + Int128{facet.normal[2]} * d.z > 0;
}

std::uint32_t HullBuilder::make_facet(const Triangle& corners) {
    Facet facet{.corners = corners};
    const GridVector n = exact_cross(between(points_[corners[0]], points_[corners[1]]),
                                     between(points_[corners[0]], points_[corners[2]]));
    facet.normal = {n.x, n.y, n.z};
    facet.length = rounded_length(n);
    assert(facet.length > 0);
    facets_.push_back(std::move(facet));
    ++live_;
    return static_cast<std::uint32_t>(facets_.size() - 1);
}

void HullBuilder::put_outside(std::uint32_t facet, std::uint32_t point, double distance) {
    Facet& f = facets_[facet];
    f.outside.push_back(point);
    const bool farther = f.farthest == none || distance > f.farthest_distance ||
                         (distance == f.farthest_distance && comes_first(points_[point], points_[f.farthest]));
    if (!farther) return;
    f.farthest = point;
    f.farthest_distance = distance;
}

// Puts each point into the list of the first facet, from `first_facet` on, that it is in front of. A point in front of
// none of the new facets is inside: it was in front of a removed facet, and the new ones form a cone around that part.
void HullBuilder::distribute(std::span<const std::uint32_t> points, std::size_t first_facet) {
    for (const std::uint32_t point : points) {
        for (std::size_t f = first_facet; f < facets_.size(); ++f) {
            const double d = distance(facets_[f], point);
            if (!(d > tolerance_)) continue;
            put_outside(static_cast<std::uint32_t>(f), point, d);
            break;
        }
    }
}

// Makes the first tetrahedron, large in every direction. False if the points have no volume.
bool HullBuilder::start() {
    const std::uint32_t a = most_extreme(points_, [](std::uint32_t) { return 0.0; });
    const auto from_a = [&](std::uint32_t p) { return between(points_[a], points_[p]); };
    const auto from_point = [&](std::uint32_t p) { return rounded_length(from_a(p)); };
    const std::uint32_t b = most_extreme(points_, from_point);
    thickness_ = from_point(b);
    if (!(thickness_ > tolerance_)) return false;

    shape_ = Shape::line;
    const GridVector ab = from_a(b);
    const double ab_length = rounded_length(ab);
    const auto from_line = [&](std::uint32_t p) { return rounded_length(exact_cross(ab, from_a(p))) / ab_length; };
    const std::uint32_t c = most_extreme(points_, from_line);
    thickness_ = from_line(c);
    if (!(thickness_ > tolerance_)) return false;

    shape_ = Shape::plane;
    make_facet({a, b, c});
    const auto from_plane = [&](std::uint32_t p) { return std::abs(distance(facets_[0], p)); };
    const std::uint32_t d = most_extreme(points_, from_plane);
    thickness_ = from_plane(d);
    if (!(thickness_ > tolerance_)) return false;

    const bool above = in_front(facets_[0], d);
    facets_.clear();
    live_ = 0;
    const Triangle base = above ? Triangle{a, c, b} : Triangle{a, b, c};
    make_facet(base);
    for (std::size_t i = 0; i < 3; ++i) make_facet({base[(i + 1) % 3], base[i], d});
    for (std::uint32_t i = 0; i < 3; ++i) {
        facets_[0].neighbors[i] = 1 + i;
        facets_[1 + i].neighbors = {0, 1 + (i + 2) % 3, 1 + (i + 1) % 3};
    }
    thickness_ = 0;
    std::vector<std::uint32_t> all(points_.size());
    std::iota(all.begin(), all.end(), 0u);
    distribute(all, 0);
    return true;
}

// Removes the facets that the point is in front of, collects the points outside them and the edges around the hole. The
// visible facets are connected, because the hull is convex.
void HullBuilder::remove_visible(std::uint32_t first, std::uint32_t point) {
    horizon_.clear();
    orphans_.clear();
    open_facets_.assign(1, first);
    facets_[first].removed = true;
    for (std::size_t i = 0; i < open_facets_.size(); ++i) {
        Facet& facet = facets_[open_facets_[i]];
        --live_;
        orphans_.insert(orphans_.end(), facet.outside.begin(), facet.outside.end());
        facet.outside = {};
        for (std::size_t side = 0; side < 3; ++side) {
            const std::uint32_t next = facet.neighbors[side];
            if (facets_[next].removed) continue;
            if (!in_front(facets_[next], point)) continue;
            facets_[next].removed = true;
            open_facets_.push_back(next);
        }
    }
    for (const std::uint32_t f : open_facets_)
        for (std::size_t side = 0; side < 3; ++side) {
            const Facet& facet = facets_[f];
            if (!facets_[facet.neighbors[side]].removed)
                horizon_.push_back({facet.corners[side], facet.corners[(side + 1) % 3], facet.neighbors[side]});
        }
}

void HullBuilder::add(std::uint32_t seen_from) {
    const std::uint32_t point = facets_[seen_from].farthest;
    remove_visible(seen_from, point);
    // The horizon is one closed line: one edge starts at each of its vertices.
    std::ranges::sort(horizon_, {}, &HorizonEdge::from);
    const auto first = static_cast<std::uint32_t>(facets_.size());
    for (const HorizonEdge& edge : horizon_) {
        const std::uint32_t made = make_facet({edge.from, edge.to, point});
        facets_[made].neighbors[0] = edge.outer;
        Facet& outer = facets_[edge.outer];
        for (std::size_t side = 0; side < 3; ++side)
            if (outer.corners[side] == edge.to) outer.neighbors[side] = made;
    }
    for (std::uint32_t i = 0; i < horizon_.size(); ++i) {
        const auto next = std::ranges::lower_bound(horizon_, horizon_[i].to, {}, &HorizonEdge::from);
        assert(next != horizon_.end() && next->from == horizon_[i].to);
        const std::uint32_t other = first + static_cast<std::uint32_t>(next - horizon_.begin());
        facets_[first + i].neighbors[1] = other;
        facets_[other].neighbors[2] = first + i;
    }
    distribute(orphans_, first);
}

void HullBuilder::grow(std::size_t max_vertices) {
    // A closed surface of triangles with v vertices has 2v - 4 of them (Euler).
    while (shape_ == Shape::volume && live_ / 2 + 2 < max_vertices) {
        std::uint32_t best = none;
        for (std::uint32_t f = 0; f < facets_.size(); ++f) {
            const Facet& facet = facets_[f];
            if (facet.removed || facet.farthest == none) continue;
            if (best == none || facet.farthest_distance > facets_[best].farthest_distance) best = f;
        }
        if (best == none) return;
        add(best);
    }
}

}  // namespace weft
