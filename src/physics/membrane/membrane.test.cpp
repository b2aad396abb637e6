#include "mesh/procedural.h"
#include "physics/constraint.h"
#include "physics/membrane/membrane_split.h"
#include "physics/testing.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

using namespace testing_kernels;
using reference::MembraneRow;

struct Stretched {
    vec3 p[3];
    double w[3] = {1, 1, 1};
    double lambda[3] = {};

    void project(const MembraneRow& row, double h) {
        reference::project_membrane(p[0], p[1], p[2], w[0], w[1], w[2], lambda[0], lambda[1], lambda[2], row,
                                    make_step(h));
    }
    std::array<double, 3> measures(const MembraneRow& row) const {
        const auto e = reference::membrane_edges(p[0], p[1], p[2]);
        return {(reference::dot(e.a, e.a) - row.rest_a) / 2, (reference::dot(e.b, e.b) - row.rest_b) / 2,
                (reference::dot(e.c, e.c) - row.rest_c) / 2};
    }
    vec3 components(const MembraneRow& row) const {
        const auto s = measures(row);
        return reference::coupled_strains(reference::membrane_stiffness(row), {s[0], s[1], s[2]});
    }
};

// Gradients of the three measures: those of the corners.
std::array<std::array<vec3, 3>, 3> measure_gradients(const Stretched& t) {
    const auto e = reference::membrane_edges(t.p[0], t.p[1], t.p[2]);
    const vec3 zero(0.0);
    return {{{zero, -e.a, e.a}, {e.b, zero, -e.b}, {-e.c, e.c, zero}}};
}

Stretched random_stretched(Random& random) {
    const vec3 flat[3] = {{0, 0, 0}, {0.1, 0, 1}, {1, 0, 0.2}};
    Stretched t{};
    for (int k = 0; k < 3; ++k) t.p[k] = flat[k] + random.vector(0.2), t.w[k] = random.number(0.1, 5);
    return t;
}

MembraneRow random_membrane(Random& random) {
    const auto some = [&] { return random.number(-2, 2); };
    return {random.number(0.5, 1.5),
            random.number(0.5, 1.5),
            random.number(0.5, 1.5),
            some(),
            some(),
            some(),
            some(),
            some(),
            some()};
}

TEST(Membrane, gradient_is_that_of_the_measures) {
    Random random(1);
    for (int i = 0; i < 50; ++i) {
        Stretched t = random_stretched(random);
        const MembraneRow row = random_membrane(random);
        const auto all = measure_gradients(t);
        for (std::size_t k = 0; k < 3; ++k)
            expect_gradient(
                t.p, all[k], [&] { return t.measures(row)[k]; }, 1e-8);
    }
}

TEST(Membrane, keeps_linear_and_angular_momentum) {
    Random random(2);
    for (int i = 0; i < 500; ++i) {
        Stretched t = random_stretched(random);
        for (double& lambda : t.lambda) lambda = random.number(-0.1, 0.1);
        const Stretched before = t;
        t.project(random_membrane(random), 0.3);
        vec3 linear(0.0), angular(0.0);
        for (int k = 0; k < 3; ++k) {
            const vec3 impulse = (t.p[k] - before.p[k]) * (1 / t.w[k]);
            linear = linear + impulse;
            angular = angular + reference::cross(before.p[k], impulse);
        }
        EXPECT_LT(norm(linear), 1e-9);
        EXPECT_LT(norm(angular), 1e-9);
        EXPECT_GT(norm(t.p[0] - before.p[0]), 0);
    }
}

TEST(Membrane, solves_its_three_numbers_at_once) {
    Random random(3);
    for (int i = 0; i < 100; ++i) {
        const Stretched t = random_stretched(random);
        const MembraneRow row = random_membrane(random);
        const auto l = reference::membrane_stiffness(row);
        const auto g = reference::membrane_gradients(reference::membrane_edges(t.p[0], t.p[1], t.p[2]), l);
        const vec3 r = random.vector(1);
        const double k = random.number(0, 10);
        const vec3 x = reference::solve_membrane(g, t.w[0], t.w[1], t.w[2], k, r),
                   force = reference::coupled_forces(l, x);
        const double forces[3] = {force.x, force.y, force.z};
        // Transposed L W L x, summed corner by corner.
        const auto of_measures = measure_gradients(t);
        double change[3] = {};
        for (int p = 0; p < 3; ++p) {
            vec3 moved(0.0);
            for (int m = 0; m < 3; ++m) moved = moved + of_measures[m][p] * (t.w[p] * forces[m]);
            for (int m = 0; m < 3; ++m) change[m] += reference::dot(of_measures[m][p], moved);
        }
        const vec3 left = x + reference::coupled_strains(l, {change[0], change[1], change[2]}) * k - r;
        EXPECT_LT(norm(left), 1e-9);
    }
}

TEST(Membrane, comes_to_rest_where_its_forces_are_those_of_its_stiffness) {
    Random random(4);
    for (int i = 0; i < 20; ++i) {
        Stretched t = random_stretched(random);
        MembraneRow row = random_membrane(random);
        const double h = 0.2, before = norm(t.components(row));
        for (int n = 0; n < 200; ++n) t.project(row, h);
        const vec3 strain = t.components(row);
        const double s[3] = {strain.x, strain.y, strain.z};
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(t.lambda[k], -h * h * s[k], 1e-9);
        EXPECT_LT(norm(strain), before);
    }
}

TEST(Membrane, damping_takes_stretching_and_leaves_rigid_motion) {
    Random random(5);
    const Stretched t = random_stretched(random);
    const MembraneRow row{1, 1, 1, 1, 0.3, 1, 0.3, 0.3, 1};
    const vec3 drift(1, 2, 3), spin(0.5, -1, 0.25);
    const auto damp = [&](vec3* v) {
        reference::damp_membrane(v[0], v[1], v[2], t.p[0], t.p[1], t.p[2], t.w[0], t.w[1], t.w[2], row, 2.0);
    };
    vec3 v[3];
    for (int k = 0; k < 3; ++k) v[k] = drift + reference::cross(spin, t.p[k]);
    const vec3 rigid[3] = {v[0], v[1], v[2]};
    damp(v);
    for (int k = 0; k < 3; ++k) EXPECT_LT(norm(v[k] - rigid[k]), 1e-12);
    v[1] = v[1] + (t.p[1] - t.p[0]);
    const auto rate = [&] { return std::abs(reference::dot(t.p[1] - t.p[0], v[1] - v[0])); };
    const double before = rate();
    damp(v);
    EXPECT_LT(rate(), 0.9 * before);
}

TEST(Membrane, survives_degenerate_input) {
    using V = scalar::vec3;
    const V a(0, 0, 0), b(0, 0, 1), c(1, 0, 0);
    const V cases[][3] = {{a, b, c},
                          {a, a, a},
                          {a, a, c},
                          {a, b, V(0, 0, 0.5f)},
                          {a, b, V(1e-20f, 0, 0)},
                          {V(1e15f, 1e15f, 0), V(0, 1e15f, 0), V(0, 0, -1e15f)}};
    for (const auto& points : cases)
        for (const float w : {0.0f, 1.0f, 1e6f})
            for (const float l : {0.0f, 1e-4f, 1.0f, 1e15f})
                for (const float h : {1e-3f, 1.0f}) {
                    V p[3] = {points[0], points[1], points[2]};
                    float lambda[3] = {};
                    scalar::project_membrane(p[0], p[1], p[2], w, w, w, lambda[0], lambda[1], lambda[2],
                                             {1, 0, 2, l, l, l, l, l, l},
                                             scalar::step_without_limits(h, 1 / h, 1 / h / h));
                    for (const V& q : p) EXPECT_TRUE(std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z));
                    for (const float x : lambda) EXPECT_TRUE(std::isfinite(x));
                    if (w == 0) {
                        for (const float x : lambda) EXPECT_EQ(x, 0);
                    }
                }
}

// In a needle the strains along it and across differ in scale by its shape; squares of coordinates must not cancel.
TEST(Membrane, of_a_needle_is_stable) {
    Random random(7);
    for (int i = 0; i < 200; ++i) {
        const double height = std::pow(10, random.number(-4, -1));
        TriangleMesh mesh;
        mesh.positions = {{2, 0, 1},
                          {2.1f, 0, 1},
                          {2 + static_cast<float>(random.number(0, 0.1)), 0, 1 + static_cast<float>(height)}};
        mesh.triangles = {{0, 1, 2}};
        const auto topology = build_topology(mesh, {.reorder = false});
        ASSERT_TRUE(topology.ok());
        const RowList rows =
            build_membrane(make_rest_shape(mesh, *topology), {.shear = 40, .model = StretchModel::membrane});
        ASSERT_EQ(rows.size(), 1u);
        const float* f = rows.fields.data();
        const scalar::MembraneRow row{f[0], f[1], f[2], f[3], f[4], f[5], f[6], f[7], f[8]};
        scalar::vec3 p[3];
        for (int k = 0; k < 3; ++k) {
            const Vec3 at = topology->rest_positions[rows.particles[static_cast<std::size_t>(k)]];
            const vec3 moved = random.vector(1e-5);
            p[k] = {at.x + static_cast<float>(moved.x), at.y + static_cast<float>(moved.y),
                    at.z + static_cast<float>(moved.z)};
        }
        const scalar::vec3 before[3] = {p[0], p[1], p[2]};
        const float h = 1.0f / 4800, w = 1e4f;
        for (int n = 0; n < 20; ++n) {
            float lambda[3] = {};
            scalar::project_membrane(p[0], p[1], p[2], w, w, w, lambda[0], lambda[1], lambda[2], row,
                                     scalar::step_without_limits(h, 1 / h, 1 / h / h));
        }
        for (int k = 0; k < 3; ++k) {
            const scalar::vec3 way = p[k] - before[k];
            EXPECT_LT(scalar::dot(way, way), 1e-8f) << "height " << height;
        }
    }
}

// A mesh whose triangles have all kinds of shapes and directions.
TriangleMesh irregular_sheet() {
    TriangleMesh mesh = make_grid({1, 1.5f}, {9, 9}, GridDiagonal::alternating);
    Random random(6);
    for (Vec3& p : mesh.positions) {
        p.x += static_cast<float>(random.number(-0.03, 0.03)), p.z += static_cast<float>(random.number(-0.04, 0.04));
    }
    mesh.uvs.clear();  // the warp runs along x
    return mesh;
}

double energy_in(const RowList& edges, const RowList& triangles, const std::vector<vec3>& x) {
    double energy = 0;
    for (std::uint32_t r = 0; r < edges.size(); ++r) {
        const std::uint32_t* p = edges.particles.data() + std::size_t{2} * r;
        const float* f = edges.fields.data() + std::size_t{edges.field_count} * r;
        const double longer = norm(x[p[1]] - x[p[0]]) - double{f[0]}, compliance = longer > 0 ? f[1] : f[2];
        if (compliance > 0) energy += longer * longer / (2 * compliance);
    }
    for (std::uint32_t r = 0; r < triangles.size(); ++r) {
        const std::uint32_t* p = triangles.particles.data() + std::size_t{3} * r;
        const float* f = triangles.fields.data() + std::size_t{9} * r;
        const Stretched t{{x[p[0]], x[p[1]], x[p[2]]}};
        const vec3 c = t.components({f[0], f[1], f[2], f[3], f[4], f[5], f[6], f[7], f[8]});
        energy += reference::dot(c, c) / 2;
    }
    return energy;
}

struct NamedStretch {
    const char* name;
    StretchMaterial material;
};
const NamedStretch named_stretches[] = {
    {"cotton", {.stretch = {4000, 4000}, .compression = {4000, 4000}, .shear = 40}},
    {"denim", {.stretch = {411, 2028}, .compression = {411, 2028}, .shear = 27}},
    {"rubber", {.stretch = {300, 300}, .compression = {300, 300}, .shear = 100}},
    {"no shear", {.stretch = {1000, 500}, .compression = {1000, 500}, .shear = 0}},
    {"shear alone", {.stretch = {0, 0}, .compression = {0, 0}, .shear = 50}},
    {"one direction", {.stretch = {800, 0}, .compression = {800, 0}, .shear = 20}},
};

TEST(MembraneRows, and_edges_have_the_energy_of_the_strain_on_any_mesh_and_in_any_direction) {
    for (const TriangleMesh& mesh : {irregular_sheet(), make_grid({1, 1}, {7, 7}, GridDiagonal::uniform),
                                     make_grid({1, 1}, {7, 7}, GridDiagonal::cross)}) {
        const Topology topology = *build_topology(mesh, {.reorder = false});
        const RestShape rest = make_rest_shape(mesh, topology);
        double area = 0;
        for (const float a : rest.area) area += a;
        for (NamedStretch fabric : named_stretches) {
            SCOPED_TRACE(fabric.name);
            fabric.material.model = StretchModel::membrane;
            const RowList edges = build_stretch(rest, fabric.material),
                          triangles = build_membrane(rest, fabric.material);
            const auto& k = fabric.material;
            for (const auto& [warp, weft, shear] :
                 {std::array{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {0.7, -0.4, 0.5}, {-0.3, 0.8, -0.6}}) {
                const double size = 1e-3;
                std::vector<vec3> x;
                for (const Vec3& p : topology.rest_positions) {
                    const double u = p.x, v = p.z;
                    // Symmetric, so nothing turns.
                    x.push_back({u + size * (warp * u + shear / 2 * v), 0, v + size * (weft * v + shear / 2 * u)});
                }
                const double expected =
                    area / 2 * size * size *
                    (k.stretch[0] * warp * warp + k.stretch[1] * weft * weft + k.shear * shear * shear);
                // The rest lengths are floats, and the measures have terms of the second order.
                EXPECT_NEAR(
                    energy_in(edges, triangles, x), expected,
                    4e-3 * expected + 1e-6 * area * size * size * std::max({k.stretch[0], k.stretch[1], k.shear}))
                    << warp << ' ' << weft << ' ' << shear;
            }
        }
    }
}

TEST(MembraneRows, leave_a_grid_s_edges_what_they_have_along_the_threads) {
    const TriangleMesh mesh = make_grid({1, 1}, {6, 6}, GridDiagonal::alternating);
    const Topology topology = *build_topology(mesh, {.reorder = false});
    const RestShape rest = make_rest_shape(mesh, topology);
    const StretchMaterial material{
        .stretch = {1000, 3000}, .compression = {500, 1500}, .shear = 20, .model = StretchModel::membrane};
    const RowList edges = build_stretch(rest, material);
    EXPECT_EQ(edges.size(), 2u * 5 * 6) << "none on diagonals";
    for (std::uint32_t r = 0; r < edges.size(); ++r) {
        const Vec3 along =
            topology.rest_positions[edges.particles[2 * r + 1]] - topology.rest_positions[edges.particles[2 * r]];
        const bool warp = std::abs(along.x) > std::abs(along.z);
        const auto e = static_cast<std::size_t>(std::ranges::find_if(topology.edges,
                                                                     [&](const Edge& edge) {
                                                                         return edge.a == edges.particles[2 * r] &&
                                                                                edge.b == edges.particles[2 * r + 1];
                                                                     }) -
                                                topology.edges.begin());
        const float strip = rest.area_at_edge[e] / dot(along, along);
        EXPECT_NEAR(edges.fields[edges.field_count * r + 1] * strip * (warp ? 1000 : 3000), 1, 1e-4);
        EXPECT_NEAR(edges.fields[edges.field_count * r + 2] * strip * (warp ? 500 : 1500), 1, 1e-4);
    }
    const RowList triangles = build_membrane(rest, material);
    EXPECT_EQ(triangles.size(), topology.triangles.size());
    for (std::uint32_t r = 0; r < triangles.size(); ++r) {
        int directions = 0;
        for (const int diagonal : {3, 5, 8}) directions += triangles.fields[9 * r + diagonal] != 0;
        EXPECT_EQ(directions, 1) << "the shear alone";
    }
}

TEST(MembraneRows, exist_only_for_the_model) {
    const TriangleMesh mesh = irregular_sheet();
    const Topology topology = *build_topology(mesh, {.reorder = false});
    const RestShape rest = make_rest_shape(mesh, topology);
    EXPECT_EQ(build_membrane(rest, {}).size(), 0u);
    EXPECT_EQ(build_membrane(rest, {.inextensible = true, .model = StretchModel::membrane}).size(), 0u);
    EXPECT_EQ(build_stretch(rest, {.inextensible = true, .model = StretchModel::membrane}).size(),
              topology.edges.size());
    const StretchMaterial none{.stretch = {0, 0}, .compression = {0, 0}, .shear = 0, .model = StretchModel::membrane};
    EXPECT_EQ(build_membrane(rest, none).size(), 0u);
    EXPECT_EQ(build_stretch(rest, none).size(), 0u);
}

}  // namespace
}  // namespace weft
