#include "physics/constraint.h"
#include "physics/scalar.h"
#include "physics/symmetric.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace weft {
namespace {

using reference::vec3;
using Matrix = SymmetricMatrix;

/// The three neighbors of a triangle, each across the edge opposite the corner of the same index.
struct Around {
    std::array<std::uint32_t, 3> wing = {none, none, none};  ///< the particle across the edge, or `none`
    /// -1 if the two are wound inconsistently and this triangle, not the neighbor, is treated as flipped. A rest angle
    /// in degrees then opens to the other side.
    std::array<double, 3> side = {1, 1, 1};
};

std::vector<Around> find_wings(const Topology& topology) {
    std::vector<Around> around(topology.triangles.size());
    for (const Hinge& hinge : topology.hinges) {
        const auto put = [&](std::uint32_t triangle, std::uint32_t from, std::uint32_t opposite, std::uint32_t wing) {
            const Triangle& corners = topology.triangles[triangle];
            for (std::uint32_t i = 0; i < 3; ++i) {
                if (corners[i] != opposite) continue;
                around[triangle].wing[i] = wing;
                around[triangle].side[i] = corners[(i + 1) % 3] == from ? 1 : -1;
            }
        };
        put(hinge.triangle0, hinge.a, hinge.c, hinge.d);
        put(hinge.triangle1, hinge.b, hinge.d, hinge.c);
    }
    return around;
}

/// M, where ½ θᵀ M θ is the bending energy of a triangle with the angles θ across its three edges.
Matrix stiffness_of(const RestShape& rest, std::uint32_t triangle, const BendMaterial& material) {
    const Triangle& corners = rest.topology.triangles[triangle];
    std::array<vec3, 3> x;
    for (int i = 0; i < 3; ++i) x[i] = reference::to_double(rest.topology.rest_positions[corners[i]]);
    const vec3 normal = reference::cross(x[1] - x[0], x[2] - x[0]);
    const double area = 0.5 * std::sqrt(reference::dot(normal, normal));
    const vec3 warp = reference::to_double(rest.warp[triangle]);
    const vec3 weft = reference::cross(normal, warp) * (0.5 / area);

    // Curvature along warp and weft and their twist, per angle: θ ℓ/(2A) n⊗n.
    Matrix curvature{};
    for (int i = 0; i < 3; ++i) {
        const vec3 edge = x[(i + 2) % 3] - x[(i + 1) % 3];
        const double along_warp = reference::dot(edge, warp), along_weft = reference::dot(edge, weft);
        // n is the edge turned by 90°; `scale` also divides by its length, to normalize it.
        const double scale = 1 / (2 * area * std::sqrt(reference::dot(edge, edge)));
        curvature[0][i] = along_weft * along_weft * scale;
        curvature[1][i] = along_warp * along_warp * scale;
        curvature[2][i] = -along_warp * along_weft * scale;
    }
    const double b_warp = material.bend[0], b_bias = material.bend[1], b_weft = material.bend[2];
    const double stiffness[3] = {b_warp, b_weft, std::max(0.0, 4 * b_bias - b_warp - b_weft)};
    const double weighted = area * double{weight_at(rest.bend_weight, triangle)};
    Matrix m{};
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) m[i][j] += weighted * stiffness[k] * curvature[k][i] * curvature[k][j];
        }
    }
    return m;
}

/// The slope of the sheet is free at its border: eliminates the angle across an edge without a neighbor by setting it
/// to the value of least energy.
void set_free(Matrix& m, int edge) {
    const Matrix all = m;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            // Skip pivots that are only rounding errors.
            if (all[edge][edge] > 1e-12 * (all[i][i] + all[j][j]))
                m[i][j] -= all[i][edge] * all[edge][j] / all[edge][edge];
        }
    }
    for (int i = 0; i < 3; ++i) m[i][edge] = m[edge][i] = 0;
}

/// Adds a constraint for the angles selected by `in`.
void add_row(RowList& rows, const RestShape& rest, std::uint32_t triangle, const Around& around,
             const std::array<bool, 3>& in, const BendMaterial& material) {
    Matrix m = stiffness_of(rest, triangle, material);
    for (int i = 0; i < 3; ++i) {
        if (around.wing[i] == none) set_free(m, i);
    }
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) m[i][j] = in[i] && in[j] ? m[i][j] : 0;
    }
    const Matrix l = root_of(m, 1e-12);
    if (!(l[0][0] + l[1][1] + l[2][2] > 0)) return;
    const Triangle& p = rest.topology.triangles[triangle];
    const auto& x = rest.topology.rest_positions;
    // For an edge without a neighbor, the wing is one of the edge's ends: the resulting triangle has no area and no
    // angle.
    std::array<std::uint32_t, 3> wing = {p[1], p[2], p[0]};
    std::array<float, 3> angle{};
    for (int i = 0; i < 3; ++i) {
        if (!in[i]) continue;
        const std::uint32_t from = p[(i + 1) % 3], to = p[(i + 2) % 3];
        wing[i] = around.wing[i];
        angle[i] = static_cast<float>(
            std::isnan(material.rest_angle)
                ? reference::hinge_angle(reference::to_double(x[from]), reference::to_double(x[to]),
                                         reference::to_double(x[p[i]]), reference::to_double(x[wing[i]]))
                      .theta
                : around.side[i] * material.rest_angle * std::numbers::pi / 180);
    }
    const auto f = [](double v) { return static_cast<float>(v); };
    rows.add({wing[0], wing[1], wing[2], p[0], p[1], p[2]},
             {angle[0], angle[1], angle[2], f(l[0][0]), f(l[1][0]), f(l[1][1]), f(l[2][0]), f(l[2][1]), f(l[2][2])});
}

}  // namespace

RowList build_plate(const RestShape& rest, const PlateMaterial& material) {
    RowList rows = make_rows(ConstraintKind::plate);
    if (material.model != BendModel::plate) return rows;
    const Topology& topology = rest.topology;
    const std::vector<Around> around = find_wings(topology);
    for (std::uint32_t t = 0; t < topology.triangles.size(); ++t) {
        std::array<bool, 3> left{};
        for (int i = 0; i < 3; ++i) left[i] = around[t].wing[i] != none;
        // A constraint may name a wing only once. Around a vertex with three triangles two wings are the same particle;
        // they go into separate constraints.
        while (left[0] || left[1] || left[2]) {
            std::array<bool, 3> in{};
            for (int i = 0; i < 3; ++i) {
                in[i] = left[i];
                for (int j = 0; j < i; ++j) in[i] = in[i] && !(in[j] && around[t].wing[i] == around[t].wing[j]);
            }
            for (int i = 0; i < 3; ++i) left[i] = left[i] && !in[i];
            add_row(rows, rest, t, around[t], in, material);
        }
    }
    return rows;
}

}  // namespace weft
