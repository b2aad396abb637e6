#include "mesh/procedural.h"
#include "physics/constraint.h"
#include "physics/testing.h"

namespace weft {
namespace {

using namespace testing_kernels;
using reference::StretchRow;

TEST(Stretch, leaves_an_edge_at_rest_alone) {
    vec3 a(0.25, 1, -2), b(0.25, 1, -1.5);
    double lambda = 0;
    reference::project_stretch(a, b, 3, 5, lambda, StretchRow{0.5, 1e-3, 1e-3, WEFT_NEVER_STRAIGHT}, make_step(0.01));
    EXPECT_EQ(norm(a - vec3(0.25, 1, -2)), 0);
    EXPECT_EQ(lambda, 0);
}

TEST(Stretch, brings_a_hard_edge_to_its_length_and_keeps_the_center_of_mass) {
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        vec3 a = random.vector(1), b = random.vector(1);
        const double wa = random.number(0, 10), wb = random.number(0.01, 10), rest = random.number(0.1, 2);
        const vec3 a0 = a, b0 = b;
        double lambda = 0;
        reference::project_stretch(a, b, wa, wb, lambda, StretchRow{rest, 0, 0, WEFT_NEVER_STRAIGHT}, make_step(0.01));
        EXPECT_NEAR(norm(a - b), rest, 1e-12);
        // w_b Δa + w_a Δb = 0: momentum; Δ along the edge: angular momentum.
        EXPECT_LT(norm((a - a0) * wb + (b - b0) * wa), 1e-12);
        EXPECT_LT(norm(reference::cross(a - a0, a0 - b0)), 1e-12);
    }
}

TEST(Stretch, moves_along_the_gradient) {
    Random random(2);
    for (int i = 0; i < 100; ++i) {
        vec3 points[2] = {random.vector(1), random.vector(1)};
        vec3 a = points[0], b = points[1];
        const double rest = norm(a - b) + 0.25;
        double lambda = 0;
        const reference::Step step = make_step(0.01);
        reference::project_stretch(a, b, 2, 3, lambda, StretchRow{rest, 1e-4, 1e-4, WEFT_NEVER_STRAIGHT}, step);
        // Δx_i = w_i ∇_i C Δλ
        const vec3 gradients[2] = {(a - points[0]) * (1 / (2 * lambda)), (b - points[1]) * (1 / (3 * lambda))};
        expect_gradient(
            points, gradients, [&] { return norm(points[0] - points[1]) - rest; }, 1e-8);
        EXPECT_NEAR(lambda, 0.25 / (2 + 3 + 1e-4 * step.inv_h2), 1e-12);
    }
}

TEST(Stretch, converges_to_the_force_of_its_spring) {
    // λ/h² is the force; at the end C + α̃ λ = 0, so the force is C/α.
    vec3 a(0, 0, 0), b(1.2, 0, 0);
    double lambda = 0;
    const reference::Step step = make_step(0.02);
    for (int i = 0; i < 50; ++i)
        reference::project_stretch(a, b, 1, 1, lambda, StretchRow{1, 0.002, 0.01, WEFT_NEVER_STRAIGHT}, step);
    EXPECT_NEAR(-lambda * step.inv_h2, (norm(a - b) - 1) / 0.002, 1e-9);
}

TEST(Stretch, has_its_own_stiffness_against_compression) {
    for (const double length : {1.1, 0.9}) {
        vec3 a(0, 0, 0), b(length, 0, 0);
        double lambda = 0;
        const reference::Step step = make_step(0.01);
        reference::project_stretch(a, b, 1, 1, lambda, StretchRow{1, 1e-4, 5e-4, WEFT_NEVER_STRAIGHT}, step);
        EXPECT_NEAR(lambda, -(length - 1) / (2 + (length > 1 ? 1e-4 : 5e-4) * step.inv_h2), 1e-12);
    }
}

// Of a spring of 1 m with the play 0.2 m, times its compliance at rest.
double stiffening_force(double length) {
    const double longer = length - 1, from = longer - 0.1;
    if (from < 0) return longer;
    return longer + 49 * (from < 0.2 ? from * from / 0.4 : from - 0.1);
}

TEST(Stretch, is_stiffer_where_threads_are_straight) {
    const double inverse = 1 / 0.2;
    for (const double length : {0.9, 1.05, 1.0999, 1.15, 1.2999, 1.3, 1.5}) {
        const auto spring = reference::stretch_spring(length - 1, 0.2);
        EXPECT_NEAR(spring.c / spring.share, stiffening_force(length), 1e-12) << length;
        const double stiffness = (stiffening_force(length + 1e-6) - stiffening_force(length - 1e-6)) / 2e-6;
        EXPECT_NEAR(1 / spring.share, stiffness, 49 * 1e-6 * inverse) << length;
        EXPECT_LE(stiffening_force(length), 0.2 + 50 * std::max(0.0, length - 1.2) + 49 * 0.025)
            << "near its asymptotes";
    }
    EXPECT_NEAR(stiffening_force(1.3), 0.2 + 50 * 0.1, 1e-12) << "the asymptote";
    const StretchRow row{1, 0.002, 0.002, 0.2};
    for (const double start : {0.8, 1.05, 1.15, 1.25, 1.5}) {
        vec3 a(0, 0, 0), b(start, 0, 0);
        double lambda = 0;
        const reference::Step step = make_step(0.02);
        for (int i = 0; i < 200; ++i) reference::project_stretch(a, b, 1, 1, lambda, row, step);
        EXPECT_NEAR(-lambda * step.inv_h2, stiffening_force(norm(a - b)) / 0.002, 1e-6) << start;
    }
}

TEST(Stretch, without_stiffness_against_compression_is_a_string) {
    vec3 a(0, 0, 0), b(0.5, 0, 0);
    double lambda = 0;
    reference::project_stretch(a, b, 1, 1, lambda, StretchRow{1, 0, -1, WEFT_NEVER_STRAIGHT}, make_step(0.01));
    EXPECT_EQ(b.x - a.x, 0.5);
    // A later iteration corrects what an earlier one pulled too far.
    lambda = -0.05;
    reference::project_stretch(a, b, 1, 1, lambda, StretchRow{1, 0, -1, WEFT_NEVER_STRAIGHT}, make_step(0.01));
    EXPECT_NEAR(b.x - a.x, 0.6, 1e-12);
    EXPECT_NEAR(lambda, 0, 1e-12);
}

TEST(Stretch, survives_degenerate_input) {
    using namespace scalar;
    const Step step = step_without_limits(1e-3f, 1e3f, 1e6f);
    for (const float w : {0.0f, 1.0f, 1e30f}) {
        for (const float gap : {0.0f, 1e-30f, 1e-12f, 1e12f}) {
            for (const float compliance : {-1.0f, 0.0f, 1.0f, 1e30f}) {
                scalar::vec3 a(1, 1, 1), b(1 + gap, 1, 1);
                const scalar::vec3 a0 = a;
                float lambda = 0;
                project_stretch(a, b, w, 0.0f, lambda, {1, compliance, compliance, WEFT_NEVER_STRAIGHT}, step);
                EXPECT_TRUE(std::isfinite(a.x) && std::isfinite(b.x) && std::isfinite(lambda))
                    << w << ' ' << gap << ' ' << compliance;
                if (w == 0) {
                    EXPECT_EQ(a.x, a0.x);
                }
            }
        }
    }
}

TEST(Stretch, damping_takes_relative_motion_along_the_edge_and_nothing_else) {
    const double compliance = 1e-3, viscous = 2e-3;
    Random random(3);
    for (int i = 0; i < 200; ++i) {
        const vec3 a = random.vector(1), b = random.vector(1), drift = random.vector(5), spin = random.vector(5);
        const double wa = random.number(0.1, 3), wb = random.number(0.1, 3);
        const vec3 along = (a - b) * (1 / norm(a - b));
        vec3 va = drift + reference::cross(spin, a), vb = drift + reference::cross(spin, b);
        const vec3 va0 = va, vb0 = vb;
        reference::damp_stretch(va, vb, a, b, wa, wb, StretchRow{1, compliance, compliance, WEFT_NEVER_STRAIGHT},
                                viscous);
        EXPECT_LT(norm(va - va0) + norm(vb - vb0), 1e-12) << "a rigid motion is left alone";

        va = va0 + along * 2.0;
        reference::damp_stretch(va, vb, a, b, wa, wb, StretchRow{1, compliance, compliance, WEFT_NEVER_STRAIGHT},
                                viscous);
        // A dashpot of τ/α, implicit over the step: what is left is 1/(1 + (τ/α) h W).
        EXPECT_NEAR(reference::dot(along, va - vb), 2 / (1 + viscous / compliance * (wa + wb)), 1e-12);
        EXPECT_LT(norm((va - va0 - along * 2.0) * wb + (vb - vb0) * wa), 1e-12) << "momentum";
    }
}

RowList grid_rows(const StretchMaterial& material, GridDiagonal diagonal = GridDiagonal::alternating) {
    const TriangleMesh mesh = make_grid({1, 1}, {5, 5}, diagonal);
    const auto topology = build_topology(mesh);
    return build_stretch(make_rest_shape(mesh, *topology), material);
}

TEST(StretchRows, a_sheet_is_as_stiff_as_its_fabric) {
    // Pulled along the warp, an alternating square grid stretches by the same ratio everywhere and narrows by one
    // other. With the diagonals' springs k_d = 4 K_s A/ℓ² = 2 K_s the energy per area is ½ k₁ ε² + ½ k₂ ν² + ½ K_s (ε +
    // ν)²,   so at rest across ν = -K_s ε/(k₂ + K_s). The stiffness that remains, k₁ + K_s k₂/(k₂ + K_s), must be
    // K_warp. k₁, k₂ and K_s follow from the constraints.
    const StretchMaterial material{.stretch = {3000, 1200}, .compression = {3000, 1200}, .shear = 250};
    const RowList rows = grid_rows(material);
    const double cell = 0.25;
    double k1 = 0, k2 = 0, ks = 0;
    const TriangleMesh mesh = make_grid({1, 1}, {5, 5}, GridDiagonal::alternating);
    const auto topology = build_topology(mesh);
    for (std::uint32_t r = 0; r < rows.size(); ++r) {
        const Vec3 a = topology->rest_positions[rows.particles[2 * r]],
                   b = topology->rest_positions[rows.particles[2 * r + 1]];
        const double k = 1 / rows.fields[rows.field_count * r + 1], length = rows.fields[rows.field_count * r];
        const bool inside = std::abs(a.x + b.x) < 0.9 && std::abs(a.z + b.z) < 0.9;
        if (!inside) continue;
        if (a.z == b.z) k1 = k * length * length / (cell * cell);  // two half cells at each edge
        if (a.x == b.x) k2 = k * length * length / (cell * cell);
        if (a.x != b.x && a.z != b.z) ks = k * length * length / (cell * cell) / 4;
    }
    EXPECT_NEAR(k1 + ks * k2 / (k2 + ks), 3000, 0.5);
    EXPECT_NEAR(k2 + ks * k1 / (k1 + ks), 1200, 0.5);
    EXPECT_NEAR(ks, 250, 0.1);
}

TEST(StretchRows, inextensible_means_no_compliance_anywhere) {
    const RowList rows = grid_rows({.inextensible = true});
    ASSERT_EQ(rows.size(), 56u);  // 2·20 along the axes, 16 diagonals
    for (std::uint32_t r = 0; r < rows.size(); ++r) {
        EXPECT_EQ(rows.fields[rows.field_count * r + 1], 0);
        EXPECT_EQ(rows.fields[rows.field_count * r + 2], 0);
    }
}

TEST(StretchRows, are_straight_at_the_limit_of_their_direction) {
    const auto strains = [](float warp, float weft) {
        const RowList rows = grid_rows({.stretch = {100, 100}, .shear = 30, .stretch_limit = {warp, weft}});
        const TriangleMesh mesh = make_grid({1, 1}, {5, 5}, GridDiagonal::alternating);
        const auto topology = build_topology(mesh);
        std::array<double, 3> found{};
        for (std::uint32_t r = 0; r < rows.size(); ++r) {
            const float* const fields = &rows.fields[rows.field_count * r];
            const Vec3 along =
                topology->rest_positions[rows.particles[2 * r + 1]] - topology->rest_positions[rows.particles[2 * r]];
            const int kind = along.z == 0 ? 0 : along.x == 0 ? 1 : 2;
            found[kind] = fields[3] / double{fields[0]};
        }
        return found;
    };
    const auto both = strains(0.2f, 0.5f);
    EXPECT_NEAR(both[0], 0.2, 1e-6);
    EXPECT_NEAR(both[1], 0.5, 1e-6);
    EXPECT_NEAR(1 / both[2], (1 / 0.2 + 1 / 0.5) / 2, 1e-5);
    EXPECT_GT(strains(0.2f, 0)[1], 1e12) << "no limit along the weft";
    for (const double none : strains(0, 0)) EXPECT_GT(none, 1e12);
}

TEST(StretchRows, stiffness_zero_leaves_rows_out) {
    EXPECT_EQ(grid_rows({.stretch = {0, 0}, .compression = {0, 0}, .shear = 0}).size(), 0u);
    EXPECT_EQ(grid_rows({.stretch = {1000, 1000}, .compression = {1000, 1000}, .shear = 0}).size(), 40u)
        << "no diagonals";
    const RowList strings = grid_rows({.stretch = {1000, 1000}, .compression = {0, 0}, .shear = 0});
    EXPECT_EQ(strings.size(), 40u);
    for (std::uint32_t r = 0; r < strings.size(); ++r) EXPECT_LT(strings.fields[strings.field_count * r + 2], 0);
}

}  // namespace
}  // namespace weft
