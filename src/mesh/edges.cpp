#include "mesh/edges.h"

#include "mesh/grouping.h"

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace weft {
namespace {

bool winds(const Triangle& t, std::uint32_t from, std::uint32_t to) {
    return (t[0] == from && t[1] == to) || (t[1] == from && t[2] == to) || (t[2] == from && t[0] == to);
}

std::uint32_t opposite(const Triangle& t, const Edge& e) {
    return t[0] ^ t[1] ^ t[2] ^ e.a ^ e.b;
}

}  // namespace

EdgeList build_edges(std::span<const Triangle> triangles, std::uint32_t particle_count) {
    // Groups the sides by their lower end and sorts each group by (upper end, triangle). Most groups have only a few
    // items, so this is faster than sorting all keys at once. A vertex with very many edges makes one long group.
    auto sides = group_items<std::uint64_t>(particle_count, [&](auto put) {
        for (std::uint32_t i = 0; i < triangles.size(); ++i) {
            const auto [p, q, r] = triangles[i];
            for (const auto& [from, to] : {std::pair{p, q}, std::pair{q, r}, std::pair{r, p}})
                put(std::min(from, to), std::uint64_t{std::max(from, to)} << 32 | i);
        }
    });

    EdgeList list;
    list.edges.reserve(sides.items.size() / 2 + sides.items.size() / 16);
    for (std::uint32_t a = 0; a < particle_count; ++a) {
        const auto begin = sides.items.begin() + sides.offsets[a], end = sides.items.begin() + sides.offsets[a + 1];
        std::sort(begin, end);
        for (auto side = begin; side != end;) {
            const auto b = static_cast<std::uint32_t>(*side >> 32);
            const auto first = side;
            while (side != end && *side >> 32 == b) ++side;
            const std::uint32_t second = side - first > 1 ? static_cast<std::uint32_t>(first[1]) : none;
            if (side - first > 2) list.non_manifold.push_back(static_cast<std::uint32_t>(list.edges.size()));
            list.edges.push_back({a, b, static_cast<std::uint32_t>(*first), second});
        }
    }
    return list;
}

HingeList build_hinges(const EdgeList& edges, std::span<const Triangle> triangles) {
    HingeList list;
    list.hinges.reserve(edges.edges.size());
    auto crowded = edges.non_manifold.begin();
    for (std::uint32_t i = 0; i < edges.edges.size(); ++i) {
        const Edge& e = edges.edges[i];
        if (crowded != edges.non_manifold.end() && *crowded == i) {
            ++crowded;
            continue;
        }
        if (e.triangle1 == none) continue;
        const bool first_is_left = winds(triangles[e.triangle0], e.a, e.b);
        if (first_is_left == winds(triangles[e.triangle1], e.a, e.b)) ++list.inconsistent;
        const std::uint32_t left = first_is_left ? e.triangle0 : e.triangle1;
        const std::uint32_t right = first_is_left ? e.triangle1 : e.triangle0;
        list.hinges.push_back({e.a, e.b, opposite(triangles[left], e), opposite(triangles[right], e), i, left, right});
    }
    return list;
}

}  // namespace weft
