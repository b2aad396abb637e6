#include "collide/sheet_order.h"

#include "base/copies.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

namespace weft {
namespace {

// Part of the mean edge length within which a particle has no side: rounding, and sheets pressed onto one plane.
constexpr double no_side = 0.01;
// How far the closest point may move over a sheet: so many times as far as the particle relative to the sheet, plus so
// many edges. Over a curved sheet it moves farther than the particle.
constexpr double moves_along = 2, edges_along = 4;

float angle_at(Vec3 corner, Vec3 a, Vec3 b) {
    const Vec3 u = a - corner, v = b - corner;
    return std::atan2(length(cross(u, v)), dot(u, v));
}

double mean_edge(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
    double sum = 0;
    for (const auto& [a, b, c] : triangles)
        sum += double{length(positions[a] - positions[b])} + double{length(positions[b] - positions[c])} +
               double{length(positions[c] - positions[a])};
    return triangles.empty() ? 0 : sum / (3 * static_cast<double>(triangles.size()));
}

}  // namespace

SheetSides::SheetSides(std::span<const Vec3> positions, std::span<const Triangle> triangles)
    : positions_(positions),
      triangles_(triangles),
      search_(positions, triangles),
      at_particle_(positions.size()),
      on_rim_(positions.size()) {
    normals_.reserve(triangles.size());
    uses_.reserve(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const Triangle& corners = triangles[t];
        const Vec3 normal =
            cross(positions[corners[1]] - positions[corners[0]], positions[corners[2]] - positions[corners[0]]);
        const float size = length(normal);
        normals_.push_back(size > 0 ? normal / size : Vec3{});
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t p = corners[c], q = corners[(c + 1) % 3], r = corners[(c + 2) % 3];
            at_particle_[p] += normals_[t] * angle_at(positions[p], positions[q], positions[r]);
            uses_.push_back({std::min(p, q), std::max(p, q), t});
        }
    }
    std::ranges::sort(uses_, {},
                      [](const EdgeUse& use) { return std::pair(std::pair(use.low, use.high), use.triangle); });
    for (const EdgeUse& use : uses_) {
        if (uses_of(use.low, use.high).size() == 1) on_rim_[use.low] = on_rim_[use.high] = true;
    }
}

std::span<const SheetSides::EdgeUse> SheetSides::uses_of(std::uint32_t p, std::uint32_t q) const {
    const auto found = std::ranges::equal_range(uses_, std::pair(std::min(p, q), std::max(p, q)), {},
                                                [](const EdgeUse& use) { return std::pair(use.low, use.high); });
    return {found.begin(), found.end()};
}

Vec3 SheetSides::point(const SurfacePoint& at) const {
    Vec3 sum{};
    for (std::size_t c = 0; c < 3; ++c)
        sum += positions_[triangles_[at.triangle][c]] * static_cast<float>(at.weights[c]);
    return sum;
}

// At an edge and at a particle, the sign of the distance along the normal of one triangle can be wrong. Along the mean
// normal weighted by angles it is right (Bærentzen and Aanæs 2005, "Signed Distance Computation Using the Angle
// Weighted Pseudonormal").
SheetSide SheetSides::find(Vec3 p) const {
    SheetSide found{.side = SideOfSheet::unknown, .closest = search_.closest(p)};
    if (found.closest.triangle == none) return found;
    const Triangle& corners = triangles_[found.closest.triangle];
    std::array<std::uint32_t, 3> used{};
    std::size_t count = 0;
    for (std::size_t c = 0; c < 3; ++c)
        if (found.closest.weights[c] > 0) used[count++] = corners[c];
    Vec3 normal = normals_[found.closest.triangle];
    if (count == 1) {
        if (on_rim_[used[0]]) return found;
        normal = at_particle_[used[0]];
    } else if (count == 2) {
        const auto uses = uses_of(used[0], used[1]);
        if (uses.size() == 1) return found;
        normal = {};
        for (const EdgeUse& use : uses) normal += normals_[use.triangle];
    }
    const float along = dot(normal, p - point(found.closest));
    if (along != 0) found.side = along > 0 ? SideOfSheet::in_front : SideOfSheet::behind;
    return found;
}

SheetOrder::SheetOrder(std::vector<SheetPose> start) : poses_(std::move(start)) {
    for (const SheetPose& sheet : poses_) {
        first_.push_back(sheet.positions);
        bounds_.push_back(bounds_of(sheet.positions));
        edge_.push_back(mean_edge(sheet.positions, sheet.triangles));
    }
    pairs_.resize(poses_.empty() ? 0 : poses_.size() * (poses_.size() - 1) / 2);
}

std::size_t SheetOrder::lost() const {
    return static_cast<std::size_t>(std::ranges::count(pairs_, true, &Pair::lost));
}

void SheetOrder::begin(std::vector<Track>& tracks, const SheetPose& sheet, const SheetSides& other) const {
    tracks.resize(sheet.positions.size());
    for (std::size_t p = 0; p < tracks.size(); ++p) {
        const SheetSide found = other.find(sheet.positions[p]);
        tracks[p] = {.side = found.side,
                     .passed = false,
                     .place = sheet.positions[p],
                     .closest_place = found.side == SideOfSheet::unknown ? Vec3{} : other.point(found.closest),
                     .closest = found.closest};
    }
}

// A particle that has been appended has the past of its original.
void SheetOrder::append_particles(std::size_t sheet, const SheetPose& next) {
    const std::size_t count = next.positions.size();
    if (count == poses_[sheet].positions.size()) return;
    append_copies(poses_[sheet].positions, next.copied_from, count);
    append_copies(first_[sheet], next.copied_from, count);
    auto pair = pairs_.begin();
    for (std::size_t a = 0; a < poses_.size(); ++a) {
        for (std::size_t b = a + 1; b < poses_.size(); ++b, ++pair) {
            if (a != sheet && b != sheet) continue;
            std::vector<Track>& tracks = pair->tracks[a == sheet ? 0 : 1];
            if (!tracks.empty()) append_copies(tracks, next.copied_from, count);
        }
    }
}

// Between two poses whose boxes, both poses together, do not overlap, nothing can have passed. So far sheets cost
// nothing.
void SheetOrder::add(std::vector<SheetPose> poses, double near) {
    assert(poses.size() == poses_.size());
    const auto is_finite = [](const SheetPose& sheet) { return std::ranges::all_of(sheet.positions, finite); };
    if (!std::ranges::all_of(poses, is_finite)) return;
    const std::size_t count = poses.size();
    std::vector<Bounds> bounds, swept;
    for (std::size_t i = 0; i < count; ++i) {
        append_particles(i, poses[i]);
        bounds.push_back(bounds_of(poses[i].positions));
        swept.push_back(bounds_[i]);
        swept.back().include(bounds[i]);
    }
    std::vector<SheetPose> before = std::exchange(poses_, std::move(poses));
    std::vector<std::optional<SheetSides>> sides(count), sides_before(count);
    const auto made = [](std::optional<SheetSides>& at, const SheetPose& pose) -> const SheetSides& {
        if (!at) at.emplace(pose.positions, pose.triangles);
        return *at;
    };
    auto pair = pairs_.begin();
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = a + 1; b < count; ++b, ++pair) {
            if (!swept[a].overlaps(swept[b])) {
                *pair = {.lost = pair->lost};
                continue;
            }
            for (const bool first : {true, false}) {
                const std::size_t of = first ? a : b, other = first ? b : a;
                std::vector<Track>& tracks = pair->tracks[first ? 0 : 1];
                std::size_t& most = pair->most[first ? 0 : 1];
                if (tracks.empty()) begin(tracks, before[of], made(sides_before[other], before[other]));
                const Count count_now = follow(tracks, of, other, made(sides[other], poses_[other]), near);
                most = std::max(most, count_now.over);
                if (4 * count_now.over >= most && 2 * count_now.passed > count_now.over) pair->lost = true;
            }
        }
    }
    bounds_ = std::move(bounds);
}

SheetOrder::Count SheetOrder::follow(std::vector<Track>& tracks, std::size_t sheet, std::size_t other,
                                     const SheetSides& sides, double near) const {
    Count count;
    for (std::size_t p = 0; p < tracks.size(); ++p) {
        Track& track = tracks[p];
        const Vec3 place = poses_[sheet].positions[p];
        const SheetSide now = sides.find(place);
        if (now.side == SideOfSheet::unknown) {
            track.side = SideOfSheet::unknown;
            continue;
        }
        const bool known = track.side != SideOfSheet::unknown;
        const bool clear = now.closest.distance > no_side * edge_[other];
        if (known && clear && now.side != track.side && moved_along(track, place, sides, now, other))
            track.passed = !track.passed;
        if (!known || clear) {
            track.side = now.side;
            track.place = place;
            track.closest_place = sides.point(now.closest);
            track.closest = now.closest;
        }
        if (!known || !(now.closest.distance <= near)) continue;
        ++count.over;
        count.passed += track.passed;
    }
    return count;
}

bool SheetOrder::moved_along(const Track& track, Vec3 place, const SheetSides& sides, const SheetSide& now,
                             std::size_t other) const {
    const auto at_first = [&](const SurfacePoint& at) {
        Vec3 sum{};
        const Triangle& corners = poses_[other].triangles[at.triangle];
        for (std::size_t c = 0; c < 3; ++c) sum += first_[other][corners[c]] * static_cast<float>(at.weights[c]);
        return sum;
    };
    const Vec3 relative = (place - track.place) - (sides.point(track.closest) - track.closest_place);
    return double{length(at_first(track.closest) - at_first(now.closest))} <=
           moves_along * double{length(relative)} + edges_along * edge_[other];
}

}  // namespace weft
