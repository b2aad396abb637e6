// The overlay of distance fields: the surface that contact uses, beside the mesh.

#include "shown.h"

#include "collide/distance_field.h"
#include "collide/solid_surface.h"

#include <cmath>

namespace weft::physical {
namespace {

std::shared_ptr<const ShapeData> field_data(const TriangleMesh& mesh, std::uint32_t cells) {
    auto field = build_distance_field(mesh.positions, mesh.triangles, {.cells = cells, .threads = 1});
    EXPECT_TRUE(field.ok());
    auto data = std::make_shared<ShapeData>(std::move(field->data));
    data->surface = mesh;
    return data;
}

Collider solid_mesh(std::shared_ptr<const ShapeData> data, const TransformDesc& at = {}) {
    return make_collider({.shape = SolidMeshDesc{}, .transform = at}, std::move(data));
}

TEST(DistanceFieldsOverlay, shows_the_error_of_the_surface_in_cells) {
    World world = make_world({});
    const ColliderId id = world.add(solid_mesh(field_data(make_sphere(0.2f, 5), 24), {.position = {0.3f, 1, 0}}));
    world.add(make_collider({.shape = SphereDesc{0.2f}}));
    Shown shown(world);
    const OverlayOutput output = shown.draw("distance_fields");
    ASSERT_EQ(output.colliders.size(), 1u) << "only the mesh has a field";
    EXPECT_EQ(output.colliders[0].collider, 0u);
    const FieldSurface& field = *output.colliders[0].field;
    EXPECT_FLOAT_EQ(field.cell, 0.4f / 24);
    ASSERT_EQ(field.errors.size(), field.mesh.positions.size());
    // The mesh is close to a ball of which the distance is known. Its faces lie 1/1600 of the radius inside it.
    double worst = 0;
    for (std::size_t v = 0; v < field.errors.size(); ++v) {
        const double expected = (double{length(field.mesh.positions[v])} - 0.2) / double{field.cell};
        worst = std::max(worst, std::abs(double{field.errors[v]} - expected));
    }
    EXPECT_LT(worst, 0.02);
    EXPECT_EQ(field.most, *std::ranges::max_element(field.errors));
    EXPECT_TRUE(field.beyond.empty());
    EXPECT_EQ(output.colliders[0].most, output.legends[0].bar->most);
    EXPECT_EQ(output.colliders[0].least, -output.colliders[0].most);
    EXPECT_EQ(entry(output, 1), "mesh beyond the field: none");
    EXPECT_EQ(entry(output, 2), "cell: 16.7 mm");
    world.remove(id);
    EXPECT_EQ(Shown(world).draw("distance_fields").legends[0].title, "distance fields: none");
}

// A field with values that are too large by half a cell: the surface shrinks by that.
TEST(DistanceFieldsOverlay, shows_a_field_that_is_wrong) {
    const auto good = field_data(make_sphere(0.2f, 4), 24);
    auto wrong = std::make_shared<ShapeData>(*good);
    // The grid is moved along x by half a cell.
    wrong->words[0] += 0.5f * 0.4f / 24;
    World world = make_world({});
    world.add(solid_mesh(wrong));
    Shown shown(world);
    const OverlayOutput output = shown.draw("distance_fields");
    const FieldSurface& field = *output.colliders.at(0).field;
    EXPECT_NEAR(field.most, 0.5, 0.1);
    EXPECT_NEAR(field.least, -0.5, 0.1);
    for (std::size_t v = 0; v < field.errors.size(); ++v) {
        const double along = double{field.mesh.positions[v].x} / 0.2;
        EXPECT_NEAR(field.errors[v], 0.5 * along, 0.1);
    }
    EXPECT_EQ(output.colliders[0].most, 0.5f);
    ASSERT_FALSE(field.beyond.empty());
    EXPECT_NEAR(field.farthest_beyond, 0.5, 0.1);
    // They are where the mesh is, on the side from which the field was moved away.
    ASSERT_EQ(output.lines.size(), field.beyond.size());
    for (const render::Line& line : output.lines) {
        EXPECT_NEAR(length(line.from), 0.2, 1e-3);
        EXPECT_LT(line.from.x, 0.02f);
    }
}

TEST(DistanceFieldsOverlay, shows_edges_that_the_field_lacks) {
    // A ball and a plate of a tenth of a cell, which no node of the grid is inside of.
    TriangleMesh mesh = make_sphere(0.2f, 3);
    const TriangleMesh plate = make_box({0.3f, 0.0017f, 0.3f}, {4, 2, 4});
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3 p : plate.positions) mesh.positions.push_back(p + Vec3{0.4f, 0.004f, 0});
    for (const auto& [a, b, c] : plate.triangles) mesh.triangles.push_back({a + first, b + first, c + first});
    mesh.normals.clear();
    const ThinParts thin =
        build_distance_field(mesh.positions, mesh.triangles, {.cells = 32, .threads = 1}).value().thin;
    EXPECT_GT(thin.thin, 0u);
    World world = make_world({});
    world.add(solid_mesh(field_data(mesh, 32)));
    const OverlayOutput output = Shown(world).draw("distance_fields");
    const FieldSurface& field = *output.colliders.at(0).field;
    ASSERT_FALSE(output.lines.empty());
    EXPECT_GT(field.farthest_beyond, FieldSurface::beyond_counts);
    for (const render::Line& line : output.lines) EXPECT_GT(line.from.x, 0.2f) << "on the plate";
    EXPECT_EQ(entry(output, 1).find("none"), std::string::npos);
}

TEST(DistanceFieldsOverlay, makes_a_surface_once_and_follows_poses) {
    World world = make_world({.solver = {.substeps = 1}});
    const auto data = field_data(make_box({0.2f, 0.3f, 0.4f}, {2, 2, 2}), 16);
    const ColliderId moved = world.add(solid_mesh(data));
    world.add(solid_mesh(data, {.position = {1, 0, 0}}));
    world.add(make_sheet({}));
    Shown shown(world);
    const OverlayOutput before = shown.draw("distance_fields");
    ASSERT_EQ(before.colliders.size(), 2u);
    EXPECT_EQ(before.colliders[0].field, before.colliders[1].field);
    EXPECT_EQ(shown.draw("distance_fields").colliders[0].field, before.colliders[0].field);
    world.move(moved, {{}, {0, 2, 0}});
    world.step(1.0 / 60);
    EXPECT_EQ(shown.draw("distance_fields").colliders[0].field, before.colliders[0].field) << "in its own frame";
    EXPECT_EQ(shown.kept_fields(), 1u);
    world.remove(world.collider_id(1));
    world.remove(moved);
    shown.draw("distance_fields");
    EXPECT_EQ(shown.kept_fields(), 0u);
}

}  // namespace
}  // namespace weft::physical
