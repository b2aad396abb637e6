#include "vulkan/topology/find_edges.h"

#include "mesh/procedural.h"
#include "mesh/testing.h"
#include "vulkan/primitives/device.test.h"

#include <algorithm>
#include <limits>
#include <random>
#include <tuple>

namespace weft::vulkan {
namespace {

using namespace testing_meshes;

class FindEdgesOnDevice : public DeviceTest {
  protected:
    EdgesAndHinges found(std::span<const Triangle> triangles, std::uint32_t vertices) {
        auto lists = build_edges_and_hinges(device(), programs(), triangles, vertices);
        EXPECT_TRUE(lists.ok()) << lists.error().message();
        return lists ? std::move(*lists) : EdgesAndHinges{};
    }

    /// The same lists as the CPU's, in the same order.
    void expect_same(std::span<const Triangle> triangles, std::uint32_t vertices, const std::string& what) {
        const EdgesAndHinges there = found(triangles, vertices);
        const EdgeList edges = build_edges(triangles, vertices);
        const HingeList hinges = build_hinges(edges, triangles);
        EXPECT_TRUE(there.edges.edges == edges.edges) << what;
        EXPECT_TRUE(there.edges.non_manifold == edges.non_manifold) << what;
        EXPECT_TRUE(there.hinges.hinges == hinges.hinges) << what;
        EXPECT_EQ(there.hinges.inconsistent, hinges.inconsistent) << what;
    }
    void expect_same(const TriangleMesh& mesh, const std::string& what) {
        expect_same(mesh.triangles, static_cast<std::uint32_t>(mesh.positions.size()), what);
    }

    Result<Topology> built(const TriangleMesh& mesh, const TopologyOptions& options) {
        return build_topology(mesh, options, [&](std::span<const Triangle> triangles, std::uint32_t particles) {
            return build_edges_and_hinges(device(), programs(), triangles, particles);
        });
    }
    /// Compares a whole topology from the device with that of the CPU.
    void expect_same_topology(const TriangleMesh& mesh, const TopologyOptions& options, const std::string& what) {
        const auto here = build_topology(mesh, options), there = built(mesh, options);
        ASSERT_TRUE(here.ok() && there.ok()) << what;
        EXPECT_EQ(there->particle_count, here->particle_count) << what;
        EXPECT_TRUE(there->triangles == here->triangles) << what;
        EXPECT_TRUE(there->edges == here->edges) << what;
        EXPECT_TRUE(there->hinges == here->hinges) << what;
        EXPECT_TRUE(there->particle_edges.items == here->particle_edges.items) << what;
        EXPECT_TRUE(there->boundary == here->boundary) << what;
        EXPECT_EQ(there->report.non_manifold_edges, here->report.non_manifold_edges) << what;
        EXPECT_EQ(there->report.inconsistent_edges, here->report.inconsistent_edges) << what;
    }
};

std::vector<std::pair<std::string, TriangleMesh>> meshes() {
    std::vector<std::pair<std::string, TriangleMesh>> all;
    for (const auto diagonal : {GridDiagonal::uniform, GridDiagonal::alternating, GridDiagonal::cross})
        for (const auto& [nx, nz] : {std::array{2u, 2u}, std::array{9u, 4u}, std::array{60u, 41u}})
            all.emplace_back("grid " + std::to_string(nx), make_grid({1, 1}, {nx, nz}, diagonal));
    for (const std::uint32_t cuts : {0u, 1u, 4u})
        all.emplace_back("sphere " + std::to_string(cuts), make_sphere(1, cuts));
    all.emplace_back("box", make_box({1, 2, 3}, {5, 9, 14}));
    all.emplace_back("fan", fan(3000));
    all.emplace_back("pieces", pieces(700));
    for (const std::uint32_t pages : {1u, 2u, 3u, 50u})
        all.emplace_back("book of " + std::to_string(pages), book(pages, 12));
    return all;
}

/// Random corners from few vertices: edges with many triangles, duplicate triangles, and, unless `sound`, sides of
/// length 0.
std::vector<Triangle> random_triangles(std::uint32_t count, std::uint32_t vertices, bool sound) {
    std::mt19937 random(count + vertices);
    std::vector<Triangle> triangles;
    while (triangles.size() < count) {
        Triangle t{};
        for (std::uint32_t& corner : t) corner = static_cast<std::uint32_t>(random() % vertices);
        if (!sound || (t[0] != t[1] && t[1] != t[2] && t[2] != t[0])) triangles.push_back(t);
    }
    return triangles;
}

TEST_F(FindEdgesOnDevice, gives_the_lists_of_the_cpu) {
    for (const auto& [name, mesh] : meshes()) expect_same(mesh, name);
}

TEST_F(FindEdgesOnDevice, whatever_the_order_of_vertices_and_triangles) {
    std::mt19937 random(1);
    for (auto& [name, mesh] : meshes()) {
        std::vector<std::uint32_t> number(mesh.positions.size());
        for (std::uint32_t i = 0; i < number.size(); ++i) number[i] = i;
        std::ranges::shuffle(number, random);
        std::ranges::shuffle(mesh.triangles, random);
        for (Triangle& t : mesh.triangles) {
            for (std::uint32_t& corner : t) corner = number[corner];
            if (random() % 4 == 0) std::swap(t[0], t[1]);  // winds the other way
        }
        expect_same(mesh, name + ", shuffled");
    }
}

TEST_F(FindEdgesOnDevice, of_nothing_and_of_one_triangle) {
    expect_same(std::vector<Triangle>{}, 0, "nothing");
    expect_same(std::vector<Triangle>{}, 7, "vertices alone");
    expect_same(std::vector<Triangle>{{2, 0, 1}}, 3, "one triangle");
    expect_same(std::vector<Triangle>{{0, 0, 0}}, 1, "one point");
    const std::uint32_t last = std::numeric_limits<std::uint32_t>::max() - 1;
    const EdgesAndHinges far = found(std::vector<Triangle>{{last, 5, last - 1}}, last + 1);
    const std::vector<Edge> edges = {{5, last - 1, 0, none}, {5, last, 0, none}, {last - 1, last, 0, none}};
    EXPECT_TRUE(far.edges.edges == edges);
}

// Triangles from which degenerate and duplicate ones were not removed.
TEST_F(FindEdgesOnDevice, of_any_triangles) {
    for (const std::uint32_t vertices : {3u, 4u, 12u, 100u, 5000u})
        for (const bool sound : {true, false}) {
            const auto triangles = random_triangles(4321, vertices, sound);
            expect_same(triangles, vertices, std::to_string(vertices) + " vertices");
        }
}

TEST_F(FindEdgesOnDevice, around_the_boundaries_of_tiles) {
    // Three sides each: 682 triangles are 2046 sides, 683 are 2049.
    for (const std::uint32_t count : {42u, 43u, 128u, 129u, 682u, 683u, 1365u, 1366u, 2048u, 2049u})
        expect_same(random_triangles(count, count / 2, true), count / 2, std::to_string(count) + " triangles");
}

TEST_F(FindEdgesOnDevice, an_edge_of_three_triangles_has_no_hinge) {
    const std::vector<Triangle> triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 2, 5}};
    const EdgesAndHinges lists = found(triangles, 6);
    EXPECT_EQ(lists.edges.non_manifold, std::vector{0u});
    EXPECT_EQ(lists.edges.edges.front(), (Edge{0, 1, 0, 1}));
    ASSERT_EQ(lists.hinges.hinges.size(), 1u);  // of (1, 2)
    EXPECT_EQ(lists.hinges.hinges.front().edge, 4u);
    expect_same(triangles, 6, "three triangles on an edge");
}

TEST_F(FindEdgesOnDevice, goes_on_along_y_where_x_is_full) {
    open(3);
    expect_same(make_grid({1, 1}, {40, 50}, GridDiagonal::alternating), "grid");
}

TEST_F(FindEdgesOnDevice, makes_the_same_topology) {
    for (const auto& [name, mesh] : meshes())
        for (const bool reorder : {false, true}) expect_same_topology(mesh, {.reorder = reorder}, name);
}

TEST_F(FindEdgesOnDevice, makes_the_same_topology_of_meshes_with_faults) {
    TriangleMesh mesh = make_grid({1, 1}, {12, 9}, GridDiagonal::cross);
    const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
    mesh.positions.push_back({9, 9, 9});                  // isolated
    add_triangle(mesh, {5, 0, 0}, {6, 0, 0}, {7, 0, 0});  // no area
    mesh.triangles.push_back({3, 3, 4});                  // no area either
    for (std::uint32_t i = 0; i < count; i += 5) {        // duplicates, flipped or not
        auto [a, b, c] = mesh.triangles[i];
        mesh.triangles.push_back(i % 2 ? Triangle{b, c, a} : Triangle{b, a, c});
    }
    add_triangle(mesh, mesh.positions[0], mesh.positions[1], {0, 1, 0});  // welded to an edge that has others
    add_triangle(mesh, mesh.positions[0], mesh.positions[1], {0, -1, 0});
    for (const bool reorder : {false, true}) expect_same_topology(mesh, {.reorder = reorder}, "faults");
}

TEST_F(FindEdgesOnDevice, refuses_the_same_meshes) {
    EXPECT_FALSE(built({}, {}).ok());
    TriangleMesh flat;
    add_triangle(flat, {0, 0, 0}, {1, 0, 0}, {2, 0, 0});
    EXPECT_FALSE(built(flat, {}).ok());
}

TEST_F(FindEdgesOnDevice, what_fails_is_passed_on) {
    const auto result = build_topology(make_sphere(1, 1), {}, [](auto, std::uint32_t) -> Result<EdgesAndHinges> {
        return Error::of_machine("device", "is lost");
    });
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().message(), "device: is lost");
}

TEST_F(FindEdgesOnDevice, says_how_long_it_took) {
    const TriangleMesh mesh = make_grid({1, 1}, {100, 100}, GridDiagonal::alternating);
    EdgeTimes times;
    ASSERT_TRUE(build_edges_and_hinges(device(), programs(), mesh.triangles, 10000, &times).ok());
    EXPECT_GT(times.wall_ms, 0);
    EXPECT_LE(times.device_ms, times.wall_ms);
    EXPECT_EQ(times.device_ms > 0, device().limits().timestamp_period > 0);
}

// Labels: slow no-asan
TEST_F(FindEdgesOnDevice, of_a_grid_of_half_a_million_triangles) {
    expect_same(make_grid({1, 1}, {513, 513}, GridDiagonal::alternating), "grid of 513 x 513");
}

}  // namespace
}  // namespace weft::vulkan
