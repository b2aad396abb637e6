#include "physics/constraint.h"
#include "physics/membrane/membrane_split.h"
#include "physics/stretch/stretch_law.h"

#include <array>
#include <utility>

namespace weft {
namespace {

/// The order in which elimination takes the largest pivot that is left.
std::array<std::size_t, 3> pivot_order(SymmetricMatrix m) {
    std::array<std::size_t, 3> order = {0, 1, 2};
    for (std::size_t k = 0; k < 2; ++k) {
        for (std::size_t i = k + 1; i < 3; ++i)
            if (m[order[i]][order[i]] > m[order[k]][order[k]]) std::swap(order[i], order[k]);
        const std::size_t p = order[k];
        if (!(m[p][p] > 0)) break;
        for (std::size_t i = k + 1; i < 3; ++i)
            for (std::size_t j = k + 1; j < 3; ++j) m[order[i]][order[j]] -= m[order[i]][p] * m[p][order[j]] / m[p][p];
    }
    return order;
}

}  // namespace

RowList build_membrane(const RestShape& rest, const MembraneMaterial& material) {
    RowList rows = make_rows(ConstraintKind::membrane);
    if (!has_membranes(material)) return rows;
    const auto& x = rest.topology.rest_positions;
    for (std::uint32_t t = 0; t < rest.topology.triangles.size(); ++t) {
        const SymmetricMatrix left = split_membrane(rest, t, material).remainder;
        // The corners in the order of the pivots, so that the elimination in the kernel keeps its accuracy in needles.
        const std::array<std::size_t, 3> order = pivot_order(left);
        SymmetricMatrix sorted{};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) sorted[i][j] = left[order[i]][order[j]];
        const SymmetricMatrix l = root_of(sorted, 1e-9);
        if (!(l[0][0] > 0)) continue;
        const Triangle& corners = rest.topology.triangles[t];
        const std::uint32_t a = corners[order[0]], b = corners[order[1]], c = corners[order[2]];
        const auto length2 = [&](std::uint32_t from, std::uint32_t to) {
            return dot(x[to] - x[from], x[to] - x[from]);
        };
        const auto f = [](double v) { return static_cast<float>(v); };
        rows.add({a, b, c}, {length2(b, c), length2(c, a), length2(a, b), f(l[0][0]), f(l[1][0]), f(l[1][1]),
                             f(l[2][0]), f(l[2][1]), f(l[2][2])});
    }
    return rows;
}

}  // namespace weft
