#include "solver/model/cloth_model.h"

#include "mesh/procedural.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

namespace weft {
namespace {

// Shuffles the mesh, so that its particles are renumbered.
TriangleMesh shuffled(const TriangleMesh& mesh) {
    std::mt19937 random(7);
    std::vector<std::uint32_t> place(mesh.positions.size());
    std::iota(place.begin(), place.end(), 0u);
    std::ranges::shuffle(place, random);
    TriangleMesh result = mesh;
    for (std::size_t v = 0; v < place.size(); ++v) {
        result.positions[place[v]] = mesh.positions[v];
        result.uvs[place[v]] = mesh.uvs[v];
    }
    for (Triangle& triangle : result.triangles)
        for (std::uint32_t& v : triangle) v = place[v];
    std::ranges::shuffle(result.triangles, random);
    return result;
}

TriangleMesh colored_sheet() {
    TriangleMesh mesh = make_grid({1, 1}, {9, 11}, GridDiagonal::alternating);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        mesh.colors.push_back({static_cast<float>(v) / 200, 0.5f, 1, 1});
    return mesh;
}

std::shared_ptr<const ClothModel> model_of(const TriangleMesh& mesh, const Topology& topology,
                                           const Fabric& fabric = {}, const ClothLayout& layout = {}) {
    auto model =
        build_cloth_model({.name = "sheet", .mesh = mesh, .fabric = fabric, .pins = {}, .layout = layout}, topology);
    EXPECT_TRUE(model.ok());
    return *model;
}

std::shared_ptr<const ClothModel> model_of(const TriangleMesh& mesh) {
    auto topology = build_topology(mesh);
    EXPECT_TRUE(topology.ok());
    return model_of(mesh, *topology);
}

void expect_drawn_as(const TriangleMesh& drawn, const TriangleMesh& mesh) {
    EXPECT_EQ(drawn.positions, mesh.positions);
    EXPECT_EQ(drawn.triangles, mesh.triangles);
    EXPECT_EQ(drawn.uvs, mesh.uvs);
    EXPECT_EQ(drawn.colors, mesh.colors);
    EXPECT_TRUE(drawn.normals.empty());
}

TEST(ClothModel, draws_the_mesh_that_it_was_made_of) {
    const TriangleMesh mesh = colored_sheet();
    expect_drawn_as(model_of(mesh)->mesh(), mesh);
    const TriangleMesh other = shuffled(mesh);
    const auto model = model_of(other);
    EXPECT_FALSE(std::ranges::is_sorted(model->vertex_to_particle)) << "numbered anew";
    expect_drawn_as(model->mesh(), other);
}

TEST(ClothModel, draws_what_is_not_simulated_too) {
    TriangleMesh mesh = colored_sheet();
    mesh.positions.push_back({5, 5, 5});  // unused vertex
    mesh.uvs.push_back({});
    mesh.colors.push_back({});
    mesh.triangles.push_back({0, 1, 1});  // without area
    mesh.triangles.push_back(mesh.triangles[0]);
    expect_drawn_as(model_of(mesh)->mesh(), mesh);

    TriangleMesh seam = colored_sheet();  // duplicate vertex
    seam.positions.push_back(seam.positions[0]);
    seam.uvs.push_back({1, 1});
    seam.colors.push_back({});
    seam.triangles[0] = {static_cast<std::uint32_t>(seam.positions.size() - 1), seam.triangles[0][1],
                         seam.triangles[0][2]};
    expect_drawn_as(model_of(seam)->mesh(), seam);
}

TEST(ClothModel, draws_the_same_with_other_material) {
    const TriangleMesh mesh = shuffled(colored_sheet());
    const auto topology = build_topology(mesh);
    ASSERT_TRUE(topology.ok());
    const auto model = model_of(mesh, *topology);
    Fabric heavy;
    heavy.body.density = 1;
    const auto changed = change_cloth_model(*model, model->mesh(), *topology, {.fabric = heavy});
    ASSERT_TRUE(changed.ok());
    expect_drawn_as((*changed)->mesh(), mesh);
}

// Expects every edge once, with the right direction.
void expect_edges_of(const Topology& topology, const ClothModel& model) {
    std::multiset<EdgeEnds> expected[2], found[2];
    for (const Edge& edge : topology.edges) {
        const Vec3 along = topology.rest_positions[edge.b] - topology.rest_positions[edge.a];
        expected[std::abs(along.x) < 1e-6f || std::abs(along.z) < 1e-6f].insert({edge.a, edge.b});
    }
    for_each_edge(model, [&](const EdgeEnds& ends, bool axial) {
        found[axial].insert({std::min(ends[0], ends[1]), std::max(ends[0], ends[1])});
    });
    EXPECT_EQ(found[1], expected[1]);
    EXPECT_EQ(found[0], expected[0]);
    const EdgesByDirection edges = edges_by_direction(model);
    EXPECT_TRUE(std::ranges::equal(edges.axial, expected[1])) << "ascending";
    EXPECT_TRUE(std::ranges::equal(edges.others, expected[0])) << "ascending";
}

TEST(ClothModel, knows_every_edge_and_its_direction) {
    for (const TriangleMesh& mesh : {colored_sheet(), shuffled(colored_sheet())}) {
        const auto topology = build_topology(mesh);
        ASSERT_TRUE(topology.ok());
        for (const bool lines : {false, true})
            expect_edges_of(*topology, *model_of(mesh, *topology, {}, {.lines = lines, .hierarchy = false}));
    }
}

TEST(ClothModel, knows_edges_along_which_nothing_is_stiff) {
    const TriangleMesh mesh = colored_sheet();
    const auto topology = build_topology(mesh);
    ASSERT_TRUE(topology.ok());
    Fabric fabric;
    fabric.stretch.stretch[1] = 0;
    fabric.stretch.compression[1] = 0;
    fabric.stretch.shear = 0;
    const auto model = model_of(mesh, *topology, fabric);
    EXPECT_LT(model->table(ConstraintKind::stretch).rows, topology->edges.size());
    EXPECT_FALSE(model->edges->without_row.empty());
    expect_edges_of(*topology, *model);
}

}  // namespace
}  // namespace weft
