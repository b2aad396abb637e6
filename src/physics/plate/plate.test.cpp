#include "mesh/procedural.h"
#include "physics/constraint.h"
#include "physics/testing.h"

#include <algorithm>
#include <numbers>

namespace weft {
namespace {

using namespace testing_kernels;
using reference::PlateRow;
using std::numbers::pi;

vec3 components(const PlateRow& row, vec3 angles) {
    return reference::coupled_strains(reference::plate_stiffness(row), angles);
}

// In the order of a constraint's particles.
struct Patch {
    vec3 p[6];  // da, db, dc, a, b, c
    double w[6] = {1, 1, 1, 1, 1, 1};
    double lambda[3] = {};

    void project(const PlateRow& row, double h) {
        reference::project_plate(p[0], p[1], p[2], p[3], p[4], p[5], w[0], w[1], w[2], w[3], w[4], w[5], lambda[0],
                                 lambda[1], lambda[2], row, make_step(h));
    }
    reference::PlateAngles angles(const PlateRow& row) const {
        return reference::plate_angles(p[0], p[1], p[2], p[3], p[4], p[5], w[0], w[1], w[2], w[3], w[4], w[5], row);
    }
    vec3 strain(const PlateRow& row) const {
        const auto t = angles(row);
        return components(row, {t.a.theta, t.b.theta, t.c.theta});
    }
};

// Gradients of the three angles, in the order of a constraint's particles.
std::array<std::array<vec3, 6>, 3> gradients(const reference::PlateAngles& t) {
    const vec3 zero(0.0);
    return {{{t.a.gd, zero, zero, t.a.go, t.a.gp, t.a.gq},
             {zero, t.b.gd, zero, t.b.gq, t.b.go, t.b.gp},
             {zero, zero, t.c.gd, t.c.gp, t.c.gq, t.c.go}}};
}

// A triangle with three neighbors, all a little out of its plane.
Patch random_patch(Random& random, double bumps = 0.3) {
    const vec3 flat[6] = {{1, 0, 1}, {-1, 0, 0.9}, {0.4, 0, -1}, {0, 0, 0}, {0.1, 0, 1}, {1, 0, 0}};
    Patch patch{};
    for (int k = 0; k < 6; ++k) {
        patch.p[k] = flat[k] + random.vector(bumps);
        patch.w[k] = random.number(0.1, 5);
    }
    return patch;
}

PlateRow random_row(Random& random, double size) {
    const auto some = [&] { return random.number(-size, size); };
    return {some(), some(), some(), some(), some(), some(), some(), some(), some()};
}

constexpr PlateRow flat_and_stiff = {0, 0, 0, 1, 0.3, 1, 0.3, 0.3, 1};

TEST(Plate, measures_the_angles_of_the_hinges) {
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        const Patch patch = random_patch(random, 1);
        const vec3 *wing = patch.p, *corner = patch.p + 3;
        const auto t = patch.angles({});
        const double theta[3] = {t.a.theta, t.b.theta, t.c.theta};
        for (int k = 0; k < 3; ++k) {
            const auto hinge = reference::hinge_angle(corner[(k + 1) % 3], corner[(k + 2) % 3], corner[k], wing[k]);
            EXPECT_NEAR(theta[k], hinge.theta, 1e-6);
        }
    }
}

TEST(Plate, gradient_is_that_of_the_angles) {
    Random random(2);
    for (int i = 0; i < 50; ++i) {
        Patch patch = random_patch(random);
        const auto all = gradients(patch.angles({}));
        for (int k = 0; k < 3; ++k) {
            const auto exact = [&] {
                const vec3 &o = patch.p[3 + k], &p = patch.p[3 + (k + 1) % 3], &q = patch.p[3 + (k + 2) % 3];
                const vec3 n1 = reference::cross(q - p, o - p), n2 = reference::cross(patch.p[k] - p, q - p);
                return std::atan2(-reference::dot(reference::cross(n1, n2), q - p),
                                  reference::dot(n1, n2) * norm(q - p));
            };
            expect_gradient(patch.p, all[k], exact, 1e-5);
        }
    }
}

TEST(Plate, keeps_linear_and_angular_momentum) {
    Random random(3);
    for (int i = 0; i < 500; ++i) {
        Patch patch = random_patch(random);
        for (double& lambda : patch.lambda) lambda = random.number(-0.1, 0.1);
        const Patch before = patch;
        patch.project(random_row(random, 2), 0.3);
        vec3 linear(0.0), angular(0.0);
        for (int k = 0; k < 6; ++k) {
            const vec3 impulse = (patch.p[k] - before.p[k]) * (1 / patch.w[k]);
            linear = linear + impulse;
            angular = angular + reference::cross(before.p[k], impulse);
        }
        EXPECT_LT(norm(linear), 1e-9);
        EXPECT_LT(norm(angular), 1e-9);
    }
}

TEST(Plate, solves_its_three_numbers_at_once) {
    Random random(4);
    for (int i = 0; i < 200; ++i) {
        const Patch patch = random_patch(random);
        const PlateRow row = random_row(random, 2);
        const auto stiffness = reference::plate_stiffness(row);
        const auto t = patch.angles(row);
        const vec3 r = random.vector(1);
        const double k = random.number(0, 10);
        const vec3 x = reference::solve_shifted(
            reference::couple_weights(reference::plate_weights(t, patch.w[3], patch.w[4], patch.w[5]), stiffness, k),
            r);
        // Transposed L W L x, summed particle by particle.
        const vec3 m = reference::coupled_forces(stiffness, x);
        const double moment[3] = {m.x, m.y, m.z};
        const auto g = gradients(t);
        double turned[3] = {};
        for (int particle = 0; particle < 6; ++particle) {
            vec3 moved(0.0);
            for (int a = 0; a < 3; ++a) moved = moved + g[a][particle] * (patch.w[particle] * moment[a]);
            for (int a = 0; a < 3; ++a) turned[a] += reference::dot(g[a][particle], moved);
        }
        const vec3 left = x + components(row, {turned[0], turned[1], turned[2]}) * k - r;
        EXPECT_LT(norm(left), 1e-9);
    }
}

TEST(Plate, comes_to_rest_where_its_moments_are_those_of_its_stiffness) {
    Random random(5);
    for (int i = 0; i < 20; ++i) {
        Patch patch = random_patch(random, 0.1);
        const double h = 0.5;
        const Patch start = patch;
        for (int n = 0; n < 50; ++n) patch.project(flat_and_stiff, h);
        const vec3 strain = patch.strain(flat_and_stiff);
        const double s[3] = {strain.x, strain.y, strain.z}, before = norm(start.strain(flat_and_stiff));
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(patch.lambda[k], -h * h * s[k], 1e-9);
        EXPECT_LT(norm(strain), before);
    }
}

TEST(Plate, leaves_the_rest_angles_alone) {
    Random random(6);
    Patch patch = random_patch(random);
    const auto t = patch.angles({});
    PlateRow row = flat_and_stiff;
    row.rest_a = t.a.theta, row.rest_b = t.b.theta, row.rest_c = t.c.theta;
    const Patch before = patch;
    patch.project(row, 0.1);
    for (int k = 0; k < 6; ++k) EXPECT_LT(norm(patch.p[k] - before.p[k]), 1e-12);
}

TEST(Plate, a_missing_neighbor_stands_at_an_end_of_its_edge_and_does_nothing) {
    Random random(7);
    Patch patch = random_patch(random);
    patch.p[2] = patch.p[3];
    const Patch before = patch;
    PlateRow row = flat_and_stiff;
    row.l_ca = row.l_cb = row.l_cc = 0;
    patch.project(row, 0.5);
    EXPECT_EQ(norm(patch.p[2] - before.p[2]), 0);
    EXPECT_EQ(patch.lambda[2], 0);
    EXPECT_GT(norm(patch.p[3] - before.p[3]), 1e-6);
    // If a wing later collapses onto the edge, the other two still act.
    Patch collapsed = before;
    collapsed.project(flat_and_stiff, 0.5);
    EXPECT_GT(norm(collapsed.p[3] - before.p[3]), 1e-6);
}

TEST(Plate, survives_degenerate_input) {
    using V = scalar::vec3;
    const V a(0, 0, 0), b(0, 0, 1), c(1, 0, 0), far(1, 0, 1);
    const V cases[][6] = {
        {far, {-1, 0, 0.5f}, {0.5f, 0, -1}, a, b, c},  // flat
        {a, b, c, a, b, c},                            // folded onto itself
        {far, far, far, a, b, c},                      // neighbors at the same place
        {b, c, a, a, b, c},                            // no neighbors
        {far, far, far, a, a, c},                      // no edge
        {far, far, far, a, b, V(0, 0, 0.5f)},          // no area
        {a, a, a, a, a, a},                            // a point
        {far, V(1e-20f, 0, 0.5f), V(0.5f, 1e-20f, 0), a, b, V(1e-15f, 0, 0)},
        {V(1e15f, 1e15f, 0), V(0, 1e15f, 0), V(0, 0, -1e15f), a, V(0, 0, 1e15f), V(1e15f, 0, 0)},
    };
    for (const auto& points : cases) {
        for (const float w : {0.0f, 1.0f, 1e6f}) {
            for (const float l : {0.0f, 1e-4f, 1.0f, 1e15f}) {
                for (const float h : {1e-3f, 1.0f}) {
                    V p[6] = {points[0], points[1], points[2], points[3], points[4], points[5]};
                    float lambda[3] = {};
                    scalar::project_plate(p[0], p[1], p[2], p[3], p[4], p[5], w, w, w, w, w, w, lambda[0], lambda[1],
                                          lambda[2], {0.5f, 0, -3, l, l, l, l, l, l},
                                          scalar::step_without_limits(h, 1 / h, 1 / h / h));
                    for (const V& q : p) EXPECT_TRUE(std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z));
                    for (const float x : lambda) EXPECT_TRUE(std::isfinite(x));
                }
            }
        }
    }
}

TEST(Plate, damping_takes_turning_and_leaves_rigid_motion) {
    Random random(8);
    const Patch patch = random_patch(random);
    const auto g = gradients(patch.angles({}));
    const vec3 drift(1, 2, 3), spin(0.5, -1, 0.25);
    const auto moving = [&](int k) { return drift + reference::cross(spin, patch.p[k]); };
    const auto damp = [&](vec3* v) {
        const vec3* p = patch.p;
        const double* w = patch.w;
        reference::damp_plate(v[0], v[1], v[2], v[3], v[4], v[5], p[0], p[1], p[2], p[3], p[4], p[5], w[0], w[1], w[2],
                              w[3], w[4], w[5], flat_and_stiff, 2.0);
    };
    const auto rate = [&](const vec3* v) {
        double sum[3] = {};
        for (int i = 0; i < 3; ++i) {
            for (int k = 0; k < 6; ++k) sum[i] += reference::dot(g[i][k], v[k]);
        }
        return components(flat_and_stiff, {sum[0], sum[1], sum[2]});
    };
    vec3 v[6];
    for (int k = 0; k < 6; ++k) v[k] = moving(k);
    damp(v);
    for (int k = 0; k < 6; ++k) EXPECT_LT(norm(v[k] - moving(k)), 1e-12);

    v[0] = v[0] + g[0][0], v[2] = v[2] - g[2][2];
    const double before = norm(rate(v));
    damp(v);
    EXPECT_LT(norm(rate(v)), 0.9 * before);
}

struct Built {
    std::unique_ptr<Topology> topology;
    RestShape rest;
    RowList rows;
};

Built build(const TriangleMesh& mesh, BendMaterial material) {
    auto topology = std::make_unique<Topology>(*build_topology(mesh, {.reorder = false}));
    RestShape rest = make_rest_shape(mesh, *topology);
    material.model = BendModel::plate;
    RowList rows = build_plate(rest, material);
    return {std::move(topology), std::move(rest), std::move(rows)};
}

PlateRow row_at(const RowList& rows, std::uint32_t r) {
    const float* f = rows.fields.data() + 9 * std::size_t{r};
    return {f[0], f[1], f[2], f[3], f[4], f[5], f[6], f[7], f[8]};
}

// Particles that a constraint names more than once.
int repeats(const RowList& rows, std::uint32_t r) {
    const auto first = rows.particles.begin() + 6 * std::ptrdiff_t{r};
    std::vector<std::uint32_t> sorted(first, first + 6);
    std::sort(sorted.begin(), sorted.end());
    return static_cast<int>(sorted.end() - std::unique(sorted.begin(), sorted.end()));
}

TEST(PlateRows, store_the_stiffness_along_every_direction) {
    // For a curvature K of the whole sheet, the angle across edge i of a triangle is -(e_j·K e_k) ℓ_i/(2A).
    const double warp = 2e-5, bias = 3e-5, weft = 5e-5;
    TriangleMesh mesh = make_grid({1, 1.5f}, {6, 6}, GridDiagonal::alternating);
    Random random(9);
    for (Vec3& p : mesh.positions) {
        p.x += static_cast<float>(random.number(-0.04, 0.04)), p.z += static_cast<float>(random.number(-0.04, 0.04));
    }
    mesh.uvs.clear();  // the warp runs along x
    const Built built = build(mesh, {.bend = {2e-5f, 3e-5f, 5e-5f}});
    int inner = 0;
    for (std::uint32_t r = 0; r < built.rows.size(); ++r) {
        if (repeats(built.rows, r)) continue;
        ++inner;
        vec3 x[3];
        for (int i = 0; i < 3; ++i) {
            const Vec3 at = built.topology->rest_positions[built.rows.particles[6 * r + 3 + i]];
            x[i] = vec3(at.x, at.y, at.z);
        }
        const double area = 0.5 * norm(reference::cross(x[1] - x[0], x[2] - x[0]));
        for (const double degrees : {0.0, 20.0, 45.0, 90.0, 135.0, 160.0}) {
            const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
            double theta[3];
            for (int i = 0; i < 3; ++i) {
                const vec3 ei = x[(i + 2) % 3] - x[(i + 1) % 3], ej = x[i] - x[(i + 2) % 3], ek = x[(i + 1) % 3] - x[i];
                const auto along = [&](vec3 e) { return c * e.x + s * e.z; };
                theta[i] = -along(ej) * along(ek) * norm(ei) / (2 * area);
            }
            const vec3 strain = components(row_at(built.rows, r), {theta[0], theta[1], theta[2]});
            const double stiffness =
                warp * c * c * c * c + weft * s * s * s * s + (4 * bias - warp - weft) * c * c * s * s;
            EXPECT_NEAR(reference::dot(strain, strain) / area / stiffness, 1, 1e-5) << degrees << " degrees";
        }
    }
    EXPECT_GT(inner, 20);
}

TEST(PlateRows, come_from_the_model_that_is_asked_for) {
    const TriangleMesh mesh = make_grid({1, 1}, {5, 4}, GridDiagonal::alternating);
    const auto topology = build_topology(mesh);
    const RestShape rest = make_rest_shape(mesh, *topology);
    for (const BendModel model : {BendModel::dihedral, BendModel::plate}) {
        const BendMaterial material{.model = model};
        EXPECT_EQ(build_bend(rest, material).size() > 0, model == BendModel::dihedral);
        EXPECT_EQ(build_plate(rest, material).size(), model == BendModel::plate ? topology->triangles.size() : 0u);
        EXPECT_EQ(build_plate(rest, {.bend = {0, 0, 0}, .model = model}).size(), 0u) << "limp";
    }
}

TEST(PlateRows, of_the_border_let_the_edge_go) {
    const Built two = build(make_grid({1, 1}, {2, 2}, GridDiagonal::uniform), {});
    ASSERT_EQ(two.rows.size(), 2u);
    for (std::uint32_t r = 0; r < 2; ++r) {
        EXPECT_EQ(repeats(two.rows, r), 2);
        const std::uint32_t* p = two.rows.particles.data() + 6 * std::size_t{r};
        for (int i = 0; i < 3; ++i) {
            EXPECT_NE(p[i], p[3 + i]) << "the tip of the triangle itself";
        }
        // One angle is left, and the energy of a right triangle curved across its longest side with both others free:
        // the stiffness 1 of that angle is halved by them.
        const PlateRow row = row_at(two.rows, r);
        const vec3 each[3] = {components(row, {1, 0, 0}), components(row, {0, 1, 0}), components(row, {0, 0, 1})};
        int at_work = 0;
        for (const vec3& strain : each) at_work += norm(strain) > 0;
        EXPECT_EQ(at_work, 1);
    }
    TriangleMesh one = make_grid({1, 1}, {2, 2}, GridDiagonal::uniform);
    one.triangles.resize(1);
    one.positions.resize(3), one.triangles[0] = {0, 1, 2}, one.uvs.clear();
    one.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}};
    EXPECT_EQ(build(one, {}).rows.size(), 0u);
}

TEST(PlateRows, never_move_a_neighbor_twice) {
    TriangleMesh tetrahedron;
    tetrahedron.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    const Built built = build(tetrahedron, {});
    EXPECT_EQ(built.rows.size(), 12u) << "three neighbors each, all the same particle";
    for (std::uint32_t r = 0; r < built.rows.size(); ++r) {
        const std::uint32_t* p = built.rows.particles.data() + 6 * std::size_t{r};
        int wings = 0;
        for (int i = 0; i < 3; ++i) wings += std::find(p + 3, p + 6, p[i]) == p + 6;
        EXPECT_EQ(wings, 1);
    }
}

TEST(PlateRows, rest_angle_is_the_mesh_s_or_the_given_one) {
    TriangleMesh mesh = make_grid({1, 1}, {3, 2}, GridDiagonal::uniform);
    for (Vec3& p : mesh.positions) {
        if (p.x > 0.1f) p = {0, 0.5f, p.z};  // the right half stands up
    }
    for (const bool turned : {false, true}) {
        if (turned) std::swap(mesh.triangles.back()[0], mesh.triangles.back()[1]);
        const auto count = [&](const Built& built, double angle) {
            int found = 0;
            for (std::uint32_t r = 0; r < built.rows.size(); ++r) {
                for (int i = 0; i < 3; ++i) found += std::abs(built.rows.fields[9 * r + i] - angle) < 1e-5;
            }
            return found;
        };
        const Built built = build(mesh, {}), given = build(mesh, {.rest_angle = 30});
        // Two triangles see the fold; six times a triangle sees a neighbor.
        EXPECT_EQ(count(built, pi / 2) + count(built, -pi / 2), 2);
        EXPECT_EQ(count(given, pi / 6), turned ? 5 : 6);
        EXPECT_EQ(count(given, -pi / 6), turned ? 1 : 0) << "seen from behind, the fold goes the other way";
    }
}

}  // namespace
}  // namespace weft
