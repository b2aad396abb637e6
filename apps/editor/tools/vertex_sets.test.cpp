#include "editor/tools/vertex_sets.h"

#include "mesh/procedural.h"

#include <gmock/gmock.h>

#include <numeric>

namespace weft::editor {
namespace {

using testing::ElementsAre;

constexpr std::uint32_t side = 6;

/// Vertices of a block of a grid of 6 × 6, from (x, z) on.
VertexSet block(std::uint32_t x, std::uint32_t z, std::uint32_t size) {
    VertexSet set;
    for (std::uint32_t j = z; j < z + size; ++j)
        for (std::uint32_t i = x; i < x + size; ++i) set.push_back(j * side + i);
    return set;
}

TriangleMesh sheet() {
    return make_grid({1, 1}, {side, side}, GridDiagonal::cross);
}

TEST(VertexSets, are_joined_and_parted) {
    const VertexSet set = make_set({5, 1, 5, 3});
    EXPECT_THAT(set, ElementsAre(1, 3, 5));
    EXPECT_THAT(with(set, {2, 3}), ElementsAre(1, 2, 3, 5));
    EXPECT_THAT(without(set, {2, 3}), ElementsAre(1, 5));
    EXPECT_TRUE(holds(set, 3));
    EXPECT_FALSE(holds(set, 4));
}

// With crossed diagonals a vertex at a corner has neighbors at the middles of its cells and along the grid lines alone.
TEST(VertexSets, grow_and_shrink_by_a_ring) {
    const TriangleMesh mesh = sheet();
    const MeshView view(mesh);
    constexpr std::uint32_t middles = side * side;  // five per row
    EXPECT_EQ(grown(view, {0}), make_set({0, 1, side, middles}));
    EXPECT_TRUE(grown(view, {}).empty());
    VertexSet inner = block(1, 1, 4);
    for (std::uint32_t row = 1; row < 4; ++row)
        for (std::uint32_t i = 1; i < 4; ++i) inner.push_back(middles + row * 5 + i);
    VertexSet core = block(2, 2, 2);
    for (std::uint32_t row = 1; row < 4; ++row)
        for (std::uint32_t i = 1; i < 4; ++i) core.push_back(middles + row * 5 + i);
    EXPECT_EQ(shrunk(view, inner), core);
    // What is outside grows when a set shrinks.
    const VertexSet all = all_vertices(view);
    EXPECT_EQ(shrunk(view, inner), without(all, grown(view, without(all, inner))));
    EXPECT_EQ(with(shrunk(view, grown(view, inner)), inner), shrunk(view, grown(view, inner)));
}

TEST(VertexSets, have_a_boundary) {
    const TriangleMesh mesh = sheet();
    const MeshView view(mesh);
    const VertexSet all = all_vertices(view);
    EXPECT_EQ(all.size(), mesh.positions.size());
    VertexSet rim;
    for (std::uint32_t i = 0; i < side; ++i)
        for (const std::uint32_t v : {i, (side - 1) * side + i, i * side, i * side + side - 1}) rim.push_back(v);
    EXPECT_EQ(boundary_of(view, all), make_set(rim));
    EXPECT_EQ(shrunk(view, all), all) << "nothing is outside";
    EXPECT_THAT(boundary_of(view, {14}), ElementsAre(14));
}

TEST(VertexSets, leave_malformed_vertices_out) {
    TriangleMesh mesh = sheet();
    mesh.triangles.push_back({0, 1, 999});
    mesh.triangles.push_back({3, 3, 3});
    mesh.positions.push_back({});  // of no triangle
    const MeshView view(mesh);
    EXPECT_EQ(all_vertices(view).size(), mesh.positions.size() - 1);
    EXPECT_EQ(grown(view, {0, 5000}).size(), 4u);
    EXPECT_TRUE(all_vertices(MeshView()).empty());
}

}  // namespace
}  // namespace weft::editor
