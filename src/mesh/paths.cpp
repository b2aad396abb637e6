#include "mesh/paths.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace weft {
namespace {

constexpr std::uint32_t nothing = 0xFFFFFFFF;

// cos 45°. At a sharper turn the path ends: the links on the two sides of a corner influence each other little.
constexpr double straight_enough = 0.7071;

// At a point with more links, all paths end: no two links clearly continue each other, and trying all pairs would be
// slow.
constexpr std::size_t most_links_at_a_point = 32;

// The links at every point, ascending: 2·link + end, where end 0 is the link's first point.
struct LinkEnds {
    std::vector<std::uint32_t> offsets, items;

    LinkEnds(std::span<const std::uint32_t> points, std::size_t point_count)
        : offsets(point_count + 1), items(points.size()) {
        for (const std::uint32_t p : points) ++offsets[p + 1];
        for (std::size_t p = 0; p < point_count; ++p) offsets[p + 1] += offsets[p];
        std::vector<std::uint32_t> next(offsets.begin(), offsets.end() - 1);
        for (std::uint32_t link_end = 0; link_end < points.size(); ++link_end)
            items[next[points[link_end]]++] = link_end;
    }
    std::span<const std::uint32_t> at(std::size_t p) const {
        return std::span(items).subspan(offsets[p], offsets[p + 1] - offsets[p]);
    }
};

struct Turn {
    double cosine;  // of the angle between the two links: -1 is straight on
    std::uint32_t a, b;
};

// Nearly always there are few turns; an insertion sort then needs no allocation.
void sort_by_cosine(std::vector<Turn>& turns) {
    constexpr std::size_t few = 16;
    if (turns.size() > few) {
        std::ranges::stable_sort(turns, {}, &Turn::cosine);
        return;
    }
    for (std::size_t i = 1; i < turns.size(); ++i) {
        const Turn turn = turns[i];
        std::size_t at = i;
        for (; at > 0 && turn.cosine < turns[at - 1].cosine; --at) turns[at] = turns[at - 1];
        turns[at] = turn;
    }
}

// For each link end, the link end at which the path continues, or `nothing`.
std::vector<std::uint32_t> join_ends(std::span<const std::uint32_t> points, std::span<const Vec3> positions) {
    const LinkEnds ends(points, positions.size());
    std::vector<std::uint32_t> partner(points.size(), nothing);
    std::vector<Turn> turns;
    std::vector<std::array<double, 3>> away;
    for (std::size_t p = 0; p < positions.size(); ++p) {
        const auto here = ends.at(p);
        if (here.size() < 2 || here.size() > most_links_at_a_point) continue;
        away.clear(), turns.clear();
        for (const std::uint32_t link_end : here) {
            const Vec3 d = positions[points[link_end ^ 1]] - positions[p];
            const std::array<double, 3> v = {d.x, d.y, d.z};
            const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
            const double scale = length > 0 ? 1 / length : 0;
            away.push_back({v[0] * scale, v[1] * scale, v[2] * scale});
        }
        for (std::size_t i = 0; i < here.size(); ++i) {
            for (std::size_t j = i + 1; j < here.size(); ++j) {
                const double cosine = away[i][0] * away[j][0] + away[i][1] * away[j][1] + away[i][2] * away[j][2];
                if (cosine < -straight_enough) turns.push_back({cosine, here[i], here[j]});
            }
        }
        sort_by_cosine(turns);
        for (const Turn& turn : turns) {
            if (partner[turn.a] != nothing || partner[turn.b] != nothing) continue;
            partner[turn.a] = turn.b;
            partner[turn.b] = turn.a;
        }
    }
    return partner;
}

class PathWriter {
  public:
    PathWriter(std::span<const std::uint32_t> points, std::size_t point_count, std::uint32_t max_length)
        : points_(points), seen_in_(point_count, nothing), max_length_(max_length) {}

    /// Cuts a trail into paths. A trail lists the ends at which its links are entered.
    void write(std::span<const std::uint32_t> trail) {
        // Cuts into `pieces` paths with single links between them: the smallest number for which no piece is too long.
        const std::size_t pieces = (trail.size() + 1 + max_length_) / (max_length_ + std::size_t{1});
        for (std::size_t piece = 0; piece < pieces; ++piece) {
            const std::size_t begin = (trail.size() + 1) * piece / pieces;
            const std::size_t end = (trail.size() + 1) * (piece + 1) / pieces - 1;
            for (std::size_t i = begin; i < end; ++i) append(trail[i], i == begin);
            close();
            if (end < trail.size()) append(trail[end], true), close();
        }
    }

    Paths take() { return std::move(paths_); }

  private:
    void append(std::uint32_t link_end, bool first) {
        const std::uint32_t from = points_[link_end], to = points_[link_end ^ 1];
        // A trail may cross itself.
        if (!first && seen_in_[to] == paths_.size()) close(), first = true;
        if (first) seen_in_[from] = paths_.size();
        seen_in_[to] = paths_.size();
        paths_.links.push_back(link_end / 2);
        paths_.turned.push_back(static_cast<std::uint8_t>(link_end & 1));
    }
    void close() {
        if (paths_.links.size() > paths_.offsets.back()) {
            paths_.offsets.push_back(static_cast<std::uint32_t>(paths_.links.size()));
        }
    }

    std::span<const std::uint32_t> points_;
    std::vector<std::uint32_t> seen_in_;
    std::uint32_t max_length_;
    Paths paths_;
};

}  // namespace

Paths find_paths(std::span<const std::uint32_t> points, std::span<const Vec3> positions, std::uint32_t max_length) {
    assert(max_length > 0 && points.size() % 2 == 0);
    const std::vector<std::uint32_t> partner = join_ends(points, positions);
    std::vector<std::uint8_t> done(points.size() / 2);
    PathWriter writer(points, positions.size(), max_length);
    std::vector<std::uint32_t> trail;
    const auto follow = [&](std::uint32_t link_end) {
        trail.clear();
        while (link_end != nothing && !done[link_end / 2]) {
            done[link_end / 2] = 1;
            trail.push_back(link_end);
            link_end = partner[link_end ^ 1];
        }
        writer.write(trail);
    };
    for (std::uint32_t link_end = 0; link_end < points.size(); ++link_end) {
        if (partner[link_end] == nothing && !done[link_end / 2]) follow(link_end);
    }
    // The links that remain form closed loops.
    for (std::uint32_t link_end = 0; link_end < points.size(); ++link_end) {
        if (!done[link_end / 2]) follow(link_end);
    }
    return writer.take();
}

}  // namespace weft
