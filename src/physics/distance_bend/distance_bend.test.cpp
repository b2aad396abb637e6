#include "mesh/procedural.h"
#include "physics/constraint.h"
#include "physics/testing.h"

#include <gtest/gtest.h>

#include <numbers>

namespace weft {
namespace {

using namespace testing_kernels;
using reference::DistanceBendRow;
using reference::vec3;
using std::numbers::pi;

TEST(DistanceBend, leaves_tips_at_rest_alone) {
    vec3 c(0, 0, 1), d(0, 0, -2);
    double lambda = 0;
    reference::project_distance_bend(c, d, 1, 2, lambda, DistanceBendRow{3, 1e-3}, make_step(0.01));
    EXPECT_EQ(norm(c - vec3(0, 0, 1)), 0);
    EXPECT_EQ(norm(d - vec3(0, 0, -2)), 0);
    EXPECT_EQ(lambda, 0);
}

TEST(DistanceBend, moves_along_the_gradient_and_keeps_the_center_of_mass) {
    Random random(2);
    for (int i = 0; i < 200; ++i) {
        vec3 points[2] = {random.vector(1), random.vector(1)};
        vec3 c = points[0], d = points[1];
        const double over = random.number(-0.2, 0.2), rest = norm(c - d) - over;
        double lambda = 0;
        const reference::Step step = make_step(0.01);
        reference::project_distance_bend(c, d, 2, 3, lambda, DistanceBendRow{rest, 1e-4}, step);
        EXPECT_NEAR(lambda, -over / (2 + 3 + 1e-4 * step.inv_h2), 1e-12);
        EXPECT_LT(norm((c - points[0]) * 3 + (d - points[1]) * 2), 1e-12);
        const vec3 gradients[2] = {(c - points[0]) * (1 / (2 * lambda)), (d - points[1]) * (1 / (3 * lambda))};
        expect_gradient(
            points, gradients, [&] { return norm(points[0] - points[1]) - rest; }, 1e-8);
    }
}

TEST(DistanceBend, of_coincident_and_of_pinned_tips_does_nothing) {
    vec3 c(1, 1, 1), d(1, 1, 1);
    double lambda = 0;
    reference::project_distance_bend(c, d, 1, 1, lambda, DistanceBendRow{1, 0}, make_step(0.01));
    EXPECT_EQ(norm(c - d), 0);
    d = vec3(1, 1, 4);
    reference::project_distance_bend(c, d, 0, 0, lambda, DistanceBendRow{1, 0}, make_step(0.01));
    EXPECT_EQ(norm(c - d), 3);
    EXPECT_EQ(lambda, 0);
}

// Two triangles on an edge of 2 m, heights 1 and 1.5 m, feet half a meter apart, folded by `angle` rad.
TriangleMesh folded(double angle) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0},
                      {2, 0, 0},
                      {1.25f, 0, 1},
                      {0.75f, static_cast<float>(1.5 * std::sin(angle)), static_cast<float>(-1.5 * std::cos(angle))}};
    mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
    return mesh;
}

double distance_of_tips(double angle) {
    const TriangleMesh mesh = folded(angle);
    return static_cast<double>(length(mesh.positions[2] - mesh.positions[3]));
}

TEST(DistanceBendRows, hold_as_much_energy_as_a_hinge_folded_by_a_right_angle) {
    constexpr float stiffness = 0.02f;
    for (const double angle : {0.0, 0.4, -0.9}) {
        const TriangleMesh mesh = folded(angle);
        const auto topology = build_topology(mesh, {.reorder = false});
        const RestShape rest = make_rest_shape(mesh, *topology);
        const BendMaterial material{.bend = {stiffness, stiffness, stiffness}, .model = BendModel::distance};
        EXPECT_EQ(build_bend(rest, material).size(), 0u);
        EXPECT_EQ(build_plate(rest, material).size(), 0u);
        const RowList rows = build_distance_bend(rest, material);
        ASSERT_EQ(rows.size(), 1u);
        const double apart = static_cast<double>(rows.fields[0]), k = 1 / static_cast<double>(rows.fields[1]);
        EXPECT_NEAR(apart, distance_of_tips(angle), 1e-6);
        // Areas 1 and 1.5 m², edge 2 m.
        const double hinge = 0.5 * (stiffness * 4 / 2.5) * (pi / 2) * (pi / 2);
        const double fold = angle > 0 ? pi / 2 : -pi / 2;  // toward where the tips come nearer
        const double way = apart - distance_of_tips(angle + (angle == 0 ? pi / 2 : fold));
        EXPECT_NEAR(0.5 * k * way * way, hinge, 1e-5 * hinge) << angle;
    }
}

TEST(DistanceBendRows, are_of_the_hinges_that_a_material_chooses_at_its_rest_angle) {
    const TriangleMesh mesh = make_grid({1, 1}, {9, 9}, GridDiagonal::alternating);
    const auto topology = build_topology(mesh, {.reorder = false});
    const RestShape rest = make_rest_shape(mesh, *topology);
    BendMaterial material{.model = BendModel::distance};
    EXPECT_EQ(build_distance_bend(rest, material).size(), topology->hinges.size());
    material.edges = BendEdges::no_diagonals;
    EXPECT_EQ(build_distance_bend(rest, material).size(), topology->hinges.size() - 64) << "one diagonal a square";
    material.rest_angle = 180;
    const RowList closed = build_distance_bend(rest, material);
    for (std::uint32_t r = 0; r < closed.size(); ++r) EXPECT_LT(closed.fields[2 * r], 0.13f) << "tips on one another";
    material = {.bend = {0, 0, 0}, .model = BendModel::distance};
    EXPECT_EQ(build_distance_bend(rest, material).size(), 0u);
    EXPECT_EQ(build_distance_bend(rest, BendMaterial{}).size(), 0u) << "hinges";
}

}  // namespace
}  // namespace weft
