#include "collide/solid_surface.h"

#include "collide/closest_point.h"
#include "mesh/grouping.h"
#include "mesh/sound_triangles.h"
#include "mesh/weld.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace weft {
namespace {

// One use of an edge by a triangle, grouped by the lower corner.
struct EdgeUse {
    std::uint32_t high;      // the other corner
    std::uint32_t triangle;  // times 2, plus 1 if the triangle goes from the higher to the lower corner
    bool downward() const { return triangle & 1; }
    std::uint32_t number() const { return triangle >> 1; }
};

// Sets of triangles, each with its orientation relative to the first one of its set.
class OrientedSets {
  public:
    explicit OrientedSets(std::size_t count) : parent_(count), turned_(count, 0) {
        for (std::uint32_t i = 0; i < count; ++i) parent_[i] = i;
    }
    struct Place {
        std::uint32_t first;
        bool turned;
    };
    Place find(std::uint32_t i) {
        bool turned = false;
        while (parent_[i] != i) {
            const std::uint32_t up = parent_[i];
            if (parent_[up] != up) turned_[i] ^= turned_[up], parent_[i] = parent_[up];
            turned ^= turned_[i] != 0;
            i = parent_[i];
        }
        return {i, turned};
    }
    // Does nothing if both are in one set already.
    void merge(std::uint32_t a, std::uint32_t b, bool opposite) {
        const Place pa = find(a), pb = find(b);
        if (pa.first == pb.first) return;
        const std::uint32_t high = std::max(pa.first, pb.first);
        parent_[high] = std::min(pa.first, pb.first);
        turned_[high] = pa.turned != (pb.turned != opposite);
    }

  private:
    std::vector<std::uint32_t> parent_;
    std::vector<std::uint8_t> turned_;  // relative to the parent
};

struct Offset {
    double x, y, z;
    Offset(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
    Offset(Vec3 from, Vec3 to) : x(double{to.x} - from.x), y(double{to.y} - from.y), z(double{to.z} - from.z) {}
};
double dot(const Offset& a, const Offset& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Offset cross(const Offset& a, const Offset& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

double area_between(Vec3 a, Vec3 b, Vec3 c) {
    const Offset normal = cross(Offset(a, b), Offset(a, c));
    return 0.5 * std::sqrt(dot(normal, normal));
}

// To the point `t` of the way along `side` from where `to_start` leads.
double squared_distance_along(const Offset& to_start, const Offset& side, double t) {
    const Offset d(to_start.x + t * side.x, to_start.y + t * side.y, to_start.z + t * side.z);
    return dot(d, d);
}

// Ericson, "Real-Time Collision Detection", 2005, section 5.1.5: finds the corner, side or face that is nearest.
// Several times faster than closest_on_triangle(), but needs a triangle with an area.
double squared_distance_to_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
    const Offset ab(a, b), ac(a, c), pa(p, a), pb(p, b), pc(p, c);
    const double a_ab = -dot(ab, pa), a_ac = -dot(ac, pa);
    if (a_ab <= 0 && a_ac <= 0) return dot(pa, pa);
    const double b_ab = -dot(ab, pb), b_ac = -dot(ac, pb);
    if (b_ab >= 0 && b_ac <= b_ab) return dot(pb, pb);
    const double c_ab = -dot(ab, pc), c_ac = -dot(ac, pc);
    if (c_ac >= 0 && c_ab <= c_ac) return dot(pc, pc);
    if (a_ab * b_ac - b_ab * a_ac <= 0 && a_ab >= 0 && b_ab <= 0) {
        return squared_distance_along(pa, ab, a_ab / (a_ab - b_ab));
    }
    if (c_ab * a_ac - a_ab * c_ac <= 0 && a_ac >= 0 && c_ac <= 0) {
        return squared_distance_along(pa, ac, a_ac / (a_ac - c_ac));
    }
    const double b_bc = b_ac - b_ab, c_cb = c_ab - c_ac;
    if (b_ab * c_ac - c_ab * b_ac <= 0 && b_bc >= 0 && c_cb >= 0) {
        return squared_distance_along(pb, Offset(b, c), b_bc / (b_bc + c_cb));
    }
    const Offset normal = cross(ab, ac);
    const double height = dot(normal, pa);
    return height * height / dot(normal, normal);
}

// Calls visit(uses) with all uses of one edge, edge by edge. `low` is the edge's lower corner.
template <class Visit>
void for_each_edge(const Groups<EdgeUse>& edges, Visit&& visit) {
    for (std::uint32_t low = 0; low + 1 < edges.offsets.size(); ++low) {
        const auto all =
            std::span(edges.items).subspan(edges.offsets[low], edges.offsets[low + 1] - edges.offsets[low]);
        for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
            while (end < all.size() && all[end].high == all[begin].high) ++end;
            visit(low, all.subspan(begin, end - begin));
        }
    }
}

Groups<EdgeUse> edge_uses(const Weld& weld, std::span<const Triangle> triangles) {
    auto edges = group_items<EdgeUse>(static_cast<std::uint32_t>(weld.first_vertex.size()), [&](auto put) {
        for (std::uint32_t t = 0; t < triangles.size(); ++t) {
            const std::uint32_t corners[] = {weld.vertex_to_welded[triangles[t][0]],
                                             weld.vertex_to_welded[triangles[t][1]],
                                             weld.vertex_to_welded[triangles[t][2]]};
            if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t from = corners[i], to = corners[(i + 1) % 3];
                put(std::min(from, to), EdgeUse{std::max(from, to), 2 * t + (from > to ? 1u : 0u)});
            }
        }
    });
    for (std::size_t low = 0; low + 1 < edges.offsets.size(); ++low) {
        std::sort(edges.items.begin() + edges.offsets[low], edges.items.begin() + edges.offsets[low + 1],
                  [](const EdgeUse& a, const EdgeUse& b) {
                      return a.high < b.high || (a.high == b.high && a.triangle < b.triangle);
                  });
    }
    return edges;
}

// 1 for each triangle that must be turned around.
std::vector<std::uint8_t> triangles_to_flip(const Groups<EdgeUse>& edges, std::span<const Vec3> positions,
                                            std::span<const Triangle> triangles) {
    OrientedSets sets(triangles.size());
    for_each_edge(edges, [&](std::uint32_t, std::span<const EdgeUse> uses) {
        // Neighbors of the same orientation use their edge in opposite directions.
        if (uses.size() == 2) {
            sets.merge(uses[0].number(), uses[1].number(), uses[0].downward() == uses[1].downward());
        }
    });
    std::vector<double> balance(triangles.size(), 0);  // area of each set in the first one's orientation minus the rest
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const auto [first, turned] = sets.find(t);
        const auto [a, b, c] = triangles[t];
        const double area = area_between(positions[a], positions[b], positions[c]);
        balance[first] += turned ? -area : area;
    }
    std::vector<std::uint8_t> flip(triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const auto [first, turned] = sets.find(t);
        flip[t] = turned != (balance[first] < 0);
    }
    return flip;
}

std::vector<Bounds> bounds_around(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
    std::vector<Bounds> boxes(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (const std::uint32_t corner : triangles[t]) boxes[t].include(positions[corner]);
    }
    return boxes;
}

}  // namespace

OrientedTriangles orient_triangles(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
    const Weld weld = weld_vertices(positions, 0);
    const Groups<EdgeUse> edges = edge_uses(weld, triangles);
    const std::vector<std::uint8_t> flip = triangles_to_flip(edges, positions, triangles);
    OrientedTriangles oriented;
    for_each_edge(edges, [&](std::uint32_t low, std::span<const EdgeUse> uses) {
        int balance = 0;
        for (const EdgeUse& use : uses) balance += use.downward() != (flip[use.number()] != 0) ? -1 : 1;
        const std::array<std::uint32_t, 2> ends{weld.first_vertex[low], weld.first_vertex[uses[0].high]};
        oriented.boundary.insert(oriented.boundary.end(), static_cast<std::size_t>(std::abs(balance)), ends);
    });
    oriented.triangles.reserve(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto [a, b, c] = triangles[t];
        if (has_zero_area(positions[a], positions[b], positions[c])) {
            ++oriented.zero_area;
            continue;
        }
        oriented.flipped += flip[t];
        oriented.triangles.push_back(flip[t] ? Triangle{a, c, b} : Triangle{a, b, c});
    }
    return oriented;
}

SolidSurface::SolidSurface(std::vector<Vec3> positions, OrientedTriangles oriented, WorkerTeam& team)
    : positions_(std::move(positions)), oriented_(std::move(oriented)) {
    const auto build_triangle_tree = [&] { triangle_tree_ = Bvh(bounds_around(positions_, oriented_.triangles)); };
    const auto build_winding = [&] { winding_ = WindingNumber(positions_, oriented_.triangles); };
    team.run([&](unsigned worker) {
        if (worker == 0) build_triangle_tree();
        if (worker == 1 || team.size() == 1) build_winding();
    });
    std::vector<Bounds> boxes;
    for (const auto& [a, b] : oriented_.boundary) {
        Bounds& box = boxes.emplace_back();
        box.include(positions_[a]), box.include(positions_[b]);
        boundary_length_ += double{length(positions_[b] - positions_[a])};
    }
    boundary_tree_ = Bvh(boxes);
    constexpr double most_of_sheet = 0.25;
    is_sheet_ = !boxes.empty() && std::abs(mean_winding()) < most_of_sheet;
}

// By area, over some of the triangles.
double SolidSurface::mean_winding() const {
    constexpr std::size_t most_samples = 2000;
    const std::size_t step = (oriented_.triangles.size() + most_samples - 1) / most_samples;
    double sum = 0, total = 0;
    for (std::size_t t = 0; t < oriented_.triangles.size(); t += step) {
        const auto [a, b, c] = oriented_.triangles[t];
        const Vec3 &p = positions_[a], &q = positions_[b], &r = positions_[c];
        const double area = area_between(p, q, r);
        const Vec3 middle = (p + q + r) * (1.0f / 3),
                   up = normalized(cross(q - p, r - p)) * static_cast<float>(1e-3 * std::sqrt(area));
        sum += area * 0.5 * (winding(middle + up) + winding(middle - up));
        total += area;
    }
    return sum / total;
}

SolidSurface::Nearest SolidSurface::nearest(Vec3 point, std::uint32_t guess) const {
    Nearest found{std::numeric_limits<double>::infinity(), none};
    const auto visit = [&](std::uint32_t t) {
        const auto [a, b, c] = oriented_.triangles[t];
        const double d2 = squared_distance_to_triangle(point, positions_[a], positions_[b], positions_[c]);
        if (d2 < found.squared_distance) found = {d2, t};
        return found.squared_distance;
    };
    if (guess != none) visit(guess);
    triangle_tree_.for_each_nearest(point, found.squared_distance, visit);
    return found;
}

// Like a magnetic field of a current (the law of Biot and Savart), the gradient of the winding number depends only on
// the boundary of the surface: it is the integral of dl x r / (4 pi |r|^3) along it.
double SolidSurface::winding_gradient_bound(Vec3 center, double radius) const {
    if (oriented_.boundary.empty()) return 0;
    double least = std::numeric_limits<double>::infinity();
    boundary_tree_.for_each_nearest(center, least, [&](std::uint32_t e) {
        const Vec3 a = positions_[oriented_.boundary[e][0]], b = positions_[oriented_.boundary[e][1]];
        return least = std::min(least, closest_on_triangle(center, a, b, b).squared_distance);
    });
    const double gap = std::sqrt(least) - radius;
    if (!(gap > 0)) return std::numeric_limits<double>::infinity();
    return boundary_length_ / (4 * std::numbers::pi * gap * gap);
}

namespace {

using Corners3 = std::array<Vec3, 3>;

// Whether a plane across `axis` is between the triangles, with room for rounding.
bool separates(const Offset& axis, const Corners3& a, const Corners3& b) {
    double least[2], most[2];
    for (int side = 0; side < 2; ++side) {
        for (std::size_t k = 0; k < 3; ++k) {
            const double along = dot(axis, Offset(a[0], (side == 0 ? a : b)[k]));
            least[side] = k == 0 ? along : std::min(least[side], along);
            most[side] = k == 0 ? along : std::max(most[side], along);
        }
    }
    const double size = std::max({std::abs(least[0]), std::abs(most[0]), std::abs(least[1]), std::abs(most[1])});
    return std::max(least[1] - most[0], least[0] - most[1]) > 1e-9 * size;
}

// By the planes of both triangles and those along an edge of each. Triangles in one plane are not told apart.
bool are_apart(const Corners3& a, const Corners3& b) {
    const Offset of_a[] = {{a[0], a[1]}, {a[1], a[2]}, {a[2], a[0]}},
                 of_b[] = {{b[0], b[1]}, {b[1], b[2]}, {b[2], b[0]}};
    if (separates(cross(of_a[0], of_a[1]), a, b) || separates(cross(of_b[0], of_b[1]), a, b)) return true;
    for (const Offset& p : of_a)
        for (const Offset& q : of_b)
            if (separates(cross(p, q), a, b)) return true;
    return false;
}

}  // namespace

bool SolidSurface::may_touch(const std::array<Vec3, 3>& triangle) const {
    bool touches = false;
    triangle_tree_.for_each_overlap(bounds_of(triangle), [&](std::uint32_t t) {
        const auto& [a, b, c] = oriented_.triangles[t];
        touches = touches || !are_apart(triangle, {positions_[a], positions_[b], positions_[c]});
    });
    return touches;
}

double SolidSurface::distance_to_limit(Vec3 point, double winding) const {
    const auto [x, y, z] = winding_.gradient_at(point);
    return distance_from_limit(winding) / std::max(std::hypot(x, y, z), 1e-30);
}

// Where both balls of radius "distance" around two points cover the line between them, the line does not meet the
// surface, and the winding number changes along it at most by the bound on its gradient.
double SignedDistanceWalk::distance_at(Vec3 point) {
    const SolidSurface::Nearest found = surface_.nearest(point, nearest_);
    const double distance = std::sqrt(found.squared_distance), step = double{length(point - before_)};
    const bool clear = step < 0.999 * (distance + distance_before_) && nearest_ != none;
    if (clear) drift_ += step * gradient_bound_;
    // Twice the margin: the evaluated number has an error of up to one.
    const double spare = surface_.distance_from_limit(winding_) - 2 * SolidSurface::margin;
    if (!clear || !(drift_ < spare)) winding_ = surface_.winding(point), drift_ = 0;
    before_ = point, distance_before_ = distance, nearest_ = found.triangle;
    const double closing = distance_to_closing_surface(point, distance);
    if (surface_.is_sheet()) return distance_to_sheet(distance, closing);
    const double size = std::min(distance, closing);
    return surface_.is_inside(winding_) ? -size : size;
}

// A sheet is solid behind its triangles, as far as sheet_thickness and as the surface that closes its holes, which is
// part of the solid only near the triangles.
double SignedDistanceWalk::distance_to_sheet(double distance, double closing) const {
    const double beyond = distance - SolidSurface::sheet_thickness;
    if (!surface_.is_inside(winding_)) return std::min(distance, std::max(closing, beyond));
    return beyond < 0 ? -std::min({distance, closing, -beyond}) : beyond;
}

// Infinite where it is not needed: on closed surfaces, and where even the bound on the gradient lets the winding number
// reach the limit only farther away than the surface. Close to the surface it would make no difference.
double SignedDistanceWalk::distance_to_closing_surface(Vec3 point, double distance) {
    constexpr double close = 0.5;
    const double spare = surface_.distance_from_limit(winding_) - drift_ - SolidSurface::margin;
    if (distance < close || spare > distance * gradient_bound_) return std::numeric_limits<double>::infinity();
    if (drift_ > 0) winding_ = surface_.winding(point), drift_ = 0;
    return surface_.distance_to_limit(point, winding_);
}

}  // namespace weft
