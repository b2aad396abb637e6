#include "base/transform.h"
#include "mesh/procedural.h"
#include "physics/constraint.h"
#include "physics/testing.h"

#include <numbers>

namespace weft {
namespace {

using namespace testing_kernels;
using reference::BendRow;
using std::numbers::pi;

// Two unit triangles over the edge (0,0,0)-(1,0,0), each wing turned up by half the angle.
struct Wings {
    vec3 p[4];
    explicit Wings(double theta) : p{{0, 0, 0}, {1, 0, 0}, {0.4, 0, 0}, {0.7, 0, 0}} {
        // Normals point to -y; a positive angle is a fold towards the normals.
        p[2] = vec3(0.4, -std::sin(theta / 2), std::cos(theta / 2));
        p[3] = vec3(0.7, -std::sin(theta / 2), -std::cos(theta / 2));
    }
    reference::HingeAngle angle() const { return reference::hinge_angle(p[0], p[1], p[2], p[3]); }
};

TEST(Bend, measures_every_angle_up_to_the_full_fold) {
    for (double theta = -3.14; theta <= 3.14; theta += 0.01) EXPECT_NEAR(Wings(theta).angle().theta, theta, 4e-7);
    EXPECT_EQ(Wings(0).angle().theta, 0);
    EXPECT_NEAR(std::abs(Wings(pi).angle().theta), pi, 4e-7);
}

TEST(Bend, float_keeps_small_angles) {
    for (const float theta : {1e-3f, 1e-4f, 1e-5f}) {
        const float y = -std::sin(theta / 2), z = std::cos(theta / 2);
        const auto hinge = scalar::hinge_angle({0, 0, 0}, {1, 0, 0}, {0.4f, y, z}, {0.7f, y, -z});
        EXPECT_NEAR(hinge.theta, theta, 2e-7f);
    }
}

TEST(Bend, gradient_is_that_of_the_angle) {
    Random random(4);
    for (int i = 0; i < 200; ++i) {
        vec3 p[4] = {random.vector(1), random.vector(1), random.vector(1), random.vector(1)};
        const auto hinge = reference::hinge_angle(p[0], p[1], p[2], p[3]);
        if (std::abs(hinge.theta) > 3 || norm(hinge.gc) > 10 || norm(hinge.gd) > 10) continue;
        const vec3 gradients[4] = {hinge.ga, hinge.gb, hinge.gc, hinge.gd};
        // The tolerance is the polynomial's in angle_of, divided by the step.
        expect_gradient(
            p, gradients, [&] { return reference::hinge_angle(p[0], p[1], p[2], p[3]).theta; }, 2e-2);
        const auto exact = [&] {
            const vec3 e = p[1] - p[0];
            const vec3 n1 = reference::cross(e, p[2] - p[0]), n2 = reference::cross(p[3] - p[0], e);
            return std::atan2(-reference::dot(reference::cross(n1, n2), e), reference::dot(n1, n2) * norm(e));
        };
        expect_gradient(p, gradients, exact, 1e-6);
    }
}

TEST(Bend, pushes_along_the_gradient_as_far_as_its_weight_says) {
    Random random(6);
    for (int i = 0; i < 200; ++i) {
        vec3 p[4] = {random.vector(1), random.vector(1), random.vector(1), random.vector(1)};
        const vec3 before[4] = {p[0], p[1], p[2], p[3]};
        const auto hinge = reference::hinge_angle(p[0], p[1], p[2], p[3]);
        double w[4], lambda = 0.01;
        for (double& weight : w) weight = random.number(0, 5);
        const double rest = random.number(-3, 3), h = 0.1, alpha = 1e-3 / (h * h);
        const double push = -(reference::wrap_angle(hinge.theta - rest) + alpha * lambda) /
                            (reference::hinge_weight(hinge, w[0], w[1], w[2], w[3]) + alpha);
        reference::project_bend(p[0], p[1], p[2], p[3], w[0], w[1], w[2], w[3], lambda, BendRow{rest, 1e-3},
                                make_step(h));
        EXPECT_NEAR(lambda, 0.01 + push, 1e-9);
        const vec3 gradients[4] = {hinge.ga, hinge.gb, hinge.gc, hinge.gd};
        for (int k = 0; k < 4; ++k) EXPECT_LT(norm(p[k] - before[k] - gradients[k] * (w[k] * push)), 1e-9);
    }
}

TEST(Bend, keeps_linear_and_angular_momentum) {
    Random random(5);
    for (int i = 0; i < 500; ++i) {
        vec3 p[4] = {random.vector(1), random.vector(1), random.vector(1), random.vector(1)};
        const vec3 before[4] = {p[0], p[1], p[2], p[3]};
        double w[4], lambda = 0;
        for (double& weight : w) weight = random.number(0.1, 5);
        reference::project_bend(p[0], p[1], p[2], p[3], w[0], w[1], w[2], w[3], lambda,
                                BendRow{random.number(-3, 3), 1e-3}, make_step(0.1));
        vec3 linear(0.0), angular(0.0);
        for (int k = 0; k < 4; ++k) {
            linear = linear + (p[k] - before[k]) * (1 / w[k]);
            angular = angular + reference::cross(before[k], p[k] - before[k]) * (1 / w[k]);
        }
        EXPECT_LT(norm(linear), 1e-9);
        EXPECT_LT(norm(angular), 1e-9);
    }
}

TEST(Bend, turns_toward_its_rest_angle) {
    for (const double rest : {0.0, 1.0, -2.0}) {
        Wings wings(0.3);
        double lambda = 0;
        for (int i = 0; i < 100; ++i) {
            reference::project_bend(wings.p[0], wings.p[1], wings.p[2], wings.p[3], 1, 1, 1, 1, lambda,
                                    BendRow{rest, 0}, make_step(0.01));
        }
        EXPECT_NEAR(wings.angle().theta, rest, 1e-6);
    }
}

TEST(Bend, leaves_the_rest_angle_alone) {
    Wings wings(0.8);
    const Wings before = wings;
    double lambda = 0;
    reference::project_bend(wings.p[0], wings.p[1], wings.p[2], wings.p[3], 1, 2, 3, 4, lambda,
                            BendRow{wings.angle().theta, 1e-6}, make_step(0.01));
    for (int k = 0; k < 4; ++k) EXPECT_LT(norm(wings.p[k] - before.p[k]), 1e-12);
}

// The closed form of Müller et al. 2007, "Position Based Dynamics", appendix A: C = arccos(d) - φ₀ with φ = π at flat.
void project_closed_form(vec3* p, double rest_phi) {
    // Order there: p1 p2 the edge, p3 and p4 the wings; everything relative to p1.
    const vec3 p2 = p[1] - p[0], p3 = p[2] - p[0], p4 = p[3] - p[0];
    const vec3 c23 = reference::cross(p2, p3), c24 = reference::cross(p2, p4);
    const vec3 n1 = c23 * (1 / norm(c23)), n2 = c24 * (1 / norm(c24));
    const double d = reference::dot(n1, n2);
    const vec3 q3 = (reference::cross(p2, n2) + reference::cross(n1, p2) * d) * (1 / norm(c23));
    const vec3 q4 = (reference::cross(p2, n1) + reference::cross(n2, p2) * d) * (1 / norm(c24));
    const vec3 q2 = -((reference::cross(p3, n2) + reference::cross(n1, p3) * d) * (1 / norm(c23))) -
                    (reference::cross(p4, n1) + reference::cross(n2, p4) * d) * (1 / norm(c24));
    const vec3 q1 = -(q2 + q3 + q4);
    const double sum =
        reference::dot(q1, q1) + reference::dot(q2, q2) + reference::dot(q3, q3) + reference::dot(q4, q4);
    const double s = -std::sqrt(1 - d * d) * (std::acos(d) - rest_phi) / sum;
    p[0] = p[0] + q1 * s, p[1] = p[1] + q2 * s, p[2] = p[2] + q3 * s, p[3] = p[3] + q4 * s;
}

TEST(Bend, agrees_with_the_closed_form_away_from_flat_and_folded) {
    for (const double theta : {-2.5, -1.0, -0.3, 0.3, 1.0, 2.5}) {
        Wings ours(theta), theirs(theta);
        double lambda = 0;
        reference::project_bend(ours.p[0], ours.p[1], ours.p[2], ours.p[3], 1, 1, 1, 1, lambda, BendRow{0, 0},
                                make_step(1));
        project_closed_form(theirs.p, pi);
        for (int k = 0; k < 4; ++k) EXPECT_LT(norm(ours.p[k] - theirs.p[k]), 2e-6) << theta << ", point " << k;
    }
}

TEST(Bend, survives_degenerate_input) {
    using V = scalar::vec3;
    const V a(0, 0, 0), b(1, 0, 0), up(0.5f, 0, 1), down(0.5f, 0, -1);
    const V cases[][4] = {
        {a, b, up, down},                                // flat
        {a, b, up, up},                                  // folded onto itself
        {a, a, up, down},                                // no edge
        {a, b, V(0.5f, 0, 0), down},                     // a wing without area
        {a, b, a, b},                                    // both
        {a, a, a, a},                                    // a point
        {a, b, V(0.5f, 1e-20f, 0), V(0.5f, 0, 1e-20f)},  // nearly nothing
        {a, V(1e15f, 0, 0), V(0, 1e15f, 0), V(0, 0, 1e15f)},
    };
    for (const auto& points : cases) {
        for (const float w : {0.0f, 1.0f, 1e6f}) {
            for (const float compliance : {0.0f, 1e5f, 1e30f}) {
                V p[4] = {points[0], points[1], points[2], points[3]};
                float lambda = 0;
                scalar::project_bend(p[0], p[1], p[2], p[3], w, w, w, w, lambda, {0.5f, compliance},
                                     scalar::step_without_limits(1e-3f, 1e3f, 1e6f));
                for (const V& q : p) EXPECT_TRUE(std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z));
                EXPECT_TRUE(std::isfinite(lambda));
            }
        }
    }
}

TEST(Bend, damping_takes_turning_and_leaves_rigid_motion) {
    const Wings wings(0.7);
    const vec3 drift(1, 2, 3), spin(0.5, -1, 0.25);
    const auto moving = [&](int k) { return drift + reference::cross(spin, wings.p[k]); };
    const auto hinge = wings.angle();
    const vec3 g[4] = {hinge.ga, hinge.gb, hinge.gc, hinge.gd};
    const auto rate = [&](const vec3* v) {
        double sum = 0;
        for (int k = 0; k < 4; ++k) sum += reference::dot(g[k], v[k]);
        return sum;
    };
    vec3 v[4] = {moving(0), moving(1), moving(2), moving(3)};
    reference::damp_bend(v[0], v[1], v[2], v[3], wings.p[0], wings.p[1], wings.p[2], wings.p[3], 1, 2, 3, 4,
                         BendRow{0, 1e-3}, 5e-4);
    for (int k = 0; k < 4; ++k) EXPECT_LT(norm(v[k] - moving(k)), 1e-12);

    v[2] = v[2] + hinge.gc;
    const double before = rate(v);
    reference::damp_bend(v[0], v[1], v[2], v[3], wings.p[0], wings.p[1], wings.p[2], wings.p[3], 1, 2, 3, 4,
                         BendRow{0, 1e-3}, 5e-4);
    const double weight = reference::hinge_weight(hinge, 1, 2, 3, 4);
    EXPECT_NEAR(rate(v), before / (1 + 5e-4 / 1e-3 * weight), 1e-12);
}

TEST(BendRows, a_flat_strip_bent_to_a_cylinder_has_the_energy_of_its_stiffness) {
    // Bent along the warp to radius R, energy per area is B/(2R²): the constraints must add up to it on a grid whose
    // diagonals carry none of it (they carry a part, hence uniform diagonals and a fine grid).
    const float warp = 2e-5f, weft = 5e-5f;
    const TriangleMesh mesh = make_grid({1, 1}, {41, 41}, GridDiagonal::uniform);
    const auto topology = build_topology(mesh);
    const RowList rows =
        build_bend(make_rest_shape(mesh, *topology), {.bend = {warp, 0, weft}, .model = BendModel::dihedral});
    for (const bool along_warp : {true, false}) {
        const double radius = 2;
        const auto place = [&](Vec3 p) {
            const double s = along_warp ? p.x : p.z, other = along_warp ? p.z : p.x;
            const double x = radius * std::sin(s / radius), y = radius * std::cos(s / radius);
            return along_warp ? vec3(x, y, other) : vec3(other, y, x);
        };
        double energy = 0;
        for (std::uint32_t r = 0; r < rows.size(); ++r) {
            vec3 p[4];
            for (int k = 0; k < 4; ++k) p[k] = place(topology->rest_positions[rows.particles[4 * r + k]]);
            const double c = reference::hinge_angle(p[0], p[1], p[2], p[3]).theta - rows.fields[2 * r];
            energy += 0.5 * c * c / rows.fields[2 * r + 1];
        }
        // 39 of 40 columns have a hinge line at which to bend.
        EXPECT_NEAR(energy, (along_warp ? warp : weft) / (2 * radius * radius) * 39 / 40, 0.01 * energy);
    }
}

TEST(BendRows, rest_angle_is_the_mesh_s_or_the_given_one) {
    TriangleMesh mesh = make_grid({1, 1}, {3, 2}, GridDiagonal::uniform);
    for (Vec3& p : mesh.positions) {
        if (p.x > 0.1f) p = {0, 0.5f, p.z};  // the right half stands up
    }
    const auto topology = build_topology(mesh);
    const RestShape rest = make_rest_shape(mesh, *topology);
    const RowList built = build_bend(rest, {.model = BendModel::dihedral}),
                  given = build_bend(rest, {.rest_angle = 30, .model = BendModel::dihedral});
    int right_angles = 0;
    for (std::uint32_t r = 0; r < built.size(); ++r) {
        right_angles += std::abs(std::abs(built.fields[2 * r]) - pi / 2) < 1e-5;
        EXPECT_NEAR(given.fields[2 * r], pi / 6, 1e-6);
    }
    EXPECT_EQ(right_angles, 1);
}

std::uint32_t row_count(const TriangleMesh& mesh, BendEdges edges) {
    const auto topology = build_topology(mesh);
    return build_bend(make_rest_shape(mesh, *topology),
                      {.bend = {1, 1, 1}, .edges = edges, .model = BendModel::dihedral})
        .size();
}

TEST(BendRows, of_the_source_are_all_but_the_diagonals_of_the_cells) {
    const std::uint32_t nx = 7, nz = 5, cells = (nx - 1) * (nz - 1);
    for (const auto diagonal : {GridDiagonal::uniform, GridDiagonal::alternating}) {
        TriangleMesh mesh = make_grid({2, 1}, {nx, nz}, diagonal);  // cells that are no squares
        EXPECT_EQ(row_count(mesh, BendEdges::no_diagonals) + cells, row_count(mesh, BendEdges::all));
        const std::uint32_t lines = (nx - 2) * (nz - 1) + (nz - 2) * (nx - 1);
        EXPECT_EQ(row_count(mesh, BendEdges::no_diagonals), lines);

        const Mat3 turn = rotation_from_degrees({35, 70, 15});
        for (Vec3& p : mesh.positions) p = turn * p;
        EXPECT_EQ(row_count(mesh, BendEdges::no_diagonals), lines) << "wherever the sheet lies";
    }
    // The squares of a cross grid are rotated by 45°: the sides of the cells cut them.
    const TriangleMesh cross = make_grid({6, 4}, {nx, nz}, GridDiagonal::cross);
    EXPECT_EQ(row_count(cross, BendEdges::no_diagonals), 4 * cells);
}

TEST(BendRows, of_the_source_keep_what_is_no_rectangle_and_what_is_folded) {
    const auto of_a_cell = [](auto&& change) {
        TriangleMesh mesh = make_grid({1, 1}, {2, 2}, GridDiagonal::uniform);
        for (std::size_t v = 0; v < 4; ++v) change(mesh.positions[v], v);
        return row_count(mesh, BendEdges::no_diagonals);
    };
    EXPECT_EQ(of_a_cell([](Vec3&, std::size_t) {}), 0u);
    const auto sheared_by = [](float slope) { return [=](Vec3& p, std::size_t) { p.x += slope * p.z; }; };
    EXPECT_EQ(of_a_cell(sheared_by(0.01f)), 0u) << "0.6 degrees";
    EXPECT_EQ(of_a_cell(sheared_by(0.03f)), 1u) << "1.7 degrees";
    EXPECT_EQ(of_a_cell([](Vec3& p, std::size_t v) { p.y = v == 1 ? 0.005f : 0; }), 0u) << "folded by 0.4 degrees";
    EXPECT_EQ(of_a_cell([](Vec3& p, std::size_t v) { p.y = v == 1 ? 0.02f : 0; }), 1u) << "folded by 1.6 degrees";
    // A kite with right angles where the hinge is seen from, and none at its ends.
    const Vec3 kite[] = {{-1, 0, 0}, {0.5f, 0, -0.8660254f}, {0.5f, 0, 0.8660254f}, {1, 0, 0}};
    EXPECT_EQ(of_a_cell([&](Vec3& p, std::size_t v) { p = kite[v]; }), 1u);
}

}  // namespace
}  // namespace weft
