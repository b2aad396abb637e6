#include "solver/model/pin_spans.h"

#include "mesh/procedural.h"
#include "solver/model/cloth_model.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft {
namespace {

std::shared_ptr<const ClothModel> rigid_model(TriangleMesh mesh, std::vector<std::uint32_t> pinned_vertices) {
    Topology topology = *build_topology(mesh);
    for (std::uint32_t& v : pinned_vertices) v = topology.vertex_to_particle[v];
    Fabric rigid;
    rigid.stretch.inextensible = true;
    return *build_cloth_model({.mesh = std::move(mesh),
                               .fabric = rigid,
                               .pins = {.particles = std::move(pinned_vertices)},
                               .layout = {.hierarchy = true}},
                              std::move(topology));
}

std::shared_ptr<const ClothModel> grid_with_pins(std::vector<std::uint32_t> vertices) {
    return rigid_model(make_grid({1, 1}, {33, 33}, GridDiagonal::alternating), std::move(vertices));
}

std::vector<Vec4> stretched(const ClothModel& model, Vec3 factor) {
    std::vector<Vec4> positions(model.start.begin(), model.start.end());
    for (Vec4& p : positions) p = {p.x * factor.x, p.y * factor.y, p.z * factor.z, p.w};
    return positions;
}

TEST(PinSpans, lead_from_pin_to_pin_along_the_cloth) {
    const auto model = grid_with_pins({0, 32, 32 * 33});
    ASSERT_EQ(model->pin_spans.size(), 3u);
    for (const PinSpan& span : model->pin_spans) {
        const double apart = length(model->start[span.a].xyz() - model->start[span.b].xyz());
        EXPECT_NEAR(span.length, apart, 1e-4);
    }
}

TEST(PinSpans, tell_how_far_pins_stretch_the_cloth) {
    std::vector<std::uint32_t> edges;
    for (std::uint32_t row = 0; row < 33; ++row) edges.insert(edges.end(), {33 * row, 33 * row + 32});
    const auto model = grid_with_pins(edges);
    EXPECT_LE(model->pin_spans.size(), 28u) << "eight pins at most";
    EXPECT_LT(strain_between(model->pin_spans, model->start), 1e-5);
    EXPECT_EQ(strain_between(model->pin_spans, stretched(*model, {0.9f, 1, 0.9f})), 0);
    const float strain = strain_between(model->pin_spans, stretched(*model, {1.03f, 1, 1}));
    EXPECT_NEAR(strain, 0.03, 1e-3);
}

// On a tube, the distance over the cloth is longer than the straight one.
TEST(PinSpans, follow_the_cloth_where_it_is_bent_at_rest) {
    constexpr std::uint32_t side = 33;
    TriangleMesh mesh = make_grid({1, 1}, {side, side}, GridDiagonal::alternating);
    for (Vec3& p : mesh.positions) {
        const float angle = 6 * p.x;
        p = {std::sin(angle) / 6, std::cos(angle) / 6, p.z};
    }
    const auto model = rigid_model(std::move(mesh), {16 * side, 16 * side + side - 1});
    ASSERT_EQ(model->pin_spans.size(), 1u);
    EXPECT_GT(model->pin_spans[0].length, 0.88f) << "1 m around, 5 cm across";
    EXPECT_LT(model->pin_spans[0].length, 1);
}

TEST(PinSpans, are_found_in_every_piece) {
    TriangleMesh mesh;
    std::vector<std::uint32_t> pins;
    for (int piece = 0; piece < 12; ++piece) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        const TriangleMesh one = make_grid({1, 1}, {9, 9}, GridDiagonal::uniform);
        for (const Vec3 p : one.positions) mesh.positions.push_back(p + Vec3{0, static_cast<float>(piece), 0});
        for (const auto [a, b, c] : one.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
        pins.insert(pins.end(), {first, first + 8});
    }
    const auto model = rigid_model(std::move(mesh), pins);
    ASSERT_EQ(model->pin_spans.size(), 12u);
    for (const PinSpan& span : model->pin_spans) EXPECT_NEAR(span.length, 1, 1e-5);
}

TEST(PinSpans, do_not_count_between_neighbors_nor_with_fewer_than_two_pins) {
    EXPECT_TRUE(grid_with_pins({0, 2})->pin_spans.empty());
    EXPECT_TRUE(grid_with_pins({5})->pin_spans.empty());
    EXPECT_TRUE(grid_with_pins({})->pin_spans.empty());
    EXPECT_TRUE(find_pin_spans({}, {}).empty());
    EXPECT_EQ(strain_between({}, {}), 0);
}

}  // namespace
}  // namespace weft
