#include "solver/state/frame.h"

#include "mesh/procedural.h"
#include "solver/measures/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace weft {
namespace {

/// A cloth of `mesh` at rest, in a frame whose arrays belong to the test.
struct Held {
    explicit Held(const TriangleMesh& mesh) {
        auto built = build_cloth_model({.name = "it", .mesh = mesh}, build_topology(mesh, {.reorder = false}).value());
        EXPECT_TRUE(built.ok());
        model = *built;
        positions.assign(model->start.begin(), model->start.begin() + model->particle_count);
        normals.assign(model->particle_count, {0, 1, 0, 0});
        frame.model = model.get();
        frame.positions = positions;
        frame.normals = normals;
        frame.triangles = model->triangles();
    }

    std::shared_ptr<const ClothModel> model;
    std::vector<Vec4> positions, normals;
    ClothFrame frame;
};

TEST(ClothFrame, has_the_triangles_of_its_particles) {
    const TriangleMesh mesh = make_grid({1, 1}, {4, 3}, GridDiagonal::alternating);
    const Held cloth(mesh);
    EXPECT_EQ(cloth.frame.topology_version, first_topology_version);
    EXPECT_EQ(cloth.frame.triangles.size(), mesh.triangles.size());
    EXPECT_TRUE(std::ranges::equal(cloth.frame.triangles, mesh.triangles));
    EXPECT_EQ(cloth.frame.triangles[5], mesh.triangles[5]);
    EXPECT_TRUE(TriangleView().empty());
}

TEST(ClothFrame, makes_its_render_mesh_once_and_again_when_it_is_invalid) {
    const TriangleMesh mesh = make_grid({1, 1}, {4, 3}, GridDiagonal::alternating);
    Held cloth(mesh);
    const RenderMesh& drawn = cloth.frame.render_mesh();
    EXPECT_EQ(drawn.positions, mesh.positions);
    EXPECT_TRUE(std::ranges::equal(drawn.triangles, mesh.triangles));
    EXPECT_TRUE(std::ranges::equal(drawn.uvs, mesh.uvs));
    EXPECT_TRUE(std::ranges::equal(drawn.rest_positions, mesh.positions));
    EXPECT_TRUE(drawn.colors.empty());
    const std::vector<Vec4> level(cloth.frame.tangents().begin(), cloth.frame.tangents().end());
    ASSERT_EQ(level.size(), mesh.positions.size());
    EXPECT_EQ(level[0].xyz(), (Vec3{1, 0, 0}));

    for (Vec4& p : cloth.positions) p.y = p.x;  // a slope
    for (Vec4& n : cloth.normals) n = {-std::sqrt(0.5f), std::sqrt(0.5f), 0, 0};
    EXPECT_EQ(cloth.frame.render_mesh().positions, mesh.positions) << "of the frame as it was";
    cloth.frame.invalidate();
    EXPECT_EQ(cloth.frame.render_mesh().positions[3].y, mesh.positions[3].x);
    EXPECT_NEAR(cloth.frame.tangents()[0].y, std::sqrt(0.5f), 1e-6f);
}

TEST(ClothFrame, measures_see_the_triangles_of_the_frame_and_no_others) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0.2f, -1, 0.2f}, {0.3f, 1, 0.2f}, {0.2f, 1, 0.3f}};
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    const Held cloth(mesh);
    Frame frame;
    frame.cloths.push_back(cloth.frame);
    const Collider ball = make_collider({.shape = SphereDesc{0.1f}});
    EXPECT_EQ(count_intersections(frame).triangles, 1u);
    EXPECT_EQ(measure_penetration(frame, std::span(&ball, 1)).count, 1u);

    const std::vector<std::uint32_t> second = {3, 4, 5};  // only the second triangle
    frame.cloths[0].triangles = {second.data(), 1, 1};
    EXPECT_EQ(count_intersections(frame).triangles, 0u);
    EXPECT_EQ(measure_penetration(frame, std::span(&ball, 1)).count, 0u);
}

}  // namespace
}  // namespace weft
