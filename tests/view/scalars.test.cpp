// Overlays that color the cloth, on shapes with known strain and curvature.

#include "shown.h"

#include <cmath>

namespace weft::physical {
namespace {

void expect_all(const std::vector<float>& values, float expected, float tolerance) {
    ASSERT_FALSE(values.empty());
    for (std::size_t v = 0; v < values.size(); ++v) ASSERT_NEAR(values[v], expected, tolerance) << "vertex " << v;
}

TEST(StrainOverlay, of_a_sheet_stretched_by_two_per_cent_is_two_per_cent) {
    World world = make_world({}, SheetDesc{});
    Shown shown(world);
    shown.place([](Vec3 p) { return p * 1.02f; });
    const OverlayOutput output = shown.draw("strain");
    ASSERT_EQ(output.scalars.size(), 1u);
    EXPECT_EQ(output.scalars[0].values.size(), 81u);
    expect_all(output.scalars[0].values, 2, 1e-3f);
    shown.place([](Vec3 p) { return p * 0.993f; });
    expect_all(shown.draw("strain").scalars[0].values, -0.7f, 1e-3f);
}

TEST(StrainOverlay, of_a_pull_along_the_warp_is_the_mean_over_the_rows) {
    SheetDesc desc{.diagonal = GridDiagonal::uniform};
    World world = make_world({}, desc);
    Shown shown(world);
    shown.place([](Vec3 p) { return Vec3{p.x * 1.04f, p.y, p.z}; });
    // Two edges along the warp, two across it, two diagonals: √((1.04² + 1)/2) - 1.
    const double diagonal = std::sqrt((1.04 * 1.04 + 1) / 2) - 1;
    EXPECT_NEAR(shown.draw("strain").scalars[0].values[4 * 9 + 4], 100 * (0.04 + diagonal) / 3, 1e-3);
}

TEST(StrainOverlay, has_a_round_and_symmetrical_scale) {
    World world = make_world({}, SheetDesc{});
    Shown shown(world);
    const auto most_at = [&](float stretched) {
        shown.place([&](Vec3 p) { return p * stretched; });
        const OverlayOutput output = shown.draw("strain");
        EXPECT_EQ(output.scalars[0].least, -output.scalars[0].most);
        EXPECT_EQ(output.scalars[0].scale, render::ColorScale::balance);
        EXPECT_EQ(output.legends[0].bar->most, output.scalars[0].most);
        EXPECT_EQ(output.legends[0].bar->least, output.scalars[0].least);
        return output.scalars[0].most;
    };
    EXPECT_EQ(most_at(1), 0.5f);
    EXPECT_EQ(most_at(1.0001f), 0.5f);
    EXPECT_EQ(most_at(0.993f), 1);
    EXPECT_EQ(most_at(1.012f), 2);
    EXPECT_EQ(most_at(1.03f), 5);
    EXPECT_EQ(most_at(1.6f), 100);
}

TEST(StrainOverlay, goes_to_the_vertices_of_another_mesh_that_is_drawn) {
    World world = make_world({});
    world.add(make_bound_sheet({5, 5}, make_grid({0.9f, 0.9f}, {13, 11}, GridDiagonal::cross)));
    Shown shown(world);
    shown.place([](Vec3 p) { return p * 1.02f; });
    const OverlayOutput output = shown.draw("strain");
    EXPECT_EQ(output.scalars[0].values.size(), shown.positions().size());
    expect_all(output.scalars[0].values, 2, 1e-3f);
    // One side is stretched, the other is not; values in between are interpolated.
    shown.place([](Vec3 p) { return Vec3{p.x > 0 ? p.x * 1.1f : p.x, p.y, p.z}; });
    const std::vector<float> values = shown.draw("strain").scalars[0].values;
    EXPECT_LT(values[5 * 13], 0.01f);
    EXPECT_GT(values[5 * 13 + 12], 3);
    EXPECT_GT(values[5 * 13 + 7], values[5 * 13 + 5]);
}

// A sheet rolled around an axis in its plane, at an angle to the warp.
Vec3 rolled(Vec3 p, float radius, float degrees) {
    const float angle = degrees * 3.14159265f / 180;
    const Vec3 along{std::cos(angle), 0, std::sin(angle)}, axis{-along.z, 0, along.x};
    const float s = dot(p, along);
    return axis * dot(p, axis) + along * (radius * std::sin(s / radius)) +
           Vec3{0, radius * (1 - std::cos(s / radius)), 0};
}

TEST(BendingOverlay, of_a_rolled_sheet_is_one_over_its_radius) {
    for (const BendModel model : {BendModel::dihedral, BendModel::plate}) {
        for (const GridDiagonal diagonal : {GridDiagonal::uniform, GridDiagonal::alternating}) {
            SheetDesc desc{.resolution = {41, 41}, .diagonal = diagonal};
            desc.fabric.bend.model = model;
            World world = make_world({}, desc);
            Shown shown(world);
            for (const float degrees : {0.0f, 90.0f}) {
                shown.place([&](Vec3 p) { return rolled(p, 0.25f, degrees); });
                const std::vector<float> values = shown.draw("bending").scalars[0].values;
                for (std::uint32_t z = 1; z < 40; ++z)
                    for (std::uint32_t x = 1; x < 40; ++x)
                        ASSERT_NEAR(values[z * 41 + x], 4, 0.01) << x << ' ' << z << ' ' << degrees;
            }
        }
    }
}

TEST(BendingOverlay, is_the_same_along_the_bias) {
    World world = make_world({}, SheetDesc{.resolution = {41, 41}, .diagonal = GridDiagonal::uniform});
    Shown shown(world);
    for (const float degrees : {45.0f, 20.0f, -45.0f}) {
        shown.place([&](Vec3 p) { return rolled(p, 0.25f, degrees); });
        const std::vector<float> values = shown.draw("bending").scalars[0].values;
        for (std::uint32_t z = 2; z < 39; ++z)
            for (std::uint32_t x = 2; x < 39; ++x) ASSERT_NEAR(values[z * 41 + x], 4, 0.05) << degrees;
    }
}

TEST(BendingOverlay, of_one_crease_is_its_angle_over_the_width_of_its_triangles) {
    World world = make_world({}, SheetDesc{.resolution = {9, 9}, .diagonal = GridDiagonal::uniform});
    Shown shown(world);
    const float angle = 30 * 3.14159265f / 180;
    shown.place([&](Vec3 p) { return p.x <= 0 ? p : Vec3{p.x * std::cos(angle), p.x * std::sin(angle), p.z}; });
    const std::vector<float> values = shown.draw("bending").scalars[0].values;
    // On the crease, four triangles of six have it for a side: angle / (1/8 m). Next to it, one of three in a column.
    EXPECT_NEAR(values[4 * 9 + 4], angle / 0.125f * 4 / 6, 1e-3);
    EXPECT_NEAR(values[4 * 9 + 3], angle / 0.125f * 1 / 6, 1e-3);
    EXPECT_NEAR(values[4 * 9 + 2], 0, 1e-4);
}

TEST(BendingOverlay, counts_from_the_angles_at_rest) {
    SheetDesc desc{.resolution = {21, 21}};
    World flat = make_world({}, desc);
    expect_all(Shown(flat).draw("bending").scalars[0].values, 0, 1e-4f);

    // A sphere at rest is not bent, whatever its curvature.
    TriangleMesh sphere = make_sphere(0.1f, 3);
    auto topology = build_topology(sphere);
    auto model = build_cloth_model({.name = "ball", .mesh = sphere}, std::move(*topology));
    World round = make_world({});
    round.add(*model);
    Shown shown(round);
    expect_all(shown.draw("bending").scalars[0].values, 0, 1e-3f);
    // Scaling keeps the angles, so there is no bending either.
    shown.place([](Vec3 p) { return p * 2; });
    expect_all(shown.draw("bending").scalars[0].values, 0, 1e-3f);

    // `rest_angle` of a fabric replaces the angles of the mesh: 3° for every hinge.
    desc.fabric.bend.rest_angle = 3;
    World curled = make_world({}, desc);
    const std::vector<float> values = Shown(curled).draw("bending").scalars[0].values;
    EXPECT_GT(values[10 * 21 + 10], 0.5f);
}

TEST(BendingOverlay, does_not_mind_how_triangles_wind) {
    TriangleMesh mesh = make_grid({1, 1}, {11, 11}, GridDiagonal::uniform);
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    auto topology = build_topology(mesh, {.reorder = false});
    auto model = build_cloth_model({.name = "sheet", .mesh = mesh}, std::move(*topology));
    World world = make_world({});
    world.add(*model);
    Shown shown(world);
    shown.place([](Vec3 p) { return rolled(p, 0.5f, 45); });
    const std::vector<float> values = shown.draw("bending").scalars[0].values;
    for (std::uint32_t z = 2; z < 9; ++z)
        for (std::uint32_t x = 2; x < 9; ++x) ASSERT_NEAR(values[z * 11 + x], 2, 0.05);
}

TEST(TensionOverlay, is_the_tension_over_the_strength) {
    SheetDesc desc;
    desc.fabric.stretch = {.stretch = {400, 400}, .compression = {400, 400}, .shear = 0};
    desc.fabric.tear = {.strength = {100, 100}, .tear_energy = 0, .tear_ratio = 0};
    World world = make_world({}, desc);
    Shown shown(world);
    shown.place([](Vec3 p) { return Vec3{p.x * 1.02f, p.y, p.z}; });
    const OverlayOutput output = shown.draw("tension");
    ASSERT_EQ(output.scalars.size(), 1u);
    expect_all(output.scalars[0].values, 0.08f, 1e-3f);
    EXPECT_EQ(output.scalars[0].least, 0);
    EXPECT_EQ(output.scalars[0].most, 0.1f);
    EXPECT_EQ(output.scalars[0].scale, render::ColorScale::amount);
    EXPECT_EQ(output.legends[0].title, "tension / strength");
    shown.place([](Vec3 p) { return p * 0.9f; });
    expect_all(shown.draw("tension").scalars[0].values, 0, 1e-6f);
    EXPECT_EQ(shown.draw("tension").scalars[0].most, 0.01f);
}

TEST(TensionOverlay, is_in_newtons_per_meter_without_a_strength) {
    SheetDesc desc;
    desc.fabric.stretch = {.stretch = {400, 400}, .compression = {400, 400}, .shear = 0};
    desc.fabric.tear = {.strength = {0, 0}, .tear_energy = 0, .tear_ratio = 0};
    World world = make_world({}, desc);
    Shown alone(world);
    alone.place([](Vec3 p) { return Vec3{p.x * 1.02f, p.y, p.z}; });
    const OverlayOutput output = alone.draw("tension");
    expect_all(output.scalars[0].values, 8, 0.01f);
    EXPECT_EQ(output.scalars[0].most, 10);
    EXPECT_EQ(output.legends[0].title, "tension, N/m");
    // Beside a cloth with a strength, each has its own scale.
    desc.fabric.tear.strength[0] = desc.fabric.tear.strength[1] = 1000;
    world.add(make_sheet(desc));
    Shown both(world);
    both.place([](Vec3 p) { return Vec3{p.x * 1.02f, p.y, p.z}; });
    const OverlayOutput two = both.draw("tension");
    ASSERT_EQ(two.scalars.size(), 2u);
    ASSERT_EQ(two.legends.size(), 2u);
    EXPECT_EQ(two.scalars[0].most, 10);
    EXPECT_NEAR(two.scalars[1].values[0], 0.008, 1e-4);
    EXPECT_EQ(two.scalars[1].most, 0.01f);
}

TEST(ScalarOverlays, the_last_one_wins_and_the_legend_is_its_own) {
    World world = make_world({}, SheetDesc{});
    Shown shown(world);
    shown.place([](Vec3 p) { return p * 1.02f; });
    const OverlayOutput output = shown.draw({"bending", "pins", "strain", "wind"});
    ASSERT_EQ(output.scalars.size(), 1u);
    EXPECT_NEAR(output.scalars[0].values[40], 2, 1e-3);
    std::vector<std::string> titles;
    for (const Legend& legend : output.legends) titles.push_back(legend.title);
    EXPECT_EQ(titles, (std::vector<std::string>{"pins", "strain, %", "wind: none"}));
}

}  // namespace
}  // namespace weft::physical
