#include "physics/moment/coupled_hinges.h"

#include "physics/scalar.h"
#include "physics/symmetric.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

using reference::vec3;

/// Of the greatest stiffness: compliance must be finite.
constexpr double least_part = 1e-3;
/// Of its compliance, that a triangle must be able to give at once. Needles give less.
constexpr double least_at_once = 1e-3;

/// The hinge across the edge opposite each corner.
struct HingesOfTriangle {
    std::array<std::uint32_t, 3> hinge = {none, none, none};
    std::array<float, 3> facing = {1, 1, 1};  ///< -1: the hinge takes the triangle as flipped
};

std::vector<HingesOfTriangle> hinges_of_triangles(const Topology& topology) {
    std::vector<HingesOfTriangle> all(topology.triangles.size());
    for (std::uint32_t h = 0; h < topology.hinges.size(); ++h) {
        const Hinge& hinge = topology.hinges[h];
        const auto put = [&](std::uint32_t triangle, std::uint32_t from, std::uint32_t opposite) {
            const Triangle& corners = topology.triangles[triangle];
            for (std::size_t i = 0; i < 3; ++i) {
                if (corners[i] != opposite) continue;
                all[triangle].hinge[i] = h;
                all[triangle].facing[i] = corners[(i + 1) % 3] == from ? 1.0f : -1.0f;
            }
        };
        put(hinge.triangle0, hinge.a, hinge.c);
        put(hinge.triangle1, hinge.b, hinge.d);
    }
    return all;
}

using Direction = std::array<double, 2>;
/// σ_ww, σ_ff and 2 σ_wf
using Moments = std::array<double, 3>;

Moments product(const Direction& u, const Direction& v, double scale) {
    return {u[0] * v[0] * scale, u[1] * v[1] * scale, (u[0] * v[1] + u[1] * v[0]) * scale};
}

double energy_of(const Moments& a, const Moments& b, const SheetStiffness& stiffness) {
    return a[0] * b[0] / stiffness.warp + a[1] * b[1] / stiffness.weft + a[2] * b[2] / stiffness.twist;
}

struct FlatTriangle {
    std::array<Direction, 3> edge;  ///< a to b, b to the tip, the tip to a
    std::array<double, 3> length{};
    double twice_area;

    explicit FlatTriangle(const HingeSide& side) {
        const Direction ab = {side.edge[0], side.edge[1]}, tip = {side.tip[0], side.tip[1]};
        edge = {ab, {tip[0] - ab[0], tip[1] - ab[1]}, {-tip[0], -tip[1]}};
        for (std::size_t i = 0; i < 3; ++i) length[i] = std::hypot(edge[i][0], edge[i][1]);
        twice_area = std::abs(ab[0] * tip[1] - ab[1] * tip[0]);
    }
};

/// C, where ½ mᵀ C m is the energy of the triangle and m the moments across its edges, N·m: moment per length times the
/// length of the edge.
SymmetricMatrix compliance_of_edges(const FlatTriangle& flat, const SheetStiffness& stiffness) {
    // The tensor with 1 across edge i and 0 across the others is the symmetric product of the directions of the other
    // two. The part of an edge across another is twice the area over the length of the other.
    std::array<Moments, 3> moments;
    for (std::size_t i = 0; i < 3; ++i)
        moments[i] = product(flat.edge[(i + 1) % 3], flat.edge[(i + 2) % 3],
                             -flat.length[i] * flat.length[i] / (flat.twice_area * flat.twice_area));
    SymmetricMatrix c{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            c[i][j] = 0.5 * flat.twice_area / (flat.length[i] * flat.length[j]) *
                      energy_of(moments[i], moments[j], stiffness);
    return c;
}

/// Of an edge from a to b alone, as if the triangle were curved across it only.
double compliance_alone(const FlatTriangle& flat, const SheetStiffness& stiffness) {
    const Direction across = {-flat.edge[0][1], flat.edge[0][0]};
    const double length2 = flat.length[0] * flat.length[0];
    const Moments moments = product(across, across, 1 / length2);
    return 0.5 * flat.twice_area / length2 * energy_of(moments, moments, stiffness);
}

/// The largest part of the diagonal that leaves no negative eigenvalue.
double largest_part(const SymmetricMatrix& c) {
    SymmetricMatrix scaled{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            scaled[i][j] = c[i][i] > 0 && c[j][j] > 0 ? c[i][j] / std::sqrt(c[i][i] * c[j][j]) : i == j ? 1 : 0;
    return std::min(1.0, (1 - 1e-6) * least_eigenvalue(scaled));
}

}  // namespace

SheetStiffness::SheetStiffness(const MomentMaterial& material) {
    const double b_warp = material.bend[0], b_bias = material.bend[1], b_weft = material.bend[2];
    const double least = least_part * std::max({b_warp, b_bias, b_weft});
    warp = std::max(least, b_warp), weft = std::max(least, b_weft),
    twist = std::max(least, 4 * b_bias - b_warp - b_weft);
}

SideCompliance compliance_of(const HingeSide& side, const SheetStiffness& stiffness) {
    const FlatTriangle flat(side);
    if (!(flat.twice_area > 0)) return {};
    SymmetricMatrix c = compliance_of_edges(flat, stiffness);
    const std::array<double, 3> link = {1, double{side.link[0]}, double{side.link[1]}};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) c[i][j] *= link[i] * link[j];  // no moment acts across a border
    const double part = largest_part(c);
    if (!(part >= least_at_once)) return {compliance_alone(flat, stiffness), 0, {}};
    return {part * c[0][0], (1 - part) * c[0][0], {c[0][1], c[0][2]}};
}

// Changes of the shifts die out if the rate is below twice the compliance at once over the sum of all (Gershgorin). The
// first sweep of a substep leaves less of that compliance (sweep.md): `cross` grids need less than 1.6.
double SideCompliance::rate() const {
    const double sum = total() + std::abs(by[0]) + std::abs(by[1]);
    return sum > 0 ? std::min(1.0, 1.2 * at_once / sum) : 1;
}

std::vector<CoupledHinge> couple_hinges(const RestShape& rest) {
    const Topology& topology = rest.topology;
    std::vector<CoupledHinge> all(topology.hinges.size());
    const std::vector<HingesOfTriangle> hinges = hinges_of_triangles(topology);
    const auto at = [&](std::uint32_t p) { return reference::to_double(topology.rest_positions[p]); };
    for (std::uint32_t t = 0; t < hinges.size(); ++t) {
        const Triangle& corners = topology.triangles[t];
        const vec3 normal = reference::cross(at(corners[1]) - at(corners[0]), at(corners[2]) - at(corners[0]));
        const double twice_area = std::sqrt(reference::dot(normal, normal));
        if (!(twice_area > 0)) continue;
        const vec3 warp = reference::to_double(rest.warp[t]), weft = reference::cross(normal, warp) * (1 / twice_area);
        const auto flat = [&](vec3 v) {
            return std::array{static_cast<float>(reference::dot(v, warp)), static_cast<float>(reference::dot(v, weft))};
        };
        for (std::size_t i = 0; i < 3; ++i) {
            if (hinges[t].hinge[i] == none) continue;
            const Hinge& hinge = topology.hinges[hinges[t].hinge[i]];
            const std::size_t which = hinge.triangle0 == t ? 0 : 1;
            CoupledHinge& coupled = all[hinges[t].hinge[i]];
            HingeSide& side = coupled.side[which];
            side.edge = flat(at(hinge.b) - at(hinge.a)), side.tip = flat(at(corners[i]) - at(hinge.a));
            for (std::size_t k = 0; k < 2; ++k) {
                // The edge from b to the tip lies opposite a.
                const std::size_t j = corners[(i + 1) % 3] == (k == 0 ? hinge.a : hinge.b) ? (i + 1) % 3 : (i + 2) % 3;
                if (hinges[t].hinge[j] == none) continue;
                coupled.linked[which][k] = hinges[t].hinge[j];
                side.link[k] = hinges[t].facing[i] * hinges[t].facing[j];
            }
        }
    }
    return all;
}

}  // namespace weft
