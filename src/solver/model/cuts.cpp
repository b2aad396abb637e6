#include "solver/model/cuts.h"

#include "solver/model/tear_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>

namespace weft {
namespace {

// The openings of all these links, vertex by vertex. Two links at a time: more at one vertex follow one another.
class Collector {
  public:
    explicit Collector(const ClothModel& model) : model_(model), table_(*model.tears) {}

    /// Whether the link joins two triangles now.
    bool is_closed(const TearTable::Entry& entry) const {
        if (entry.next == none) return false;
        const std::uint32_t corner = table_.entries[entry.next].corner;
        return model_.faces[entry.corner] == model_.faces[corner] &&
               model_.faces[entry.far] == model_.faces[entry.next_far];
    }
    void add(std::uint32_t link) {
        if (is_closed(table_.entries[link])) links_.push_back(link);
    }
    std::vector<Opening> take() {
        std::ranges::sort(links_);
        links_.erase(std::unique(links_.begin(), links_.end()), links_.end());
        std::vector<Opening> openings;
        std::uint32_t before = none;
        for (const std::uint32_t link : links_) {
            const std::uint32_t vertex = table_.entries[link].vertex;
            if (vertex == before && openings.back().links[1] == none) {
                openings.back().links[1] = link;
            } else {
                openings.push_back({{link, none}});
            }
            before = vertex;
        }
        return openings;
    }

  private:
    const ClothModel& model_;
    const TearTable& table_;
    std::vector<std::uint32_t> links_;
};

double distance_to_segment(Vec3 x, Vec3 a, Vec3 b) {
    const Vec3 along = b - a;
    const float squared = dot(along, along);
    const float t = squared > 0 ? std::clamp(dot(x - a, along) / squared, 0.0f, 1.0f) : 0.0f;
    return static_cast<double>(length(x - (a + along * t)));
}

double distance_to(std::span<const Vec3> stroke, Vec3 x) {
    double least = static_cast<double>(length(x - stroke[0]));
    for (std::size_t i = 1; i < stroke.size(); ++i)
        least = std::min(least, distance_to_segment(x, stroke[i - 1], stroke[i]));
    return least;
}

struct Step {
    double cost = 0;
    std::uint32_t particle = 0;
    friend bool operator>(const Step& a, const Step& b) {
        return std::tie(a.cost, a.particle) > std::tie(b.cost, b.particle);
    }
};

// Which edges a path can follow: `closed`: those between particles that are closed; `built`: all that the cloth was
// built with, between its vertices.
enum class Edges { closed, built };

// Cheapest path of edges (Dijkstra 1959). An edge costs its length, and much more the farther it is from the straight
// line between the ends of the path. They are particles, so a stroke along a row of the mesh gives a straight path.
class StrokePath {
  public:
    StrokePath(const ClothModel& model, std::span<const Vec4> positions, Edges edges)
        : model_(model),
          positions_(positions),
          edges_(edges),
          count_(edges == Edges::built ? model.tears->vertex_count() : model.particle_count),
          links_(group_links()) {}

    std::uint32_t nearest(Vec3 place) const {
        std::uint32_t best = none;
        float least = std::numeric_limits<float>::infinity();
        for (std::uint32_t p = 0; p < count_; ++p) {
            const float d = length(positions_[p].xyz() - place);
            if (d < least) least = d, best = p;
        }
        return best;
    }
    // Adds the links of a path; nothing if there is none.
    void find(std::uint32_t from, std::uint32_t to, Collector& out) {
        if (from == to) return;
        ends_ = {positions_[from].xyz(), positions_[to].xyz()};
        std::vector<double> cost(count_, std::numeric_limits<double>::infinity());
        std::vector<std::uint32_t> by(count_, none), before(count_, none);
        std::priority_queue<Step, std::vector<Step>, std::greater<>> open;
        cost[from] = 0;
        open.push({0, from});
        while (!open.empty()) {
            const Step now = open.top();
            open.pop();
            if (now.particle == to) break;
            if (now.cost > cost[now.particle]) continue;
            for (std::uint32_t i = links_.offsets[now.particle]; i < links_.offsets[now.particle + 1]; ++i) {
                const std::uint32_t link = links_.items[i], end = far_end(link);
                const double next = now.cost + price(now.particle, end);
                if (!(next < cost[end])) continue;
                cost[end] = next, by[end] = link, before[end] = now.particle;
                open.push({next, end});
            }
        }
        for (std::uint32_t p = to; p != from && by[p] != none; p = before[p]) {
            out.add(by[p]);
            out.add(model_.tears->entries[by[p]].twin);
        }
    }

  private:
    Groups<std::uint32_t> group_links() const {
        const auto& entries = model_.tears->entries;
        const Collector closed(model_);
        return group_items<std::uint32_t>(count_, [&](auto put) {
            for (std::uint32_t i = 0; i < entries.size(); ++i) {
                if (edges_ == Edges::built) {
                    if (entries[i].next != none) put(entries[i].vertex, i);
                } else if (closed.is_closed(entries[i])) {
                    put(model_.faces[entries[i].corner], i);
                }
            }
        });
    }
    std::uint32_t far_end(std::uint32_t link) const {
        const TearTable::Entry& entry = model_.tears->entries[link];
        return edges_ == Edges::built ? model_.tears->entries[entry.twin].vertex : model_.faces[entry.far];
    }
    double price(std::uint32_t a, std::uint32_t b) const {
        const Vec3 x = positions_[a].xyz(), y = positions_[b].xyz();
        const double off =
            distance_to_segment((x + y) * 0.5f, ends_[0], ends_[1]) / static_cast<double>(model_.mean_edge);
        return static_cast<double>(length(y - x)) * (1 + 16 * off * off);
    }

    const ClothModel& model_;
    std::span<const Vec4> positions_;
    std::array<Vec3, 2> ends_;
    Edges edges_;
    std::uint32_t count_;  // of the places that edges connect
    Groups<std::uint32_t> links_;
};

std::vector<Opening> along_stroke(const ClothModel& model, std::span<const Vec4> positions,
                                  std::span<const Vec3> stroke, Edges edges) {
    if (stroke.empty()) return {};
    StrokePath path(model, positions, edges);
    Collector collector(model);
    std::uint32_t from = path.nearest(stroke[0]);
    for (const Vec3& point : stroke.subspan(1)) {
        const std::uint32_t to = path.nearest(point);
        path.find(from, to, collector);
        from = to;
    }
    return collector.take();
}

}  // namespace

std::vector<Opening> openings_between(const ClothModel& model, std::span<const std::uint32_t> group) {
    Collector collector(model);
    const auto& entries = model.tears->entries;
    for (std::uint32_t i = 0; i < entries.size(); ++i) {
        if (entries[i].next == none) continue;
        const std::uint32_t mine = entries[i].corner % model.face_stride,
                            other = entries[entries[i].next].corner % model.face_stride;
        if (group[mine] != group[other]) collector.add(i);
    }
    return collector.take();
}

std::vector<Opening> openings_along_plane(const ClothModel& model, std::span<const Vec4> positions, Vec3 point,
                                          Vec3 normal) {
    std::vector<std::uint32_t> side(model.triangle_count);
    for (std::uint32_t t = 0; t < model.triangle_count; ++t) {
        // The middle of its extent along the normal, not its center: a plane along rows of the mesh then gives a
        // straight cut and no zigzag. A little off the middle, so that a plane halfway between two rows is no tie.
        constexpr float middle = 0.47f;
        const auto [a, b, c] = model.triangles()[t];
        const float heights[] = {dot(positions[a].xyz() - point, normal), dot(positions[b].xyz() - point, normal),
                                 dot(positions[c].xyz() - point, normal)};
        const auto [low, high] = std::ranges::minmax(heights);
        side[t] = low + middle * (high - low) > 0;
    }
    return openings_between(model, side);
}

std::vector<Opening> openings_along_stroke(const ClothModel& model, std::span<const Vec4> positions,
                                           std::span<const Vec3> stroke) {
    return along_stroke(model, positions, stroke, Edges::closed);
}

std::vector<Opening> openings_along_stroke_at_rest(const ClothModel& model, std::span<const Vec3> stroke) {
    return along_stroke(model, {model.start.data(), model.particle_count}, stroke, Edges::built);
}

Vec3 nearest_direction(std::span<const Vec3> stroke, Vec3 place) {
    std::size_t best = 1;
    for (std::size_t i = 2; i < stroke.size(); ++i)
        if (distance_to_segment(place, stroke[i - 1], stroke[i]) <
            distance_to_segment(place, stroke[best - 1], stroke[best]))
            best = i;
    return stroke[best] - stroke[best - 1];
}

std::vector<Opening> closed_ones(const ClothModel& model, std::span<const Opening> openings) {
    const Collector collector(model);
    std::vector<Opening> closed;
    for (const Opening& opening : openings)
        for (const std::uint32_t link : opening.links)
            if (link != none && collector.is_closed(model.tears->entries[link])) {
                closed.push_back(opening);
                break;
            }
    return closed;
}

double farthest_from(std::span<const Vec3> stroke, const ClothModel& model, std::span<const Vec4> positions,
                     std::span<const Opening> openings) {
    double farthest = 0;
    for (const Opening& opening : openings) {
        for (const std::uint32_t link : opening.links) {
            if (link == none) continue;
            const TearTable::Entry& entry = model.tears->entries[link];
            const Vec3 a = positions[model.faces[entry.corner]].xyz(), b = positions[model.faces[entry.far]].xyz();
            farthest = std::max(farthest, distance_to(stroke, (a + b) * 0.5f));
        }
    }
    return farthest;
}

}  // namespace weft
