#include "mesh/procedural.h"
#include "physics/moment/coupled_hinges.h"
#include "physics/testing.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace weft {
namespace {

using testing_kernels::Random;
using Row = std::vector<double>;
using Matrix = std::vector<Row>;

struct Sheet {
    std::unique_ptr<Topology> topology;
    RestShape rest;
    std::vector<CoupledHinge> hinges;
    std::vector<std::array<SideCompliance, 2>> in;  ///< by hinge
    double rate(std::size_t h) const { return std::min(in[h][0].rate(), in[h][1].rate()); }
};

Sheet sheet_of(const TriangleMesh& mesh, const BendMaterial& material = {.bend = {1, 1, 1}}) {
    auto topology = std::make_unique<Topology>(*build_topology(mesh, {.reorder = false}));
    RestShape rest = make_rest_shape(mesh, *topology);
    Sheet sheet{std::move(topology), std::move(rest), {}, {}};
    sheet.hinges = couple_hinges(sheet.rest);
    const SheetStiffness stiffness(material);
    for (const auto& [side, linked] : sheet.hinges)
        sheet.in.push_back({compliance_of(side[0], stiffness), compliance_of(side[1], stiffness)});
    return sheet;
}

TriangleMesh shaken(TriangleMesh mesh, double by, unsigned seed, float length = 1) {
    Random random(seed);
    for (Vec3& p : mesh.positions) {
        if (std::abs(p.x) > 0.49f * length || std::abs(p.z) > 0.34f) continue;
        p.x += static_cast<float>(random.number(-by, by)), p.z += static_cast<float>(random.number(-by, by));
    }
    mesh.uvs.clear();  // the warp runs along x
    return mesh;
}

/// α: the angles are α times the moments. `rigid`: these triangles do not bend.
Matrix compliance(const Sheet& sheet, const std::vector<bool>& rigid = {}) {
    Matrix alpha(sheet.hinges.size(), Row(sheet.hinges.size()));
    for (std::size_t h = 0; h < sheet.hinges.size(); ++h) {
        const Hinge& hinge = sheet.topology->hinges[h];
        for (std::size_t side = 0; side < 2; ++side) {
            if (!rigid.empty() && rigid[side == 0 ? hinge.triangle0 : hinge.triangle1]) continue;
            const SideCompliance& in = sheet.in[h][side];
            alpha[h][h] += in.total();
            for (std::size_t k = 0; k < 2; ++k)
                if (const std::uint32_t other = sheet.hinges[h].linked[side][k]; other != none)
                    alpha[h][other] += in.by[k];
        }
    }
    return alpha;
}

/// Cholesky in place; false if an eigenvalue is not positive.
bool factorize(Matrix& a) {
    for (std::size_t j = 0; j < a.size(); ++j) {
        for (std::size_t i = j; i < a.size(); ++i) {
            double sum = a[i][j];
            for (std::size_t k = 0; k < j; ++k) sum -= a[i][k] * a[j][k];
            if (i == j && !(sum > 0)) return false;
            a[i][j] = i == j ? std::sqrt(sum) : sum / a[j][j];
        }
    }
    return true;
}
void solve_lower(const Matrix& l, Row& b) {
    for (std::size_t i = 0; i < b.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) b[i] -= l[i][k] * b[k];
        b[i] /= l[i][i];
    }
}
void solve_upper(const Matrix& l, Row& b) {
    for (std::size_t i = b.size(); i-- > 0;) {
        for (std::size_t k = i + 1; k < b.size(); ++k) b[i] -= l[k][i] * b[k];
        b[i] /= l[i][i];
    }
}

/// Height of the tips of a flat sheet of length 1 along x, clamped where x < 0, under a load of 1 per area.
double tip_under_load(const Sheet& sheet) {
    const Topology& topology = *sheet.topology;
    const auto place = [&](std::uint32_t p) { return topology.rest_positions[p]; };
    const auto clamped = [&](std::uint32_t p) { return place(p).x < -0.5f + 1e-4f; };
    std::vector<bool> rigid;
    Row load(topology.particle_count);
    for (const Triangle& corners : topology.triangles) {
        rigid.push_back(std::ranges::all_of(corners, clamped));
        const double area =
            0.5 * double{length(cross(place(corners[1]) - place(corners[0]), place(corners[2]) - place(corners[0])))};
        for (const std::uint32_t p : corners) load[p] += area / 3;
    }
    std::vector<std::uint32_t> unknown(topology.particle_count, none), bends;
    std::uint32_t unknowns = 0;
    for (std::uint32_t p = 0; p < topology.particle_count; ++p)
        if (!clamped(p)) unknown[p] = unknowns++;
    for (std::uint32_t h = 0; h < topology.hinges.size(); ++h)
        if (!rigid[topology.hinges[h].triangle0] || !rigid[topology.hinges[h].triangle1]) bends.push_back(h);
    const Matrix all = compliance(sheet, rigid);
    Matrix alpha(bends.size(), Row(bends.size()));
    for (std::size_t i = 0; i < bends.size(); ++i)
        for (std::size_t j = 0; j < bends.size(); ++j) alpha[i][j] = all[bends[i]][bends[j]];
    EXPECT_TRUE(factorize(alpha));

    // Angle by height: 1 over the height of each triangle at its tip.
    Matrix angle(unknowns, Row(bends.size()));
    for (std::size_t i = 0; i < bends.size(); ++i) {
        const Hinge& hinge = topology.hinges[bends[i]];
        const Vec3 e = place(hinge.b) - place(hinge.a);
        const auto add = [&](std::uint32_t p, double slope) {
            if (unknown[p] != none) angle[unknown[p]][i] += slope;
        };
        for (const std::uint32_t tip : {hinge.c, hinge.d}) {
            const Vec3 to = place(tip) - place(hinge.a);
            const double along = double{dot(to, e)} / double{dot(e, e)},
                         height = double{length(cross(e, to))} / double{length(e)};
            add(tip, 1 / height), add(hinge.a, -(1 - along) / height), add(hinge.b, -along / height);
        }
    }
    for (Row& row : angle) solve_lower(alpha, row);
    Matrix stiffness(unknowns, Row(unknowns));
    Row height(unknowns);
    for (std::uint32_t p = 0; p < topology.particle_count; ++p)
        if (unknown[p] != none) height[unknown[p]] = load[p];
    for (std::uint32_t i = 0; i < unknowns; ++i)
        for (std::uint32_t j = 0; j < unknowns; ++j)
            for (std::size_t k = 0; k < bends.size(); ++k) stiffness[i][j] += angle[i][k] * angle[j][k];
    EXPECT_TRUE(factorize(stiffness));
    solve_lower(stiffness, height), solve_upper(stiffness, height);
    double sum = 0, count = 0;
    for (std::uint32_t p = 0; p < topology.particle_count; ++p)
        if (double{place(p).x} > 0.5 - 1e-4) sum += height[unknown[p]], ++count;
    return sum / count;
}

/// Of length 1 from x = -0.5 on, and one more cell for the clamp.
TriangleMesh clamped_sheet(std::uint32_t cells, GridDiagonal diagonal) {
    const float cell = 1 / static_cast<float>(cells);
    TriangleMesh mesh = make_grid({1 + cell, 0.7f}, {cells + 2, cells * 7 / 10 + 1}, diagonal);
    for (Vec3& p : mesh.positions) p.x -= cell / 2;
    return mesh;
}

TEST(Moment, bends_a_clamped_sheet_as_theory_says_on_any_triangulation) {
    // A wide strip with the load q has w = q L⁴/(8 B) at its tip, if bending one way does not bend the other.
    const BendMaterial materials[] = {{.bend = {1, 1, 1}}, {.bend = {2, 1, 0.8f}}, {.bend = {1, 3, 2}}};
    for (const BendMaterial& material : materials) {
        const double theory = 1 / (8 * double{material.bend[0]});
        for (const GridDiagonal diagonal : {GridDiagonal::uniform, GridDiagonal::alternating, GridDiagonal::cross}) {
            const double coarse = tip_under_load(sheet_of(clamped_sheet(7, diagonal), material)) / theory - 1,
                         fine = tip_under_load(sheet_of(clamped_sheet(14, diagonal), material)) / theory - 1;
            EXPECT_NEAR(coarse, 0, 0.075);
            EXPECT_NEAR(fine, 0, 0.016);
            EXPECT_LT(std::abs(fine), 0.3 * std::abs(coarse)) << "of second order in the size of the cells";
        }
        for (const unsigned seed : {1u, 2u}) {
            TriangleMesh mesh = shaken(clamped_sheet(14, GridDiagonal::alternating), 0.25 / 14, seed);
            EXPECT_NEAR(tip_under_load(sheet_of(mesh, material)) / theory, 1, 0.014);
        }
    }
}

TEST(Moment, has_no_direction_without_stiffness_or_with_too_much) {
    // What acts at once is part of the compliance, so α less that has no negative eigenvalue.
    for (const unsigned seed : {1u, 2u, 3u, 4u}) {
        const double by = seed < 3 ? 0.02 : 0.06;  // needles and flipped triangles
        const Sheet sheet =
            sheet_of(shaken(make_grid({1, 0.7f}, {9, 7}, GridDiagonal::alternating), by, seed), {.bend = {1, 2, 0.7f}});
        Matrix alpha = compliance(sheet);
        for (std::size_t i = 0; i < alpha.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_NEAR(alpha[i][j], alpha[j][i], 1e-5 * (alpha[i][i] + alpha[j][j])) << "symmetric";
            if (alpha[i][i] == 0) alpha[i][i] = 1;  // between triangles without an area
            alpha[i][i] -= (1 - 1e-5) * (sheet.in[i][0].at_once + sheet.in[i][1].at_once);
        }
        EXPECT_TRUE(factorize(alpha));
    }
}

/// Shifts the rest angles under fixed angles until nothing changes. Returns the largest error of α m = θ.
double settled(const Sheet& sheet, const Row& theta, const std::vector<bool>& rigid, int substeps) {
    const std::size_t count = sheet.hinges.size();
    std::array<Row, 2> shift{Row(count), Row(count)};
    Row moment(count);
    const auto bends = [&](std::size_t h, std::size_t side) {
        const Hinge& hinge = sheet.topology->hinges[h];
        return rigid[side == 0 ? hinge.triangle0 : hinge.triangle1] ? 0.0 : 1.0;
    };
    const auto find_moments = [&] {
        for (std::size_t h = 0; h < count; ++h) {
            double at_once = 0, moved = 0;
            for (std::size_t side = 0; side < 2; ++side) {
                at_once += sheet.in[h][side].at_once * bends(h, side);
                moved += shift[side][h] * bends(h, side);
            }
            moment[h] = at_once > 0 ? (theta[h] - moved) / at_once : 0;
        }
    };
    for (int i = 0; i < substeps; ++i) {
        find_moments();
        for (std::size_t h = 0; h < count; ++h) {
            for (std::size_t side = 0; side < 2; ++side) {
                const SideCompliance& in = sheet.in[h][side];
                const auto of = [&](std::size_t k) {
                    const std::uint32_t other = sheet.hinges[h].linked[side][k];
                    return other == none ? 0.0 : moment[other];
                };
                shift[side][h] = reference::shift_moment(shift[side][h], moment[h], of(0), of(1), in.own, in.by[0],
                                                         in.by[1], sheet.rate(h));
            }
        }
    }
    find_moments();
    const Matrix alpha = compliance(sheet, rigid);
    double worst = 0, largest = 0;
    for (std::size_t h = 0; h < count; ++h) {
        if (!(alpha[h][h] > 0)) continue;
        double left = -theta[h];
        for (std::size_t k = 0; k < count; ++k) left += alpha[h][k] * moment[k];
        worst = std::max(worst, std::abs(left)), largest = std::max(largest, std::abs(theta[h]));
    }
    return worst / largest;
}

TEST(Moment, of_a_sheet_at_rest_is_that_of_the_coupled_hinges) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        const Sheet sheet = sheet_of(shaken(make_grid({1, 0.7f}, {9, 7}, GridDiagonal::alternating), 0.02, seed),
                                     {.bend = {1, 2, 0.7f}});
        Random random(seed);
        Row theta(sheet.hinges.size());
        for (double& one : theta) one = random.number(-1, 1);
        std::vector<bool> rigid(sheet.topology->triangles.size());
        EXPECT_LT(settled(sheet, theta, rigid, 600), 1e-3);
        // With pinned triangles, which do not bend.
        for (std::size_t t = 0; t < rigid.size(); ++t) rigid[t] = random.number(0, 1) < 0.3;
        EXPECT_LT(settled(sheet, theta, rigid, 600), 1e-3);
    }
    const Sheet grid = sheet_of(make_grid({1, 1}, {9, 9}, GridDiagonal::uniform));
    const Row bent(grid.hinges.size(), 0.1);
    const std::vector<bool> rigid(grid.topology->triangles.size());
    EXPECT_LT(settled(grid, bent, rigid, 12), 0.05) << "within a frame of 12 substeps";
    // Needles take longer, and nothing grows.
    const Sheet needles = sheet_of(shaken(make_grid({1, 0.7f}, {9, 7}, GridDiagonal::alternating), 0.055, 8));
    Row theta(needles.hinges.size());
    Random random(5);
    for (double& one : theta) one = random.number(-1, 1);
    const std::vector<bool> none_rigid(needles.topology->triangles.size());
    EXPECT_LE(settled(needles, theta, none_rigid, 2000), settled(needles, theta, none_rigid, 20));
}

TEST(Moment, projects_a_hinge_with_its_rest_angle_shifted) {
    Random random(3);
    for (int i = 0; i < 200; ++i) {
        using V = scalar::vec3;
        const auto number = [&](double low, double high) { return static_cast<float>(random.number(low, high)); };
        V x[4], y[4];
        for (int k = 0; k < 4; ++k) x[k] = y[k] = V(number(-1, 1), number(-1, 1), number(-1, 1));
        const bool pinned = i % 4 == 0;
        const float edge = pinned ? 0.0f : 2.0f, c = number(0, 1e-3), d = number(0, 1e-3), rest = number(-1, 1),
                    shift = number(-1, 1);
        float lambda = 0, expected = 0;
        scalar::Step step = scalar::step_without_limits(1e-2f, 1e2f, 1e4f);
        scalar::project_bend(x[0], x[1], x[2], x[3], edge, edge, 0, 1, expected,
                             {rest + (pinned ? shift : shift - 0.25f + 0.25f), pinned ? d : c + d}, step);
        step.shift_c = pinned ? 5 : shift - 0.25f;
        step.shift_d = pinned ? shift : 0.25f;
        scalar::project_moment(y[0], y[1], y[2], y[3], edge, edge, 0, 1, lambda, {rest, c, d, 1}, step);
        EXPECT_EQ(lambda, expected);
        for (int k = 0; k < 4; ++k) EXPECT_TRUE(x[k].x == y[k].x && x[k].y == y[k].y && x[k].z == y[k].z);
    }
}

TEST(MomentRows, refer_to_the_hinges_of_the_same_triangles) {
    const TriangleMesh mesh = make_grid({1, 1}, {5, 4}, GridDiagonal::alternating);
    const auto topology = build_topology(mesh);
    const RestShape rest = make_rest_shape(mesh, *topology);
    const RowList rows = build_moment(rest, {.model = BendModel::moment});
    ASSERT_EQ(rows.size(), topology->hinges.size());
    ASSERT_EQ(rows.coupled.size(), coupled_rows * rows.size());
    ASSERT_EQ(rows.coupling.size(), coupled_numbers * rows.size());
    EXPECT_EQ(build_bend(rest, {.model = BendModel::moment}).size(), 0u);
    EXPECT_EQ(build_moment(rest, {.model = BendModel::dihedral}).size(), 0u);
    EXPECT_EQ(build_moment(rest, {.bend = {0, 0, 0}, .model = BendModel::moment}).size(), 0u) << "limp";
    for (std::uint32_t r = 0; r < rows.size(); ++r) {
        const std::uint32_t* mine = rows.particles.data() + 4 * std::size_t{r};
        for (std::uint32_t k = 0; k < coupled_rows; ++k) {
            const std::uint32_t other = rows.coupled[coupled_rows * r + k];
            if (other == none) continue;
            const std::uint32_t* theirs = rows.particles.data() + 4 * std::size_t{other};
            const std::uint32_t tip = mine[k < 2 ? 2 : 3];
            const std::array ends{theirs[0], theirs[1]};
            EXPECT_TRUE(std::ranges::find(ends, tip) != ends.end()) << "the other edges of a triangle end at its tip";
            EXPECT_TRUE(std::ranges::find(ends, mine[0]) != ends.end() ||
                        std::ranges::find(ends, mine[1]) != ends.end());
        }
    }
}

TEST(MomentRows, are_finite_for_odd_meshes_and_fabrics) {
    for (const BendMaterial& material :
         {BendMaterial{.bend = {1, 0, 0}}, BendMaterial{.bend = {0, 0, 1}}, BendMaterial{.bend = {1e3f, 1e-20f, 1}},
          BendMaterial{.bend = {1e-30f, 1e-30f, 1e-30f}}, BendMaterial{.bend = {1, 0.1f, 1}}}) {
        for (const unsigned seed : {1u, 2u, 3u}) {
            TriangleMesh mesh = shaken(make_grid({1, 0.7f}, {9, 7}, GridDiagonal::cross), 0.1, seed);
            mesh.positions[20] = mesh.positions[21];  // triangles without an area
            auto topology = build_topology(mesh, {.reorder = false});
            if (!topology) continue;
            BendMaterial moment = material;
            moment.model = BendModel::moment;
            const RowList rows = build_moment(make_rest_shape(mesh, *topology), moment);
            for (const float one : rows.fields) EXPECT_TRUE(std::isfinite(one));
            for (const float one : rows.coupling) EXPECT_TRUE(std::isfinite(one));
            for (std::uint32_t r = 0; r < rows.size(); ++r) {
                EXPECT_GE(rows.fields[4 * r + 1], 0) << "compliance";
                EXPECT_GE(rows.fields[4 * r + 2], 0);
                EXPECT_LE(rows.coupling[coupled_numbers * r + 6], 1) << "rate";
            }
        }
    }
}

}  // namespace
}  // namespace weft
