#include "mesh/topology.h"

#include "mesh/edges.h"
#include "mesh/procedural.h"
#include "mesh/sound_triangles.h"
#include "mesh/testing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <tuple>

namespace weft {
namespace {

using namespace testing_meshes;

Topology built(const TriangleMesh& mesh, const TopologyOptions& options = {}) {
    auto topology = build_topology(mesh, options);
    EXPECT_TRUE(topology.ok()) << topology.error().message();
    return std::move(*topology);
}

TriangleMesh drawn(std::vector<Vec3> positions, std::vector<Triangle> triangles = {}) {
    TriangleMesh mesh;
    mesh.positions = std::move(positions);
    mesh.triangles = std::move(triangles);
    return mesh;
}

TriangleMesh octahedron() {
    return drawn({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                 {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
}

/// An octahedron whose triangles are cut in four `levels` times. Every triangle has its own vertices, as in an STL
/// file.
TriangleMesh sphere_soup(int levels) {
    std::vector<std::array<Vec3, 3>> faces;
    const TriangleMesh start = octahedron();
    for (const Triangle& t : start.triangles)
        faces.push_back({start.positions[t[0]], start.positions[t[1]], start.positions[t[2]]});
    for (int level = 0; level < levels; ++level) {
        std::vector<std::array<Vec3, 3>> finer;
        for (const auto& [a, b, c] : faces) {
            const Vec3 ab = normalized(a + b), bc = normalized(b + c), ca = normalized(c + a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        faces = std::move(finer);
    }
    TriangleMesh soup;
    for (const auto& [a, b, c] : faces) add_triangle(soup, a, b, c);
    return soup;
}

std::ptrdiff_t euler_characteristic(const Topology& t) {
    return static_cast<std::ptrdiff_t>(t.particle_count + t.triangles.size()) -
           static_cast<std::ptrdiff_t>(t.edges.size());
}

/// Signed dihedral angle of a hinge, 0 where it is flat, positive where the front is convex.
double dihedral(const Topology& t, const Hinge& h) {
    const Vec3 a = t.rest_positions[h.a], b = t.rest_positions[h.b];
    const Vec3 c = t.rest_positions[h.c], d = t.rest_positions[h.d];
    const Vec3 n0 = normalized(cross(b - a, c - a)), n1 = normalized(cross(a - b, d - b));
    return std::atan2(dot(cross(n0, n1), normalized(b - a)), dot(n0, n1));
}

bool winds(const Triangle& t, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return t == Triangle{a, b, c} || t == Triangle{b, c, a} || t == Triangle{c, a, b};
}

/// Checks what holds for the topology of any mesh.
void expect_sound(const Topology& t, const TriangleMesh& mesh) {
    ASSERT_EQ(t.rest_positions.size(), t.particle_count);
    ASSERT_EQ(t.boundary.size(), t.particle_count);
    ASSERT_EQ(t.vertex_to_particle.size(), mesh.positions.size());
    ASSERT_EQ(t.source_triangle.size(), t.triangles.size());
    ASSERT_EQ(t.triangles.size() + t.report.degenerate_triangles + t.report.duplicate_triangles, mesh.triangles.size());
    ASSERT_EQ(t.welded_to_particle.size() + t.report.welded_vertices, mesh.positions.size());

    // Each triangle, edge by edge and corner by corner.
    EXPECT_TRUE(std::is_sorted(t.source_triangle.begin(), t.source_triangle.end()));
    for (std::size_t i = 0; i < t.triangles.size(); ++i)
        for (int k = 0; k < 3; ++k)
            EXPECT_EQ(t.triangles[i][k], t.vertex_to_particle[mesh.triangles[t.source_triangle[i]][k]]);
    std::set<std::uint32_t> reached(t.vertex_to_particle.begin(), t.vertex_to_particle.end());
    reached.erase(none);
    EXPECT_EQ(reached.size(), t.particle_count);
    EXPECT_EQ(static_cast<std::uint32_t>(std::count(t.vertex_to_particle.begin(), t.vertex_to_particle.end(), none)),
              t.report.isolated_vertices);

    ASSERT_EQ(t.particle_edges.size(), t.particle_count);
    ASSERT_EQ(t.particle_triangles.size(), t.particle_count);
    std::vector<std::vector<std::uint32_t>> edges(t.particle_count), triangles(t.particle_count);
    std::vector<std::uint8_t> boundary(t.particle_count, 0);
    for (std::uint32_t i = 0; i < t.edges.size(); ++i) {
        const Edge& e = t.edges[i];
        edges[e.a].push_back(i), edges[e.b].push_back(i);
        if (e.triangle1 == none) boundary[e.a] = boundary[e.b] = 1;
        EXPECT_LT(e.a, e.b);
        if (i > 0) {
            EXPECT_LT((std::pair{t.edges[i - 1].a, t.edges[i - 1].b}), (std::pair{e.a, e.b}));
        }
    }
    for (std::uint32_t i = 0; i < t.triangles.size(); ++i)
        for (const std::uint32_t p : t.triangles[i]) triangles[p].push_back(i);
    for (std::uint32_t p = 0; p < t.particle_count; ++p) {
        EXPECT_TRUE(std::ranges::equal(t.particle_edges[p], edges[p]));
        EXPECT_TRUE(std::ranges::equal(t.particle_triangles[p], triangles[p]));
        EXPECT_FALSE(triangles[p].empty());
    }
    EXPECT_EQ(t.boundary, boundary);

    std::uint32_t inconsistent = 0;
    for (std::size_t i = 0; i < t.hinges.size(); ++i) {
        const Hinge& h = t.hinges[i];
        if (i > 0) {
            EXPECT_LT(t.hinges[i - 1].edge, h.edge);
        }
        const Edge& e = t.edges[h.edge];
        EXPECT_EQ(e.a, h.a);
        EXPECT_EQ(e.b, h.b);
        EXPECT_EQ((std::set{e.triangle0, e.triangle1}), (std::set{h.triangle0, h.triangle1}));
        const bool left = winds(t.triangles[h.triangle0], h.a, h.b, h.c);
        const bool right = winds(t.triangles[h.triangle1], h.b, h.a, h.d);
        EXPECT_TRUE(left || winds(t.triangles[h.triangle0], h.b, h.a, h.c));
        EXPECT_TRUE(right || winds(t.triangles[h.triangle1], h.a, h.b, h.d));
        // At most one is flipped, and never the first.
        EXPECT_TRUE(h.triangle0 < h.triangle1 ? left : right);
        inconsistent += !(left && right);
    }
    EXPECT_EQ(inconsistent, t.report.inconsistent_edges);
}

TEST(Topology, grids_are_disks) {
    for (const auto diagonal : {GridDiagonal::uniform, GridDiagonal::alternating, GridDiagonal::cross})
        for (const auto& [nx, nz] : {std::array{2u, 2u}, std::array{9u, 4u}, std::array{3u, 30u}}) {
            const auto mesh = make_grid({1, 1}, {nx, nz}, diagonal);
            const Topology t = built(mesh);
            expect_sound(t, mesh);
            EXPECT_EQ(euler_characteristic(t), 1);
            const std::uint32_t rim = 2 * (nx + nz) - 4;
            EXPECT_EQ(std::accumulate(t.boundary.begin(), t.boundary.end(), 0u), rim);
            EXPECT_EQ(t.hinges.size(), t.edges.size() - rim);
            EXPECT_EQ(t.report.inconsistent_edges + t.report.non_manifold_edges + t.report.isolated_vertices, 0u);
            for (const Hinge& h : t.hinges) EXPECT_NEAR(dihedral(t, h), 0, 1e-5);
        }
}

TEST(Topology, single_triangle) {
    const TriangleMesh mesh = drawn({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
    const Topology t = built(mesh);
    expect_sound(t, mesh);
    EXPECT_EQ(t.edges, (std::vector<Edge>{{0, 1, 0, none}, {0, 2, 0, none}, {1, 2, 0, none}}));
    EXPECT_TRUE(t.hinges.empty());
}

TEST(Topology, hinge_picture) {
    // As drawn in topology.h: a left, b right, c above and d below, seen from +z.
    const TriangleMesh mesh = drawn({{0, 0, 0}, {1, 0, 0}, {0.5f, 1, 0}, {0.5f, -1, 0}}, {{1, 0, 3}, {2, 0, 1}});
    const Topology t = built(mesh, {.reorder = false});
    EXPECT_EQ(t.hinges, (std::vector<Hinge>{{0, 1, 2, 3, 0, 1, 0}}));
    EXPECT_EQ(t.edges[0], (Edge{0, 1, 0, 1}));
}

TEST(Topology, closed_surface_from_separate_triangles) {
    const TriangleMesh mesh = sphere_soup(4);
    for (const float distance : {0.0f, 1e-5f}) {
        const Topology t = built(mesh, {.weld_distance = distance});
        expect_sound(t, mesh);
        EXPECT_EQ(euler_characteristic(t), 2);
        EXPECT_EQ(t.particle_count, 1026u);
        EXPECT_EQ(t.report.welded_vertices, 3u * 2048 - 1026);
        EXPECT_EQ(t.hinges.size(), t.edges.size());
        EXPECT_EQ(t.report.inconsistent_edges, 0u);
        EXPECT_EQ(std::accumulate(t.boundary.begin(), t.boundary.end(), 0), 0);
        for (const Hinge& h : t.hinges) {
            EXPECT_GT(dihedral(t, h), 0);
            EXPECT_LT(dihedral(t, h), 0.3);
        }
    }
}

TEST(Topology, welded_vertices_are_numbered_by_first_appearance) {
    TriangleMesh mesh = drawn({{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, -0.0f}},
                              {{1, 2, 3}, {4, 5, 6}});
    for (const bool reorder : {false, true}) {
        const Topology t = built(mesh, {.reorder = reorder});
        expect_sound(t, mesh);
        ASSERT_EQ(t.welded_to_particle.size(), 5u);
        EXPECT_EQ(t.welded_to_particle[0], none);
        const std::array<std::uint32_t, 5> first_vertex{0, 1, 2, 3, 5};
        for (std::uint32_t w = 1; w < 5; ++w)
            EXPECT_EQ(t.rest_positions[t.welded_to_particle[w]], mesh.positions[first_vertex[w]]);
        EXPECT_EQ(t.report.isolated_vertices, 1u);
        EXPECT_EQ(t.report.welded_vertices, 2u);
        if (!reorder) {
            EXPECT_EQ(t.vertex_to_particle, (std::vector<std::uint32_t>{none, 0, 1, 2, 1, 3, 2}));
        }
    }
}

std::array<float, 3> key(Vec3 p) {
    return {p.x, p.y, p.z};
}

/// The hinges as positions, independent of the numbering.
std::multiset<std::array<std::array<float, 3>, 4>> hinges_by_place(const Topology& t) {
    std::multiset<std::array<std::array<float, 3>, 4>> places;
    for (Hinge h : t.hinges) {
        if (key(t.rest_positions[h.b]) < key(t.rest_positions[h.a])) std::swap(h.a, h.b), std::swap(h.c, h.d);
        places.insert({key(t.rest_positions[h.a]), key(t.rest_positions[h.b]), key(t.rest_positions[h.c]),
                       key(t.rest_positions[h.d])});
    }
    return places;
}

TEST(Topology, numbering_of_the_file_does_not_matter) {
    std::mt19937 random(6);
    const TriangleMesh mesh = make_grid({1, 2}, {23, 31}, GridDiagonal::alternating);
    const Topology plain = built(mesh);
    EXPECT_EQ(plain.vertex_to_particle, built(mesh, {.reorder = false}).vertex_to_particle);
    for (int round = 0; round < 3; ++round) {
        std::vector<std::uint32_t> to(mesh.positions.size());
        std::iota(to.begin(), to.end(), 0u);
        std::shuffle(to.begin(), to.end(), random);
        TriangleMesh other = drawn(std::vector<Vec3>(to.size()));
        for (std::size_t i = 0; i < to.size(); ++i) other.positions[to[i]] = mesh.positions[i];
        for (Triangle tri : mesh.triangles) {
            for (std::uint32_t& corner : tri) corner = to[corner];
            std::rotate(tri.begin(), tri.begin() + random() % 3, tri.end());
            other.triangles.push_back(tri);
        }
        std::shuffle(other.triangles.begin(), other.triangles.end(), random);
        const Topology t = built(other);
        expect_sound(t, other);
        EXPECT_EQ(t.edges.size(), plain.edges.size());
        EXPECT_EQ(hinges_by_place(t), hinges_by_place(plain));
        // Reordering replaces the shuffled numbers by ones about as good as the original.
        double span = 0, plain_span = 0;
        for (const Edge& e : t.edges) span += e.b - e.a;
        for (const Edge& e : plain.edges) plain_span += e.b - e.a;
        EXPECT_LT(span, 1.5 * plain_span);
    }
}

TEST(Topology, fan_of_five_at_one_edge) {
    TriangleMesh mesh = drawn({{0, 0, 0}, {0, 0, 1}});
    for (std::uint32_t i = 0; i < 5; ++i) {
        const float angle = static_cast<float>(i);
        mesh.positions.push_back({std::cos(angle), std::sin(angle), 0.5f});
        mesh.triangles.push_back(i % 2 ? Triangle{0, 1, 2 + i} : Triangle{1, 0, 2 + i});
    }
    const Topology t = built(mesh, {.reorder = false});
    expect_sound(t, mesh);
    EXPECT_EQ(t.report.non_manifold_edges, 1u);
    EXPECT_EQ(t.report.inconsistent_edges, 0u);
    EXPECT_EQ(t.edges.size(), 11u);
    EXPECT_EQ(t.edges[0], (Edge{0, 1, 0, 1}));
    EXPECT_TRUE(t.hinges.empty());
}

TEST(Topology, turned_triangle_keeps_a_flat_hinge) {
    for (const Triangle second : {Triangle{1, 0, 3}, Triangle{0, 1, 3}})
        for (const Triangle first : {Triangle{0, 1, 2}, Triangle{1, 0, 2}}) {
            const TriangleMesh mesh = drawn({{0, 0, 0}, {1, 0, 0}, {0.5f, 1, 0}, {0.5f, -1, 0}}, {first, second});
            const Topology t = built(mesh);
            expect_sound(t, mesh);
            EXPECT_EQ(t.report.inconsistent_edges, first[0] == second[0] ? 1u : 0u);
            ASSERT_EQ(t.hinges.size(), 1u);
            EXPECT_NEAR(dihedral(t, t.hinges[0]), 0, 1e-6);
        }
}

TEST(Topology, moebius_strip_has_one_turned_hinge) {
    TriangleMesh mesh;
    const std::uint32_t around = 24;
    for (std::uint32_t i = 0; i < around; ++i)
        for (const float side : {-0.3f, 0.3f}) {
            const float angle = 6.2831853f * static_cast<float>(i) / around;
            const float r = 1 + side * std::cos(angle / 2);
            mesh.positions.push_back({r * std::cos(angle), side * std::sin(angle / 2), r * std::sin(angle)});
        }
    for (std::uint32_t i = 0; i < around; ++i) {
        const std::uint32_t a = 2 * i, b = a + 1;
        const std::uint32_t c = i + 1 < around ? a + 2 : 1, d = i + 1 < around ? a + 3 : 0;
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({c, b, d});
    }
    const Topology t = built(mesh);
    expect_sound(t, mesh);
    EXPECT_EQ(euler_characteristic(t), 0);
    EXPECT_EQ(t.report.inconsistent_edges, 1u);
    EXPECT_EQ(t.hinges.size(), 2 * around);
    for (const Hinge& h : t.hinges) EXPECT_LT(std::abs(dihedral(t, h)), 0.6);
}

TEST(Topology, duplicates_in_any_winding_are_left_out) {
    const TriangleMesh mesh = drawn({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}},
                                    {{0, 1, 2}, {2, 1, 0}, {1, 3, 2}, {4, 2, 0}, {0, 4, 2}});
    const Topology t = built(mesh);
    expect_sound(t, mesh);
    EXPECT_EQ(t.report.duplicate_triangles, 3u);
    EXPECT_EQ(t.source_triangle, (std::vector<std::uint32_t>{0, 2}));
    EXPECT_EQ(t.hinges.size(), 1u);
    EXPECT_EQ(t.report.non_manifold_edges, 0u);
}

TEST(Topology, degenerate_triangles_and_isolated_vertices_are_left_out) {
    const TriangleMesh mesh = drawn({{0, 0, 0},
                                     {1, 0, 0},
                                     {0, 1, 0},
                                     {0.1f, 0.2f, 0.3f},
                                     {0.2f, 0.4f, 0.6f},
                                     {0.7f, 1.4f, 2.1f},
                                     {1, 0, 0},
                                     {5, 5, 5}},
                                    {{3, 4, 5}, {0, 1, 1}, {1, 6, 2}, {0, 1, 2}});
    const Topology t = built(mesh);
    expect_sound(t, mesh);
    EXPECT_EQ(t.report.degenerate_triangles, 3u);
    EXPECT_EQ(t.report.isolated_vertices, 4u);
    EXPECT_EQ(t.particle_count, 3u);
    EXPECT_EQ(t.source_triangle, (std::vector<std::uint32_t>{3}));
}

TEST(Topology, zero_area_does_not_depend_on_size_or_corner) {
    for (const float scale : {1e-30f, 1e-6f, 1.0f, 1e6f, 1e30f}) {
        const Vec3 a{0, 0, 0}, b{scale, 0, 0};
        const Vec3 thin{0.5f * scale, 1e-4f * scale, 0}, flat{0.5f * scale, 1e-7f * scale, 0};
        for (const bool turned : {false, true}) {
            const auto zero = [&](Vec3 c) { return turned ? has_zero_area(c, b, a) : has_zero_area(b, c, a); };
            EXPECT_FALSE(zero(thin)) << scale;
            EXPECT_TRUE(zero(flat)) << scale;
        }
    }
    EXPECT_TRUE(has_zero_area({1, 2, 3}, {1, 2, 3}, {1, 2, 3}));
}

TEST(Topology, coarse_weld_collapses_triangles_into_degenerate_ones) {
    const auto mesh = make_grid({1, 1}, {11, 11}, GridDiagonal::uniform);
    const Topology t = built(mesh, {.weld_distance = 0.11f});
    expect_sound(t, mesh);
    EXPECT_GT(t.report.welded_vertices, 40u);
    EXPECT_GT(t.report.degenerate_triangles, 0u);
    const auto nothing_left = build_topology(mesh, {.weld_distance = 1e30f});
    ASSERT_FALSE(nothing_left.ok());
    EXPECT_EQ(nothing_left.error().what, "must have at least one triangle with an area, got 200 without");
}

TEST(Topology, errors_name_the_first_culprit) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    const TriangleMesh good = octahedron();

    const auto empty = build_topology({});
    ASSERT_FALSE(empty.ok());
    EXPECT_EQ(empty.error().message(), "must have at least one triangle, got none");

    for (const float bad : {nan, infinity, -infinity}) {
        TriangleMesh mesh = good;
        mesh.positions[3].y = mesh.positions[5].x = bad;
        const auto result = build_topology(mesh);
        ASSERT_FALSE(result.ok());
        EXPECT_EQ(result.errors().size(), 1u);
        EXPECT_EQ(result.error().where, "vertex 3");
        EXPECT_EQ(result.error().what.find("position must be finite, got (0, "), 0u) << result.error().what;
    }

    TriangleMesh mesh = good;
    mesh.triangles[6][1] = 6, mesh.triangles[7][0] = none;
    const auto result = build_topology(mesh);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().where, "triangle 6");
    EXPECT_EQ(result.error().what, "indices must be < 6, the number of vertices, got 6");

    mesh.positions[0].z = nan;
    EXPECT_EQ(build_topology(mesh).errors().size(), 2u);

    for (const float bad : {-1.0f, nan})
        EXPECT_EQ(build_topology(good, {.weld_distance = bad}).error().where, "weld_distance");
}

/// Edges and hinges by comparing every triangle with every other.
TEST(Topology, soups_match_the_quadratic_reference) {
    std::mt19937 random(17);
    for (int round = 0; round < 60; ++round) {
        TriangleMesh mesh;
        const std::uint32_t vertex_count = 4 + random() % 30;
        std::uniform_real_distribution<float> in(-1, 1);
        for (std::uint32_t i = 0; i < vertex_count; ++i) mesh.positions.push_back({in(random), in(random), in(random)});
        for (std::uint32_t i = 0, n = 1 + random() % 80; i < n; ++i) {
            const auto any = [&] { return static_cast<std::uint32_t>(random() % vertex_count); };
            const std::uint32_t a = any(), b = any(), c = any();
            mesh.triangles.push_back({a, b, c});
        }
        const auto result = build_topology(mesh, {.reorder = round % 2 == 0});
        if (!result.ok()) continue;
        const Topology& t = *result;
        expect_sound(t, mesh);

        std::set<std::set<std::uint32_t>> seen;
        std::uint32_t degenerate = 0, duplicate = 0;
        std::vector<std::uint32_t> kept;
        for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
            const std::set<std::uint32_t> corners(mesh.triangles[i].begin(), mesh.triangles[i].end());
            if (corners.size() < 3)
                ++degenerate;
            else if (!seen.insert(corners).second)
                ++duplicate;
            else
                kept.push_back(i);
        }
        EXPECT_EQ(t.source_triangle, kept);
        EXPECT_EQ(t.report.degenerate_triangles, degenerate);
        EXPECT_EQ(t.report.duplicate_triangles, duplicate);

        std::uint32_t edge = 0, hinge = 0, crowded = 0, inconsistent = 0;
        for (std::uint32_t a = 0; a < t.particle_count; ++a)
            for (std::uint32_t b = a + 1; b < t.particle_count; ++b) {
                std::vector<std::uint32_t> at;  // triangles of the edge
                std::vector<int> way;
                for (std::uint32_t i = 0; i < t.triangles.size(); ++i)
                    for (int k = 0; k < 3; ++k) {
                        const std::uint32_t p = t.triangles[i][k], q = t.triangles[i][(k + 1) % 3];
                        if ((p == a && q == b) || (p == b && q == a)) at.push_back(i), way.push_back(p == a);
                    }
                if (at.empty()) continue;
                ASSERT_LT(edge, t.edges.size());
                EXPECT_EQ(t.edges[edge], (Edge{a, b, at[0], at.size() > 1 ? at[1] : none}));
                if (at.size() == 2) {
                    ASSERT_LT(hinge, t.hinges.size());
                    EXPECT_EQ(t.hinges[hinge++].edge, edge);
                    inconsistent += way[0] == way[1];
                }
                crowded += at.size() > 2;
                ++edge;
            }
        EXPECT_EQ(t.edges.size(), edge);
        EXPECT_EQ(t.hinges.size(), hinge);
        EXPECT_EQ(t.report.non_manifold_edges, crowded);
        EXPECT_EQ(t.report.inconsistent_edges, inconsistent);
    }
}

TEST(Topology, two_runs_are_equal) {
    const TriangleMesh mesh = sphere_soup(3);
    const Topology s = built(mesh), t = built(mesh);
    EXPECT_EQ(s.vertex_to_particle, t.vertex_to_particle);
    EXPECT_EQ(s.edges, t.edges);
    EXPECT_EQ(s.hinges, t.hinges);
}

TEST(Topology, hub_of_great_valence) {
    const std::uint32_t rim = 20000;
    const Topology t = built(fan(rim));
    EXPECT_EQ(euler_characteristic(t), 1);
    EXPECT_EQ(t.edges.size(), 2 * rim);
    EXPECT_EQ(t.hinges.size(), rim);
    EXPECT_EQ(t.particle_edges[t.welded_to_particle[0]].size(), rim);
}

}  // namespace
}  // namespace weft
