#include "solver/measures/passages.h"

#include "base/copies.h"
#include "collide/bvh.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace weft {
namespace {

constexpr float turn_per_step = 0.2f;  // rad
constexpr std::uint32_t most_turn_steps = 16;

struct Wide3 {
    double x, y, z;
};
Wide3 difference(Vec3 a, Vec3 b) {
    return {double{a.x} - double{b.x}, double{a.y} - double{b.y}, double{a.z} - double{b.z}};
}
Wide3 mixed(const Wide3& a, const Wide3& b, double t) {
    return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t};
}
Wide3 crossed(const Wide3& a, const Wide3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double dotted(const Wide3& a, const Wide3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// The corners of the triangle as seen from the point.
struct MovingTriangle {
    std::array<Wide3, 3> start, end;

    std::array<Wide3, 3> at(double t) const {
        return {mixed(start[0], end[0], t), mixed(start[1], end[1], t), mixed(start[2], end[2], t)};
    }
    double volume(double t) const {
        const auto [a, b, c] = at(t);
        return dotted(a, crossed(b, c));
    }
    // The point must be in the plane of the triangle. Its sides belong to it.
    bool contains_point(double t) const {
        const auto [a, b, c] = at(t);
        const Wide3 ab = crossed(a, b), bc = crossed(b, c), ca = crossed(c, a);
        const Wide3 n{ab.x + bc.x + ca.x, ab.y + bc.y + ca.y, ab.z + bc.z + ca.z};
        const double n2 = dotted(n, n);
        if (!(n2 > 0)) return false;
        const double slack = -1e-6 * n2;
        return dotted(ab, n) >= slack && dotted(bc, n) >= slack && dotted(ca, n) >= slack;
    }
};

float angle_between(const Mat3& a, const Mat3& b) {
    const float trace = dot(a.x, b.x) + dot(a.y, b.y) + dot(a.z, b.z);
    return std::acos(std::clamp(0.5f * (trace - 1), -1.0f, 1.0f));
}

std::uint32_t turn_steps(const Pose& from, const Pose& to) {
    const float steps = std::ceil(angle_between(from.rotation, to.rotation) / turn_per_step);
    return static_cast<std::uint32_t>(std::clamp(steps, 1.0f, static_cast<float>(most_turn_steps)));
}

Bounds swept_box(const Bounds& box, const Pose& from, const Pose& to, std::uint32_t steps) {
    Bounds swept;
    for (std::uint32_t k = 0; k <= steps; ++k)
        swept.include(to_world(between(from, to, static_cast<float>(k) / static_cast<float>(steps)), box));
    // Between two steps, a point is off their chord by less than its way times the angle.
    const float slack = 1e-5f * std::max({1.0f, length(swept.min), length(swept.max)}) +
                        (steps > 1 ? turn_per_step * length(swept.size()) : 0);
    return {swept.min - Vec3{slack, slack, slack}, swept.max + Vec3{slack, slack, slack}};
}

}  // namespace

// The volume of the tetrahedron of the point and the triangle is a cubic in time, and 0 when the point is in the plane.
// Between its extremes it has at most one root, which bisection finds.
std::optional<double> time_of_sweep(Vec3 point, const Vec3 (&start)[3], const Vec3 (&end)[3]) {
    MovingTriangle triangle;
    for (std::size_t k = 0; k < 3; ++k) {
        triangle.start[k] = difference(start[k], point);
        triangle.end[k] = difference(end[k], point);
    }
    const double v0 = triangle.volume(0), v1 = triangle.volume(1.0 / 3), v2 = triangle.volume(2.0 / 3),
                 v3 = triangle.volume(1);
    if (!std::isfinite(v0 + v1 + v2 + v3)) return std::nullopt;
    // The cubic through the four values, by powers of t.
    const double c1 = -5.5 * v0 + 9 * v1 - 4.5 * v2 + v3, c2 = 9 * v0 - 22.5 * v1 + 18 * v2 - 4.5 * v3,
                 c3 = -4.5 * v0 + 13.5 * v1 - 13.5 * v2 + 4.5 * v3;
    std::array<double, 4> ends{0, 1, 1, 1};
    std::size_t count = 1;
    const double root = c2 * c2 - 3 * c1 * c3;
    if (root > 0) {
        const double q = -(c2 + std::copysign(std::sqrt(root), c2));
        std::array<double, 2> extremes{q / (3 * c3), c1 / q};
        if (extremes[0] > extremes[1]) std::swap(extremes[0], extremes[1]);
        for (const double t : extremes)
            if (t > 0 && t < 1) ends[count++] = t;
    }
    ends[count] = 1;
    for (std::size_t k = 0; k < count; ++k) {
        double low = ends[k], high = ends[k + 1];
        const bool low_side = triangle.volume(low) > 0;
        // A point in the plane at the start belongs to the frame before.
        if (low_side == (triangle.volume(high) > 0)) continue;
        for (int step = 0; step < 60; ++step) {
            const double middle = 0.5 * (low + high);
            (triangle.volume(middle) > 0) == low_side ? low = middle : high = middle;
        }
        if (triangle.contains_point(high)) return high;
    }
    return std::nullopt;
}

bool PassageWatch::same_as_before(const Frame& frame, std::span<const Collider> colliders) const {
    if (before_.size() != frame.cloths.size() || watched_.size() != colliders.size()) return false;
    for (std::size_t c = 0; c < before_.size(); ++c) {
        const std::size_t count = frame.cloths[c].positions.size(),
                          appended = frame.cloths[c].model->copied_from.size();
        if (before_[c].size() > count || before_[c].size() < count - appended) return false;
    }
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        const Collider &old = watched_[i].shape, &now = colliders[i];
        if (old.name != now.name || old.shape != now.shape || old.numbers != now.numbers || old.data != now.data)
            return false;
    }
    return true;
}

void PassageWatch::append_particles(const Frame& frame) {
    for (std::size_t c = 0; c < before_.size(); ++c)
        append_copies(before_[c], frame.cloths[c].model->copied_from, frame.cloths[c].positions.size());
}

void PassageWatch::remember(const Frame& frame, std::span<const Collider> colliders) {
    before_.resize(frame.cloths.size());
    for (std::size_t c = 0; c < before_.size(); ++c) {
        before_[c].clear();
        for (const Vec4& p : frame.cloths[c].positions) before_[c].push_back(p.xyz());
    }
    for (std::size_t i = 0; i < colliders.size(); ++i) watched_[i].before = colliders[i].pose;
}

void PassageWatch::add(const Frame& frame, std::span<const Collider> colliders) {
    if (same_as_before(frame, colliders)) {
        append_particles(frame);
        compare(frame, colliders);
    } else {
        watched_.clear();
        for (const Collider& collider : colliders) {
            std::vector<Vec3> points = middle_points(collider, surfaces_);
            const Bounds box = bounds_of(points);
            watched_.push_back({collider, std::move(points), box, collider.pose});
        }
    }
    remember(frame, colliders);
}

void PassageWatch::compare(const Frame& frame, std::span<const Collider> colliders) {
    std::vector<Bounds> boxes(colliders.size());
    std::vector<std::uint32_t> steps(colliders.size(), 1);
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        const Watched& watched = watched_[i];
        if (watched.points.empty()) continue;
        steps[i] = turn_steps(watched.before, colliders[i].pose);
        const Bounds box = swept_box(watched.box, watched.before, colliders[i].pose, steps[i]);
        if (finite(box.min) && finite(box.max)) boxes[i] = box;
    }
    const Bvh tree(boxes);
    for (std::uint32_t c = 0; c < frame.cloths.size(); ++c) {
        const ClothFrame& cloth = frame.cloths[c];
        std::vector<std::array<std::uint32_t, 2>> found;  // collider and point
        for (const Triangle triangle : cloth.triangles) {
            Vec3 from[3], to[3];
            Bounds box;
            bool known = true;
            for (std::size_t k = 0; k < 3; ++k) {
                from[k] = before_[c][triangle[k]], to[k] = cloth.positions[triangle[k]].xyz();
                known = known && finite(from[k]) && finite(to[k]);
                box.include(from[k]), box.include(to[k]);
            }
            if (!known) continue;
            tree.for_each_overlap(box, [&](std::uint32_t i) {
                const Watched& watched = watched_[i];
                if (!shape_acts_on(colliders[i], *cloth.model)) return;
                const auto of_step = [&](std::uint32_t step, Vec3(&local)[3]) {
                    const float part = static_cast<float>(step) / static_cast<float>(steps[i]);
                    const Pose pose = step == 0          ? watched.before
                                      : step == steps[i] ? colliders[i].pose
                                                         : between(watched.before, colliders[i].pose, part);
                    for (std::size_t k = 0; k < 3; ++k) local[k] = to_local(pose, from[k] + (to[k] - from[k]) * part);
                };
                Vec3 start[3], end[3];
                of_step(0, start);
                for (std::uint32_t step = 1; step <= steps[i]; ++step) {
                    of_step(step, end);
                    Bounds way = bounds_of(start);
                    way.include(bounds_of(end));
                    for (std::uint32_t p = 0; p < watched.points.size(); ++p)
                        if (way.contains(watched.points[p]) && time_of_sweep(watched.points[p], start, end))
                            found.push_back({i, p});
                    std::ranges::copy(end, start);
                }
            });
        }
        // Faces share edges, so several may have swept over a point.
        std::ranges::sort(found);
        found.erase(std::ranges::unique(found).begin(), found.end());
        passages_.points += found.size();
        for (std::size_t k = 0; k < found.size(); ++k) {
            const auto [i, p] = found[k];
            if (k > 0 && found[k - 1][0] == i) continue;
            ++passages_.count;
            if (passages_.first) continue;
            passages_.first = {frame.index, i, c, to_world(colliders[i].pose, watched_[i].points[p])};
        }
    }
}

}  // namespace weft
