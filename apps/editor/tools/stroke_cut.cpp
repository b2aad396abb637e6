#include "editor/tools/stroke_cut.h"

#include "editor/tools/stroke_sampler.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft::editor {
namespace {

constexpr double cut_spacing = 2;                                       // pixels between two points of the stroke
constexpr int halvings = 7;                                             // of that, where a part begins and ends
constexpr double corner_size = 0.25, shortest_cut = 0.5, long_cut = 2;  // in edges

struct StrokeHit {
    Vec2 pixel;
    SurfaceHit hit;
};

class StrokeTracer {
  public:
    StrokeTracer(const Projection& view, const CutCloth& cloth, const PickScene& hiding)
        : view_(view), cloth_(cloth), hiding_(hiding) {}

    void add(Vec2 pixel) {
        const std::optional<StrokeHit> hit = hit_at(pixel);
        if (last_pixel_) {
            pass(*last_pixel_, pixel, hit);
        } else if (hit) {
            begin(*hit);
        }
        last_pixel_ = pixel;
    }
    std::vector<PathCut> take() {
        end();
        const bool has_long = std::ranges::any_of(edges_, [](double edges) { return edges >= long_cut; });
        std::vector<PathCut> cuts;
        for (std::size_t i = 0; i < cuts_.size(); ++i)
            if (!has_long || edges_[i] >= long_cut) cuts.push_back(std::move(cuts_[i]));
        return cuts;
    }

  private:
    std::optional<StrokeHit> hit_at(Vec2 pixel) const {
        const auto ray = view_.ray(pixel);
        if (!ray) return std::nullopt;
        const auto hit = cloth_.tree->nearest(*ray, static_cast<float>(view_.nearest_depth()));
        if (!hit || !is_visible(view_, hit->point, hiding_, 0)) return std::nullopt;
        return StrokeHit{pixel, *hit};
    }

    float longest_edge(std::uint32_t triangle) const {
        const auto [a, b, c] = cloth_.mesh.triangle(triangle);
        const Vec3 p = cloth_.mesh.position(a), q = cloth_.mesh.position(b), r = cloth_.mesh.position(c);
        return std::max({length(q - p), length(r - q), length(p - r)});
    }

    // Where the cut passes.
    Vec3 place(const StrokeHit& hit) const {
        const Triangle corners = cloth_.mesh.triangle(hit.hit.triangle);
        if (std::ranges::any_of(corners, [&](std::uint32_t corner) { return corner >= cloth_.start.size(); }))
            return hit.hit.point;
        const Vec3 w = hit.hit.weights;
        return cloth_.start[corners[0]].xyz() * w.x + cloth_.start[corners[1]].xyz() * w.y +
               cloth_.start[corners[2]].xyz() * w.z;
    }

    // Whether the geodesic distance between the two points is short.
    bool connected(const StrokeHit& a, const StrokeHit& b) const {
        const Triangle first = cloth_.mesh.triangle(a.hit.triangle), second = cloth_.mesh.triangle(b.hit.triangle);
        if (std::ranges::find_first_of(first, second) != first.end()) return true;
        constexpr float detour = 1.5f;
        const float radius = detour * length(b.hit.point - a.hit.point) +
                             2 * std::max(longest_edge(a.hit.triangle), longest_edge(b.hit.triangle));
        const auto reached = cloth_.distance->from(cloth_.mesh, {a.hit.triangle, a.hit.weights}, radius);
        return std::ranges::any_of(
            reached, [&](const ReachedVertex& r) { return std::ranges::find(second, r.vertex) != second.end(); });
    }

    void begin(const StrokeHit& hit) { part_.push_back(hit); }

    void pass(Vec2 last, Vec2 next, const std::optional<StrokeHit>& next_hit) {
        const std::optional<StrokeHit> last_hit = part_.empty() ? std::nullopt : std::optional(part_.back());
        if (!last_hit && !next_hit) return;
        if (last_hit && next_hit && connected(*last_hit, *next_hit)) return begin(*next_hit);
        if (last_hit) {
            begin(border(*last_hit, next));
            end();
        }
        if (!next_hit) return;
        begin(border(*next_hit, last));
        begin(*next_hit);
    }

    // The last point toward a pixel that is connected to the hit.
    StrokeHit border(StrokeHit inside, Vec2 outside) const {
        for (int i = 0; i < halvings; ++i) {
            const Vec2 middle = half_way(inside.pixel, outside);
            const auto hit = hit_at(middle);
            if (hit && connected(inside, *hit)) {
                inside = *hit;
            } else {
                outside = middle;
            }
        }
        return inside;
    }

    static Vec2 half_way(Vec2 a, Vec2 b) { return rounded((exact(a) + exact(b)) * 0.5); }

    // Ramer 1972, Douglas and Peucker 1973.
    void keep_corners(std::size_t first, std::size_t last, float size, std::vector<std::uint8_t>& kept) const {
        std::vector<std::pair<std::size_t, std::size_t>> open{{first, last}};
        while (!open.empty()) {
            const auto [from, to] = open.back();
            open.pop_back();
            float farthest = size;
            std::size_t corner = from;
            const Vec3 a = place(part_[from]), along = place(part_[to]) - a;
            const float squared = dot(along, along);
            for (std::size_t i = from + 1; i < to; ++i) {
                const Vec3 p = place(part_[i]) - a;
                const float t = squared > 0 ? std::clamp(dot(p, along) / squared, 0.0f, 1.0f) : 0;
                if (const float off = length(p - along * t); off > farthest) farthest = off, corner = i;
            }
            if (corner == from) continue;
            kept[corner] = 1;
            open.emplace_back(from, corner);
            open.emplace_back(corner, to);
        }
    }

    void end() {
        if (part_.size() > 1) {
            double edges = 0;
            float way = 0;
            for (std::size_t i = 0; i < part_.size(); ++i) {
                edges += static_cast<double>(longest_edge(part_[i].hit.triangle));
                if (i > 0) way += length(part_[i].hit.point - part_[i - 1].hit.point);
            }
            const double edge = edges / static_cast<double>(part_.size());
            std::vector<std::uint8_t> kept(part_.size());
            kept.front() = kept.back() = 1;
            keep_corners(0, part_.size() - 1, static_cast<float>(corner_size * edge), kept);
            PathCut cut;
            for (std::size_t i = 0; i < part_.size(); ++i)
                if (kept[i]) cut.points.push_back(place(part_[i]));
            if (static_cast<double>(way) >= shortest_cut * edge) {
                cuts_.push_back(std::move(cut));
                edges_.push_back(static_cast<double>(way) / edge);
            }
        }
        part_.clear();
    }

    const Projection& view_;
    const CutCloth& cloth_;
    const PickScene& hiding_;
    std::optional<Vec2> last_pixel_;
    std::vector<StrokeHit> part_;  // points of the part that is not yet ended
    std::vector<PathCut> cuts_;
    std::vector<double> edges_;  // per cut, its length
};

}  // namespace

std::vector<PathCut> cuts_of_stroke(const Projection& view, std::span<const Vec2> stroke, const CutCloth& cloth,
                                    const PickScene& hiding) {
    if (!view.valid() || !cloth.tree || !cloth.distance) return {};
    StrokeTracer tracer(view, cloth, hiding);
    StrokeSampler sampler(cut_spacing);
    std::optional<Vec2> last;
    for (const Vec2 pointer : stroke) {
        for (const Vec2 pixel : sampler.add(pointer)) tracer.add(pixel);
        if (finite(pointer)) last = pointer;
    }
    if (last) tracer.add(*last);  // where the stroke ends lies between two points
    return tracer.take();
}

}  // namespace weft::editor
