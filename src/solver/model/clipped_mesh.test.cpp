#include "solver/model/clipped_mesh.h"

#include "base/transform.h"
#include "mesh/procedural.h"
#include "mesh/testing.h"
#include "mesh/weld.h"
#include "solver/model/binding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

namespace weft {
namespace {

double area_of_mesh(const TriangleMesh& mesh) {
    double area = 0;
    for (const auto& [a, b, c] : mesh.triangles)
        area += 0.5 * static_cast<double>(
                          length(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a])));
    return area;
}

/// m: of the edges that have no other triangle at them. Where vertices of one triangle lie within an edge of another,
/// these are edges without another triangle too.
double open_length(const TriangleMesh& mesh) {
    const Weld weld = weld_vertices(mesh.positions, 0);
    std::map<std::array<std::uint32_t, 2>, int> balance;
    for (const Triangle& triangle : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = weld.vertex_to_welded[triangle[k]],
                                b = weld.vertex_to_welded[triangle[(k + 1) % 3]];
            if (a < b) ++balance[{a, b}];
            if (a > b) --balance[{b, a}];
        }
    double sum = 0;
    for (const auto& [edge, count] : balance)
        sum += std::abs(count) * static_cast<double>(length(mesh.positions[weld.first_vertex[edge[0]]] -
                                                            mesh.positions[weld.first_vertex[edge[1]]]));
    return sum;
}

/// m: how far vertices lie outside the simulated triangle of their piece, seen along its normal; beyond the rim none
/// do.
float farthest_outside(const ClippedMesh& clipped, const Topology& topology) {
    std::map<std::array<std::uint32_t, 2>, int> rim;
    for (const Edge& edge : topology.edges) rim[{edge.a, edge.b}] = edge.triangle1 == none;
    float farthest = 0;
    for (std::size_t t = 0; t < clipped.mesh.triangles.size(); ++t) {
        const Triangle& s = topology.triangles[clipped.triangle_of[t]];
        const auto& at = topology.rest_positions;
        const Vec3 normal = normalized(cross(at[s[1]] - at[s[0]], at[s[2]] - at[s[0]]));
        for (const std::uint32_t v : clipped.mesh.triangles[t])
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = s[k], b = s[(k + 1) % 3];
                if (rim.at({std::min(a, b), std::max(a, b)})) continue;
                const Vec3 inward = cross(normal, normalized(at[b] - at[a]));
                farthest = std::max(farthest, -dot(inward, clipped.mesh.positions[v] - at[a]));
            }
    }
    return farthest;
}

struct Clip {
    Topology topology;
    TriangleMesh drawn;
    ClippedMesh clipped;

    Clip(const TriangleMesh& simulated, TriangleMesh mesh) : topology(*build_topology(simulated)), drawn(mesh) {
        drawn.normals = normals_to_draw(drawn);
        clipped = clip_to_triangles(drawn, topology);
    }
    /// Expects the same surface.
    void expect_same_shape() const {
        const TriangleMesh& mesh = clipped.mesh;
        ASSERT_EQ(clipped.triangle_of.size(), mesh.triangles.size());
        ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
        EXPECT_EQ(mesh.uvs.size(), drawn.uvs.empty() ? 0 : mesh.positions.size());
        EXPECT_EQ(mesh.colors.size(), drawn.colors.empty() ? 0 : mesh.positions.size());
        for (std::size_t v = 0; v < drawn.positions.size(); ++v) ASSERT_EQ(mesh.positions[v], drawn.positions[v]);
        for (const std::uint32_t t : clipped.triangle_of) ASSERT_LT(t, topology.triangles.size());
        for (const Vec3 normal : mesh.normals) EXPECT_NEAR(length(normal), 1, 1e-5f);
        const double area = area_of_mesh(drawn);
        EXPECT_NEAR(area_of_mesh(mesh), area, 1e-4 * area);
        const double open = open_length(drawn);
        EXPECT_NEAR(open_length(mesh), open, 1e-4 * (1 + open)) << "no vertex lies within an edge";
        std::vector<bool> used(mesh.positions.size());
        for (const Triangle& triangle : mesh.triangles)
            for (const std::uint32_t v : triangle) used[v] = true;
        for (std::size_t v = drawn.positions.size(); v < used.size(); ++v) EXPECT_TRUE(used[v]) << v;
    }
    /// UVs that are an affine function of the position in the plane y = 0 stay it.
    void expect_affine_uvs(float tolerance) const {
        for (std::size_t v = 0; v < clipped.mesh.uvs.size(); ++v) {
            const Vec3 p = clipped.mesh.positions[v];
            EXPECT_NEAR(clipped.mesh.uvs[v].x, 3 * p.x - 2 * p.z + 0.5f, tolerance);
            EXPECT_NEAR(clipped.mesh.uvs[v].y, p.x + p.z, tolerance);
        }
    }
};

TriangleMesh flat_grid(std::array<std::uint32_t, 2> resolution, GridDiagonal diagonal, float degrees = 0,
                       Vec3 place = {}, float size = 1) {
    TriangleMesh mesh = make_grid({size, size}, resolution, diagonal);
    const Mat3 turn = rotation_from_degrees({0, degrees, 0});
    for (Vec3& p : mesh.positions) p = turn * p + place;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const Vec3 p = mesh.positions[v];
        mesh.uvs[v] = {3 * p.x - 2 * p.z + 0.5f, p.x + p.z};
    }
    return mesh;
}

/// Moves the vertices of a grid within its plane, those at the rim along it.
TriangleMesh shaken(TriangleMesh mesh, float reach, unsigned seed) {
    std::mt19937 random(seed);
    const auto number = [&] { return reach * (static_cast<float>(random() % 2001) / 1000 - 1); };
    for (Vec3& p : mesh.positions) {
        if (std::abs(p.x) < 0.499f) p.x += number();
        if (std::abs(p.z) < 0.499f) p.z += number();
    }
    return mesh;
}

constexpr GridDiagonal diagonals[] = {GridDiagonal::uniform, GridDiagonal::alternating, GridDiagonal::cross};

TEST(ClippedMesh, of_flat_grids_lies_in_its_triangles) {
    for (const GridDiagonal diagonal : diagonals)
        for (const std::uint32_t fine : {2u, 4u, 9u, 33u, 50u})
            for (const float degrees : {0.0f, 17.0f, 45.0f}) {
                SCOPED_TRACE(testing::Message() << fine << " at " << degrees);
                const float size = degrees > 0 ? 0.7f : 1.0f;
                const Clip clip(make_grid({1, 1}, {9, 9}, GridDiagonal::alternating),
                                flat_grid({fine, fine}, diagonal, degrees, {}, size));
                clip.expect_same_shape();
                clip.expect_affine_uvs(2e-6f);
                EXPECT_EQ(clip.clipped.left_whole, 0u);
                EXPECT_LT(farthest_outside(clip.clipped, clip.topology), 2e-5f);
            }
}

TEST(ClippedMesh, changes_nothing_where_the_edges_are_those_of_the_simulated_mesh) {
    const TriangleMesh coarse = make_grid({1, 1}, {9, 9}, GridDiagonal::alternating);
    const Clip same(coarse, flat_grid({9, 9}, GridDiagonal::alternating));
    EXPECT_EQ(same.clipped.mesh.triangles, same.drawn.triangles);
    EXPECT_EQ(same.clipped.mesh.positions, same.drawn.positions);
    // Each simulated triangle has the same number of drawn ones.
    TriangleMesh ball = make_sphere(1, 1);
    for (Vec3& p : ball.positions) p = p * 0.999f;
    const Clip sphere(make_sphere(1, 1), ball);
    EXPECT_EQ(sphere.clipped.mesh.triangles, ball.triangles);
}

TEST(ClippedMesh, beyond_the_rim_belongs_to_the_triangle_at_the_rim) {
    const Clip clip(make_grid({1, 1}, {6, 6}, GridDiagonal::uniform),
                    flat_grid({31, 7}, GridDiagonal::alternating, 5, {0.05f, 0, -0.02f}, 1.3f));
    clip.expect_same_shape();
    clip.expect_affine_uvs(2e-6f);
    EXPECT_EQ(clip.clipped.left_whole, 0u);
    EXPECT_LT(farthest_outside(clip.clipped, clip.topology), 4e-5f);
}

TEST(ClippedMesh, of_irregular_flat_meshes_keeps_its_shape) {
    std::uint32_t left_whole = 0;
    for (unsigned seed = 0; seed < 12; ++seed) {
        const TriangleMesh coarse = shaken(make_grid({1, 1}, {9, 9}, diagonals[seed % 2]), 0.025f, seed);
        const Clip clip(coarse, shaken(flat_grid({5 + 3 * seed, 20}, diagonals[(seed + 1) % 3]), 0.01f, seed + 50));
        clip.expect_same_shape();
        EXPECT_LT(farthest_outside(clip.clipped, clip.topology), 2e-5f);
        left_whole += clip.clipped.left_whole;
    }
    EXPECT_EQ(left_whole, 0u);
}

// Seen along its normal, a piece may reach a little beyond its triangle where the surface is bent.
TEST(ClippedMesh, of_closed_spheres_lies_in_its_triangles) {
    for (const std::uint32_t coarse : {1u, 2u})
        for (const std::uint32_t fine : {0u, 2u, 3u, 4u})
            for (const float radius : {0.95f, 1.0f, 1.05f}) {
                SCOPED_TRACE(testing::Message() << coarse << ", " << fine << ", " << radius);
                TriangleMesh drawn = make_sphere(radius, fine);
                const Mat3 turn = rotation_from_degrees({20, 50, 70});
                for (Vec3& p : drawn.positions) p = turn * p;
                for (Vec3& n : drawn.normals) n = turn * n;
                const Clip clip(make_sphere(1, coarse), drawn);
                clip.expect_same_shape();
                EXPECT_EQ(clip.clipped.left_whole, 0u);
                EXPECT_LT(farthest_outside(clip.clipped, clip.topology), fine == 0 ? 0.25f : 0.07f);
                EXPECT_GT(clip.clipped.mesh.triangles.size(), drawn.triangles.size());
                // Each part of the sphere belongs to the triangle over which it lies.
                std::vector<double> area(clip.topology.triangles.size());
                for (std::size_t t = 0; t < clip.clipped.triangle_of.size(); ++t) {
                    const auto& [a, b, c] = clip.clipped.mesh.triangles[t];
                    const auto& at = clip.clipped.mesh.positions;
                    area[clip.clipped.triangle_of[t]] +=
                        0.5 * static_cast<double>(length(cross(at[b] - at[a], at[c] - at[a])));
                }
                const double mean = area_of_mesh(drawn) / static_cast<double>(area.size());
                for (const double one : area) EXPECT_NEAR(one, mean, (fine == 0 ? 0.75 : 0.35) * mean);
            }
}

TEST(ClippedMesh, shares_vertices_and_parts_them_only_at_seams) {
    const TriangleMesh coarse = make_grid({1, 1}, {7, 7}, GridDiagonal::uniform);
    const TriangleMesh whole = flat_grid({12, 12}, GridDiagonal::alternating, 0);
    const auto sides = [](Vec3 at) { return static_cast<int>(at.x > 0.01f); };
    const Clip plain(coarse, whole), seamed(coarse, testing_meshes::with_seams(whole, sides));
    EXPECT_EQ(weld_vertices(plain.clipped.mesh.positions, 0).first_vertex.size(), plain.clipped.mesh.positions.size());
    const Weld weld = weld_vertices(seamed.clipped.mesh.positions, 0);
    EXPECT_EQ(weld.first_vertex.size(), plain.clipped.mesh.positions.size());
    EXPECT_EQ(seamed.clipped.mesh.triangles.size(), plain.clipped.mesh.triangles.size());
    seamed.expect_same_shape();
    for (std::size_t v = 0; v < seamed.clipped.mesh.positions.size(); ++v) {
        const Vec2 uv = seamed.clipped.mesh.uvs[v];
        const Vec3 p = seamed.clipped.mesh.positions[v];
        const float side = seamed.clipped.mesh.colors[v].x;  // 0 or 1, so an edge across the seam would give others
        EXPECT_TRUE(side == 0 || side == 1);
        EXPECT_NEAR(uv.x - side, 3 * p.x - 2 * p.z + 0.5f, 2e-6f);
    }
}

// Nothing is lost, whatever the meshes are.
TEST(ClippedMesh, of_random_meshes_keeps_its_shape) {
    std::mt19937 random(11);
    const auto number = [&](float reach) { return reach * (static_cast<float>(random() % 20001) / 10000 - 1); };
    for (int round = 0; round < 30; ++round) {
        SCOPED_TRACE(round);
        TriangleMesh coarse = round % 2 ? make_sphere(0.5f, 2) : make_grid({1, 1}, {8, 8}, GridDiagonal::alternating);
        for (Vec3& p : coarse.positions) p += Vec3{number(0.03f), number(0.3f), number(0.03f)};
        TriangleMesh drawn = round % 3 ? make_sphere(0.6f, 2) : make_grid({1.5f, 1}, {9, 13}, GridDiagonal::cross);
        drawn.normals = {};
        for (Vec3& p : drawn.positions) p += Vec3{number(0.1f), number(0.5f), number(0.1f)};
        if (round % 5 == 0)
            for (Vec3& p : drawn.positions) p = p * 20.0f;
        const Clip clip(coarse, drawn);
        const double area = area_of_mesh(clip.drawn);
        EXPECT_NEAR(area_of_mesh(clip.clipped.mesh), area, 1e-4 * area);
        const double open = open_length(clip.drawn);
        EXPECT_NEAR(open_length(clip.clipped.mesh), open, 1e-3 * (area + open));
    }
}

TEST(ClippedMesh, takes_drawn_meshes_that_are_a_mess) {
    TriangleMesh mess{.positions = {{0, 0, 0}, {0.3f, 0, 0}, {0, 0, 0.3f}, {0, 0, 0}, {0.2f, 0.1f, 0}, {-3, 0, 9}},
                      .uvs = {},
                      .normals = {},
                      .colors = {},
                      .triangles = {{0, 2, 1}, {0, 0, 1}, {0, 2, 1}, {3, 4, 2}, {3, 1, 3}, {0, 1, 3}}};
    for (int i = 0; i < 3; ++i) mess.positions.push_back({0.1f * static_cast<float>(i) - 0.2f, 0.01f, 0.1f});
    mess.triangles.push_back({6, 7, 8});  // without area
    const Clip clip(make_grid({1, 1}, {9, 9}, GridDiagonal::alternating), mess);
    EXPECT_NEAR(area_of_mesh(clip.clipped.mesh), area_of_mesh(clip.drawn), 1e-5);
    for (const Vec3 p : clip.clipped.mesh.positions) EXPECT_TRUE(finite(p));
}

// A sheet folded onto itself: each layer keeps its own drawn triangles.
TEST(ClippedMesh, does_not_cut_through_the_layers_of_a_fold) {
    const auto folded = [](TriangleMesh mesh) {
        for (Vec3& p : mesh.positions)
            if (p.x > 0) p = {-p.x, 0.01f, p.z};
        return mesh;
    };
    const Clip clip(folded(make_grid({1, 1}, {9, 9}, GridDiagonal::alternating)),
                    folded(make_grid({1, 1}, {65, 65}, GridDiagonal::alternating)));
    clip.expect_same_shape();
    for (std::size_t t = 0; t < clip.clipped.triangle_of.size(); ++t) {
        const auto height = [](const auto& at, const Triangle& triangle) {
            return (at[triangle[0]].y + at[triangle[1]].y + at[triangle[2]].y) / 3;
        };
        const float drawn = height(clip.clipped.mesh.positions, clip.clipped.mesh.triangles[t]);
        const float simulated =
            height(clip.topology.rest_positions, clip.topology.triangles[clip.clipped.triangle_of[t]]);
        if (drawn == 0 || drawn == 0.01f) {
            EXPECT_NEAR(drawn, simulated, 0.0067f) << t;
        }
    }
}

}  // namespace
}  // namespace weft
