#include "physics/bend/bend_fit.h"

#include "mesh/procedural.h"
#include "physics/change_rows.h"
#include "physics/testing.h"

#include <cmath>

namespace weft {
namespace {

using testing_kernels::Random;

BendFit fit_of(TriangleMesh mesh) {
    const Topology topology = *build_topology(mesh, {.reorder = false});
    return fit_bend(make_rest_shape(mesh, topology));
}

void expect_factors(const BendFit& fit, double warp, double bias, double weft, double relative) {
    EXPECT_NEAR(double{fit.warp} / warp, 1, relative);
    EXPECT_NEAR(double{fit.bias} / bias, 1, relative);
    EXPECT_NEAR(double{fit.weft} / weft, 1, relative);
}

TriangleMesh square_grid(std::uint32_t side, GridDiagonal diagonal) {
    return make_grid({1, 1}, {side, side}, diagonal);
}

TEST(BendFit, of_regular_grids_is_that_of_their_patches) {
    for (const std::uint32_t side : {13u, 17u, 32u, 65u}) {
        expect_factors(fit_of(square_grid(side, GridDiagonal::alternating)), 1.39, 0.695, 1.39, 0.01);
        expect_factors(fit_of(square_grid(side, GridDiagonal::cross)), 0.694, 1.389, 0.694, 0.01);
        expect_factors(fit_of(square_grid(side, GridDiagonal::uniform)), 1.25, 1.25, 1.25, 1e-3);
    }
    expect_factors(fit_of(square_grid(9, GridDiagonal::alternating)), 1.32, 0.66, 1.32, 0.01);
}

TEST(BendFit, of_strips_is_one_factor) {
    expect_factors(fit_of(make_grid({1, 0.1f}, {21, 3}, GridDiagonal::alternating)), 1.175, 1.175, 1.175, 0.01);
    expect_factors(fit_of(make_grid({0.1f, 1}, {3, 21}, GridDiagonal::alternating)), 1.175, 1.175, 1.175, 0.01);
    expect_factors(fit_of(make_grid({1, 0.1f}, {21, 3}, GridDiagonal::uniform)), 1.227, 1.227, 1.227, 0.01);
    // Short ones have no patch.
    for (const std::uint32_t cells : {7u, 8u, 9u, 10u, 11u, 12u, 13u}) {
        for (const GridDiagonal diagonal : {GridDiagonal::alternating, GridDiagonal::uniform}) {
            const BendFit fit = fit_of(make_grid({0.05f * static_cast<float>(cells), 0.1f}, {cells + 1, 3}, diagonal));
            EXPECT_GE(fit.warp, 1) << cells;
            EXPECT_LE(fit.warp, 1.3f) << cells;
            EXPECT_EQ(fit.warp, fit.bias);
            EXPECT_EQ(fit.warp, fit.weft);
        }
    }
}

TEST(BendFit, depends_neither_on_size_nor_on_place_and_turns_with_the_warp) {
    TriangleMesh mesh = square_grid(33, GridDiagonal::alternating);
    for (Vec3& p : mesh.positions) {
        const Vec3 turned{0.6f * p.x, 0.8f * p.x, p.z};  // out of the horizontal plane
        p = turned * 40.0f + Vec3{100, 200, -50};
    }
    expect_factors(fit_of(mesh), 1.39, 0.695, 1.39, 0.01);
    const float r = std::sqrt(0.5f);
    mesh = square_grid(33, GridDiagonal::alternating);
    mesh.uvs.clear();
    for (const Vec3& p : mesh.positions) mesh.uvs.push_back({r * (p.x + p.z), r * (p.z - p.x)});
    expect_factors(fit_of(mesh), 0.695, 1.39, 0.695, 0.01);
}

TEST(BendFit, of_irregular_meshes_lies_near_that_of_the_grid) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        TriangleMesh mesh = square_grid(33, GridDiagonal::alternating);
        mesh.uvs.clear();
        Random random(seed);
        for (Vec3& p : mesh.positions) {
            p.x += static_cast<float>(random.number(-0.008, 0.008));
            p.z += static_cast<float>(random.number(-0.008, 0.008));
        }
        expect_factors(fit_of(mesh), 1.35, 0.64, 1.35, 0.12);
    }
}

TEST(BendFit, of_meshes_that_are_too_small_or_too_curved_is_one) {
    TriangleMesh one = square_grid(2, GridDiagonal::uniform);
    one.triangles.resize(1);
    for (const TriangleMesh& mesh : {square_grid(2, GridDiagonal::uniform), one, make_sphere(0.5f, 2)})
        expect_factors(fit_of(mesh), 1, 1, 1, 0);
}

TEST(BendFit, survives_needles_and_folded_triangles) {
    Random random(4);
    for (int i = 0; i < 20; ++i) {
        TriangleMesh mesh = square_grid(15, GridDiagonal::alternating);
        mesh.uvs.clear();
        const double size = i < 10 ? 0.2 : 1e-4;
        for (Vec3& p : mesh.positions) {
            if (random.index(3) == 0) p.x = static_cast<float>(0.5 * random.number(-1, 1));
            p.z += static_cast<float>(random.number(-size, size));
            p.y += static_cast<float>(random.number(-size, size) * 1e-3);
        }
        const auto topology = build_topology(mesh, {.reorder = false});
        ASSERT_TRUE(topology.ok());
        const BendFit fit = fit_bend(make_rest_shape(mesh, *topology));
        for (const float factor : {fit.warp, fit.bias, fit.weft}) {
            EXPECT_GE(factor, 0.4f);
            EXPECT_LE(factor, 2.5f);
        }
    }
}

TEST(BendFit, stays_when_the_stiffness_changes) {
    const TriangleMesh mesh = square_grid(17, GridDiagonal::alternating);
    const Topology topology = *build_topology(mesh, {.reorder = false});
    const RestShape rest = make_rest_shape(mesh, topology);
    const BendMaterial before{.bend = {1e-5f, 1e-5f, 1e-5f}, .fit = true},
        after{.bend = {3e-5f, 1e-5f, 2e-5f}, .fit = true};
    const RowList built = build_bend(rest, before), expected = build_bend(rest, after);
    EXPECT_NE(built.fields, build_bend(rest, {.bend = {1e-5f, 1e-5f, 1e-5f}}).fields);
    // As arrays by field.
    const std::uint32_t count = built.size();
    std::vector<std::uint32_t> particles(4 * std::size_t{count});
    std::vector<float> geometry(2 * std::size_t{count}), fields(2 * std::size_t{count});
    for (std::uint32_t r = 0; r < count; ++r) {
        for (std::uint32_t k = 0; k < 4; ++k) particles[k * count + r] = built.particles[4 * r + k];
        for (std::uint32_t k = 0; k < 2; ++k) {
            geometry[k * count + r] = built.geometry[2 * r + k];
            fields[k * count + r] = built.fields[2 * r + k];
        }
    }
    std::vector<Vec4> at_rest;
    for (const Vec3& p : topology.rest_positions) at_rest.push_back({p.x, p.y, p.z, 1});
    ASSERT_TRUE(change_bend({.stride = count,
                             .particles = particles.data(),
                             .geometry = geometry.data(),
                             .left_out = {},
                             .rest_positions = at_rest.data(),
                             .fields = fields.data()},
                            after));
    for (std::uint32_t r = 0; r < count; ++r) EXPECT_EQ(fields[count + r], expected.fields[2 * r + 1]);
}

}  // namespace
}  // namespace weft
