#include "editor/tools/stroke_cut.h"

#include "base/disjoint_sets.h"
#include "editor/tools/random_views.test.h"
#include "solver/model/cuts.h"
#include "solver/model/tear_table.h"

#include <gtest/gtest.h>

#include <set>

namespace weft::editor {
namespace {

constexpr Camera from_above{.position = {0, 2, 0}, .target = {}, .fov = 40};

struct Cutting {
    TriangleMesh mesh;
    TriangleTree tree{MeshView(mesh)};
    SurfaceDistance distance{MeshView(mesh)};
    Projection view;

    explicit Cutting(TriangleMesh of, const Camera& camera = from_above)
        : mesh(std::move(of)), view(camera, usual_size) {}

    Vec2 pixel(Vec3 p) const { return view.project(p)->pixel; }
    std::vector<PathCut> cut(const std::vector<Vec2>& stroke, const PickScene& hiding = {}) {
        return cuts_of_stroke(view, stroke, {MeshView(mesh), &tree, &distance}, hiding);
    }
};

TEST(StrokeCut, a_straight_stroke_across_a_sheet_is_a_line_from_border_to_border) {
    Cutting sheet(make_grid({1, 1}, {21, 21}, GridDiagonal::alternating));
    const auto cuts = sheet.cut({sheet.pixel({-0.7f, 0, 0.12f}), sheet.pixel({0.8f, 0, 0.12f})});
    ASSERT_EQ(cuts.size(), 1u);
    ASSERT_EQ(cuts[0].points.size(), 2u) << "a straight line has two points";
    expect_close(cuts[0].points[0], {-0.5f, 0, 0.12f}, 1e-4f);
    expect_close(cuts[0].points[1], {0.5f, 0, 0.12f}, 1e-4f);
}

TEST(StrokeCut, parts_the_cloth) {
    TriangleMesh mesh = crumpled(21, 2, 0.03f);
    mesh.uvs.clear();
    ClothModelDesc desc{.name = "sheet", .layout = {}, .reserve = {.particles = 200, .openings = true, .tears = true}};
    auto topology = build_topology(mesh, {.reorder = false});
    ASSERT_TRUE(topology);
    desc.mesh = mesh;
    const auto model = build_cloth_model(std::move(desc), std::move(*topology));
    ASSERT_TRUE(model);
    Cutting sheet(mesh);
    const auto cuts = sheet.cut({{100, 300}, {500, 420}, {900, 300}, {1200, 380}});
    ASSERT_EQ(cuts.size(), 1u);
    EXPECT_GE(cuts[0].points.size(), 3u);
    const std::span<const Vec4> positions((*model)->start.data(), (*model)->particle_count);
    const auto openings = openings_along_stroke(**model, positions, cuts[0].points);
    // Triangles that closed edges connect: two pieces.
    const auto& entries = (*model)->tears->entries;
    const std::uint32_t stride = (*model)->face_stride;
    DisjointSets pieces((*model)->triangle_count);
    std::set<std::uint32_t> open;
    for (const Opening& opening : openings) open.insert(opening.links.begin(), opening.links.end());
    for (std::uint32_t i = 0; i < entries.size(); ++i) {
        if (entries[i].next == none || open.count(i) || open.count(entries[i].twin)) continue;
        pieces.merge(entries[i].corner % stride, entries[entries[i].next].corner % stride);
    }
    std::set<std::uint32_t> roots;
    for (std::uint32_t t = 0; t < (*model)->triangle_count; ++t) roots.insert(pieces.first_of(t));
    EXPECT_EQ(roots.size(), 2u);
    EXPECT_LT(farthest_from(cuts[0].points, **model, positions, openings), 0.06) << "near the stroke";
}

TEST(StrokeCut, follows_the_surface) {
    Cutting sheet(crumpled(31, 4, 0.1f));
    const auto cuts = sheet.cut({{300, 200}, {640, 360}, {700, 600}});
    ASSERT_GE(cuts.size(), 1u);
    for (const PathCut& cut : cuts) {
        ASSERT_GE(cut.points.size(), 2u);
        for (const Vec3 p : cut.points) {
            const auto ray = sheet.view.ray(sheet.pixel(p));
            const auto hit = sheet.tree.nearest(*ray);
            ASSERT_TRUE(hit);
            expect_close(hit->point, p, 1e-4f);
        }
    }
}

TEST(StrokeCut, a_stroke_that_leaves_the_cloth_becomes_several_cuts) {
    TriangleMesh mesh = make_grid({1, 1}, {21, 21}, GridDiagonal::alternating);
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        const Vec3 center = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) * (1.0f / 3);
        return std::abs(center.x) < 0.15f;
    });
    Cutting sheet(mesh);
    const auto cuts = sheet.cut({sheet.pixel({-0.4f, 0, 0.1f}), sheet.pixel({0.7f, 0, 0.1f})});
    ASSERT_EQ(cuts.size(), 2u);
    expect_close(cuts[0].points.front(), {-0.4f, 0, 0.1f}, 1e-4f);
    expect_close(cuts[0].points.back(), {-0.15f, 0, 0.1f}, 1e-4f);
    expect_close(cuts[1].points.front(), {0.15f, 0, 0.1f}, 1e-4f);
    expect_close(cuts[1].points.back(), {0.5f, 0, 0.1f}, 1e-4f);
}

// From fold to fold, where a line between two visible points leaves the cloth as it is now.
TEST(StrokeCut, stays_on_the_cloth_across_folds) {
    const TriangleMesh flat = make_grid({1, 1}, {41, 41}, GridDiagonal::alternating);
    ClothModelDesc desc{.name = "sheet", .layout = {}, .reserve = {.particles = 200, .openings = true, .tears = true}};
    auto topology = build_topology(flat, {.reorder = false});
    ASSERT_TRUE(topology);
    desc.mesh = flat;
    const auto model = build_cloth_model(std::move(desc), std::move(*topology));
    ASSERT_TRUE(model);
    const std::span<const Vec4> start((*model)->start.data(), (*model)->particle_count);
    TriangleMesh now = flat;
    for (Vec3& p : now.positions) p = {0.6f * p.x, 0.06f * std::sin(40 * p.x), p.z};
    for (const float slope : {-0.3f, 0.0f, 0.2f}) {
        Cutting sheet(now, {.position = {0.5f, 1.5f, 0.5f}, .target = {}, .fov = 40});
        const std::vector<Vec2> stroke{{100, 360 - 500 * slope}, {1200, 360 + 500 * slope}};
        const CutCloth cloth{MeshView(sheet.mesh), &sheet.tree, &sheet.distance, start};
        const auto cuts = cuts_of_stroke(sheet.view, stroke, cloth, {});
        ASSERT_FALSE(cuts.empty());
        for (const PathCut& cut : cuts) {
            const auto openings = openings_along_stroke_at_rest(**model, cut.points);
            EXPECT_LT(farthest_from(cut.points, **model, start, openings), 0.75 * double{(*model)->longest_edge});
        }
    }
}

TEST(StrokeCut, short_parts_are_left_out_beside_a_long_one) {
    TriangleMesh mesh = make_grid({1, 1}, {21, 21}, GridDiagonal::alternating);
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        const Vec3 center = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) * (1.0f / 3);
        return std::abs(center.x) < 0.15f;
    });
    Cutting sheet(mesh);
    const auto cuts = sheet.cut({sheet.pixel({-0.2f, 0, 0.1f}), sheet.pixel({0.7f, 0, 0.1f})});
    ASSERT_EQ(cuts.size(), 1u);
    expect_close(cuts[0].points.front(), {0.15f, 0, 0.1f}, 1e-4f);
    EXPECT_EQ(sheet.cut({sheet.pixel({-0.2f, 0, 0.1f}), sheet.pixel({-0.1f, 0, 0.1f})}).size(), 1u) << "alone";
}

// A straight stroke over a bulge is straight on the sheet as it starts too.
TEST(StrokeCut, can_lie_on_the_cloth_as_it_starts) {
    const TriangleMesh flat = make_grid({1, 1}, {21, 21}, GridDiagonal::alternating);
    TriangleMesh now = flat;
    for (Vec3& p : now.positions) p = {p.x + 0.2f, 0.3f - p.x * p.x, p.z};
    std::vector<Vec4> start;
    for (const Vec3& p : flat.positions) start.push_back({p.x, p.y, p.z, 1});
    Cutting sheet(now);
    const std::vector<Vec2> stroke{{100, 360}, {1200, 360}};
    const auto cuts =
        cuts_of_stroke(sheet.view, stroke, {MeshView(sheet.mesh), &sheet.tree, &sheet.distance, start}, {});
    ASSERT_EQ(cuts.size(), 1u);
    expect_close(cuts[0].points.front(), {-0.5f, 0, 0}, 1e-3f);
    expect_close(cuts[0].points.back(), {0.5f, 0, 0}, 1e-3f);
    for (const Vec3 p : cuts[0].points) EXPECT_NEAR(p.z, 0, 0.02f);
}

TEST(StrokeCut, what_something_hides_is_not_cut) {
    Cutting sheet(make_grid({1, 1}, {21, 21}, GridDiagonal::alternating));
    TriangleMesh box = make_box({0.2f, 0.2f, 0.2f}, {2, 2, 2});
    const TriangleTree tree{MeshView(box)};
    const std::vector<PickSurface> colliders{{.tree = &tree, .pose = {{}, {0, 0.3f, 0}}}};
    const auto cuts = sheet.cut({{100, 360}, {1200, 360}}, {.colliders = colliders});
    ASSERT_EQ(cuts.size(), 2u);
    // The box' upper face, 0.4 m above the sheet and 1.6 m below the eye.
    EXPECT_NEAR(cuts[0].points.back().x, -0.1f * 2 / 1.6f, 1e-3f);
    EXPECT_NEAR(cuts[1].points.front().x, 0.1f * 2 / 1.6f, 1e-3f);
}

TEST(StrokeCut, does_not_jump_between_the_layers_of_a_fold) {
    // The left half lies under the right one, and is longer.
    TriangleMesh mesh = make_grid({2, 1}, {81, 41}, GridDiagonal::uniform);
    for (Vec3& p : mesh.positions) p = p.x < -0.4f ? Vec3{-0.8f - p.x, -0.004f, p.z} : Vec3{p.x, 0, p.z};
    for (Vec3& p : mesh.positions)
        if (p.y == 0) p.x = -0.4f + (p.x + 0.4f) * 0.3f;
    Cutting sheet(mesh);  // above: from -0.4 to 0.02; below: from -0.4 to 0.2
    const auto cuts = sheet.cut({sheet.pixel({-0.3f, 0, 0}), sheet.pixel({0.15f, 0, 0})});
    ASSERT_EQ(cuts.size(), 2u);
    for (const Vec3 p : cuts[0].points) EXPECT_NEAR(p.y, 0, 1e-5f);
    for (const Vec3 p : cuts[1].points) EXPECT_NEAR(p.y, -0.004f, 1e-5f);
    EXPECT_NEAR(cuts[0].points.back().x, 0.02f, 1e-3f);
    EXPECT_NEAR(cuts[1].points.front().x, 0.02f, 1e-3f);
}

TEST(StrokeCut, degenerate_strokes_cut_nothing) {
    Cutting sheet(make_grid({1, 1}, {21, 21}, GridDiagonal::alternating));
    EXPECT_TRUE(sheet.cut({}).empty());
    EXPECT_TRUE(sheet.cut({{640, 360}}).empty());
    EXPECT_TRUE(sheet.cut({{640, 360}, {645, 360}}).empty()) << "shorter than half an edge";
    EXPECT_TRUE(sheet.cut({{1, 1}, {20, 20}}).empty());
    EXPECT_TRUE(sheet.cut({{nan_value, 1}, {infinite, 20}}).empty());
    EXPECT_EQ(sheet.cut({{500, 360}, {nan_value, 3}, {700, 360}}).size(), 1u);
    const Projection nothing(Camera{.position = {}, .target = {}, .fov = 40}, usual_size);
    EXPECT_TRUE(cuts_of_stroke(nothing, std::vector<Vec2>{{0, 0}, {900, 600}},
                               {MeshView(sheet.mesh), &sheet.tree, &sheet.distance}, {})
                    .empty());
    EXPECT_TRUE(cuts_of_stroke(sheet.view, std::vector<Vec2>{{0, 0}, {900, 600}}, {MeshView(sheet.mesh)}, {}).empty());
}

}  // namespace
}  // namespace weft::editor
