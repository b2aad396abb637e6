#include "collide/tangle.h"

#include "base/disjoint_sets.h"
#include "collide/crossings.h"
#include "mesh/edges.h"
#include "mesh/grouping.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

// Edges from a crossing within which features have no side. A contour cannot move farther in a frame. With two, cloth
// that is crushed while it is tangled makes more crossings than are removed.
constexpr int rings = 1;
// Particles after which parts of a cloth are no longer compared.
constexpr std::size_t most_compared = 1 << 14;
// The gradient of the contour's length has no direction where it is small: below this it is not brought to unit length.
constexpr float least_gradient = 0.3f;

using Neighbors = Groups<std::uint32_t>;

std::span<const std::uint32_t> of(const Neighbors& neighbors, std::uint32_t p) {
    return std::span(neighbors.items).subspan(neighbors.offsets[p], neighbors.offsets[p + 1] - neighbors.offsets[p]);
}

// The edges of a cloth that pass through triangles along an intersection contour, as far as they are connected. They
// divide the cloth into a part in front of the triangles and a part behind them.
struct Curve {
    std::array<std::vector<std::uint32_t>, 2> ends;  ///< of the edges: in front, behind
    float larger = 0;                                ///< 1: the part in front; -1: the part behind; 0: neither
    std::size_t smaller = 0;                         ///< particles in the other part
};

class TangleFinder {
  public:
    TangleFinder(std::span<const Vec3> positions, std::span<const Triangle> triangles, std::vector<EdgeCrossing> found,
                 const TangleRules& rules)
        : rules_(rules),
          positions_(positions),
          triangles_(triangles),
          found_(std::move(found)),
          count_(static_cast<std::uint32_t>(positions.size())) {
        for (const Triangle& t : triangles_)
            if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) whole_.push_back(t);
        edges_ = build_edges(whole_, count_).edges;
        neighbors_ = group_items<std::uint32_t>(count_, [&](auto&& put) {
            for (const Edge& edge : edges_) put(edge.a, edge.b), put(edge.b, edge.a);
        });
        // An edge with an even number of crossings starts and ends on the same side.
        uncut_ = group_items<std::uint32_t>(count_, [&](auto&& put) {
            auto crossing = found_.begin();
            for (const Edge& edge : edges_) {
                const auto first = crossing;
                while (crossing != found_.end() && crossing->edge == std::array{edge.a, edge.b}) ++crossing;
                if ((crossing - first) % 2 == 0) put(edge.a, edge.b), put(edge.b, edge.a);
            }
        });
    }

    Tangle run() {
        find_curves();
        claimed_.assign(count_, 0);
        for (Curve& curve : curves_) compare_parts(curve);
        Tangle tangle;
        for (const EdgeCrossing& crossing : found_) {
            const Triangle& t = triangles_[crossing.triangle];
            tangle.pairs.push_back({{crossing.edge[0], crossing.edge[1], t[0], t[1], t[2]}, direction(crossing)});
        }
        find_near(tangle);
        return tangle;
    }

  private:
    Vec3 normal_of(const Triangle& t) const {
        return normalized(cross(positions_[t[1]] - positions_[t[0]], positions_[t[2]] - positions_[t[0]]));
    }
    const Edge& edge_of(const EdgeCrossing& crossing) const {
        return *std::ranges::lower_bound(edges_, crossing.edge, {}, [](const Edge& e) { return std::array{e.a, e.b}; });
    }

    void find_curves() {
        DisjointSets sets(count_);
        std::vector<bool> passes(count_, false);
        for (const EdgeCrossing& crossing : found_) passes[crossing.edge[0]] = passes[crossing.edge[1]] = true;
        for (const Edge& edge : edges_)
            if (passes[edge.a] && passes[edge.b]) sets.merge(edge.a, edge.b);
        curve_at_.assign(count_, none);
        for (std::uint32_t p = 0; p < count_; ++p) {
            if (!passes[p]) continue;
            const std::uint32_t first = sets.first_of(p);
            if (first == p) curve_at_[p] = static_cast<std::uint32_t>(curves_.size()), curves_.emplace_back();
            curve_at_[p] = curve_at_[first];
        }
        for (const EdgeCrossing& crossing : found_) {
            const auto [a, b] = crossing.edge;
            Curve& curve = curves_[curve_at_[a]];
            const bool b_in_front = dot(normal_of(triangles_[crossing.triangle]), positions_[a] - positions_[b]) < 0;
            curve.ends[b_in_front ? 1 : 0].push_back(a);
            curve.ends[b_in_front ? 0 : 1].push_back(b);
        }
    }

    // Both sides of a curve claim the particles around, ring by ring, until the one with fewer has no more. So parts
    // that hang together elsewhere are compared by the cloth that is nearer to each side.
    void compare_parts(Curve& curve) {
        enum : std::uint8_t { in_front = 1, behind = 2, claimed = 4 };
        constexpr std::array<std::uint8_t, 2> sides{in_front, behind};
        for (int side = 0; side < 2; ++side)
            for (const std::uint32_t p : curve.ends[side]) claimed_[p] |= sides[side];
        std::array<std::vector<std::uint32_t>, 2> part;
        for (int side = 0; side < 2; ++side) {
            for (const std::uint32_t p : curve.ends[side])
                if (claimed_[p] == sides[side]) claimed_[p] |= claimed, part[side].push_back(p);
        }
        std::array<std::size_t, 2> visited{};
        const auto has_all = [&](int side) {
            return visited[side] == part[side].size() && part[side].size() <= part[1 - side].size();
        };
        while (!has_all(0) && !has_all(1) && part[0].size() + part[1].size() < most_compared) {
            for (int side = 0; side < 2; ++side) {
                for (const std::size_t end = part[side].size(); visited[side] < end; ++visited[side]) {
                    for (const std::uint32_t q : of(uncut_, part[side][visited[side]]))
                        if (claimed_[q] == 0) claimed_[q] = claimed, part[side].push_back(q);
                }
            }
        }
        curve.smaller = std::min(part[0].size(), part[1].size());
        if (part[0].size() != part[1].size()) curve.larger = part[0].size() > part[1].size() ? 1.0f : -1.0f;
        for (int side = 0; side < 2; ++side) {
            for (const std::uint32_t p : part[side]) claimed_[p] = 0;
            for (const std::uint32_t p : curve.ends[side]) claimed_[p] = 0;
        }
    }

    // A contour is a curve on both cloths. All of its edges and triangles move as if the curve with the smallest part
    // was drawn back out of the other cloth. If both curves were drawn, cloth would be crushed between them.
    Vec3 direction(const EdgeCrossing& crossing) const {
        const Triangle& triangle = triangles_[crossing.triangle];
        const Vec3 normal = normal_of(triangle);
        const int order = rules_.order ? rules_.order(crossing.edge[0], triangle[0]) : 0;
        if (order != 0) return order > 0 ? normal : -normal_at(crossing);
        const Curve& own = curves_[curve_at_[crossing.edge[0]]];
        const Curve* other = nullptr;
        for (const std::uint32_t p : triangle)
            if (!other && curve_at_[p] != none) other = &curves_[curve_at_[p]];
        if (other && other != &own && other->larger != 0 && other->smaller < own.smaller)
            return normal_at(crossing) * -other->larger;
        if (own.larger != 0) return normal * own.larger;
        const Vec3 gradient = length_gradient(crossing, normal);
        return gradient / std::max(length(gradient), least_gradient);
    }

    // The mean of the normals at the edge.
    Vec3 normal_at(const EdgeCrossing& crossing) const {
        const Edge& edge = edge_of(crossing);
        Vec3 sum = normal_of(whole_[edge.triangle0]);
        if (edge.triangle1 != none) sum += normal_of(whole_[edge.triangle1]);
        return normalized(sum);
    }

    // How fast the contour shortens if the edge moves. In each triangle at the edge it runs along a unit vector r from
    // the edge. If the edge moves by d, it passes through the plane with normal n at a point that moves by
    // d - (d·n)/(e·n) e, where e is the edge's direction.
    Vec3 length_gradient(const EdgeCrossing& crossing, Vec3 normal) const {
        const auto [a, b] = crossing.edge;
        const Vec3 along = normalized(positions_[b] - positions_[a]);
        const float passes = dot(along, normal);
        const Edge& edge = edge_of(crossing);
        Vec3 gradient{};
        for (const std::uint32_t triangle : {edge.triangle0, edge.triangle1}) {
            if (triangle == none || std::abs(passes) < 1e-6f) continue;
            const Triangle& t = whole_[triangle];
            const std::uint32_t apex = t[0] ^ t[1] ^ t[2] ^ a ^ b;
            const Vec3 to_apex = positions_[apex] - positions_[a];
            Vec3 r = normalized(cross(cross(along, to_apex), normal));
            if (dot(r, to_apex - along * dot(to_apex, along)) < 0) r = -r;
            gradient += r - normal * (dot(r, along) / passes);
        }
        return gradient;
    }

    void find_near(Tangle& tangle) const {
        struct Entry {
            std::uint32_t particle, pair;
        };
        std::vector<Entry> entries;
        std::vector<std::uint32_t> near;
        for (std::uint32_t i = 0; i < tangle.pairs.size(); ++i) {
            const std::span particles(tangle.pairs[i].particle);
            for (std::uint32_t side = 0; side < 2; ++side) {
                const auto own = side == 0 ? particles.first(2) : particles.last(3);
                near.assign(own.begin(), own.end());
                for (int ring = 0; ring < rings; ++ring) {
                    for (std::size_t k = 0, end = near.size(); k < end; ++k)
                        near.insert(near.end(), of(neighbors_, near[k]).begin(), of(neighbors_, near[k]).end());
                    std::ranges::sort(near);
                    near.erase(std::unique(near.begin(), near.end()), near.end());
                }
                for (const std::uint32_t p : near) entries.push_back({p, 2 * i + side});
            }
        }
        auto groups = group_items<std::uint32_t>(count_, [&](auto&& put) {
            for (const Entry& entry : entries) put(entry.particle, entry.pair);
        });
        tangle.first = std::move(groups.offsets);
        tangle.near = std::move(groups.items);
    }

    const TangleRules& rules_;
    std::span<const Vec3> positions_;
    std::span<const Triangle> triangles_;
    std::vector<EdgeCrossing> found_;  // sorted by edge
    std::uint32_t count_;
    std::vector<Triangle> whole_;  // triangles with three different corners
    std::vector<Edge> edges_;      // of these
    Neighbors neighbors_, uncut_;  // of particles: along all edges, and along those that do not change sides
    std::vector<Curve> curves_;
    std::vector<std::uint32_t> curve_at_;  // by particle; none: none of its edges passes through a triangle
    std::vector<std::uint8_t> claimed_;    // by particle, while the parts of a curve are compared
};

}  // namespace

bool Tangle::joins(std::uint32_t p, std::uint32_t q) const {
    std::uint32_t i = first[p], j = first[q];
    while (i < first[p + 1] && j < first[q + 1]) {
        if (near[i] / 2 == near[j] / 2 && near[i] != near[j]) return true;
        if (near[i] < near[j])
            ++i;
        else
            ++j;
    }
    return false;
}

Tangle find_tangle(std::span<const Vec3> positions, std::span<const Triangle> triangles, const TangleRules& rules) {
    std::vector<EdgeCrossing> found = find_crossings(positions, triangles, rules.can_cross);
    const auto is_tied = [&](const EdgeCrossing& crossing) {
        return std::ranges::any_of(crossing.edge, [&](std::uint32_t p) {
            return std::ranges::any_of(triangles[crossing.triangle], [&](std::uint32_t q) { return rules.tied(p, q); });
        });
    };
    if (rules.tied) std::erase_if(found, is_tied);
    if (found.empty()) return {};
    return TangleFinder(positions, triangles, std::move(found), rules).run();
}

}  // namespace weft
