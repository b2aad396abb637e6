#include "editor/tools/vertex_selection.h"

#include "editor/tools/random_views.test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace weft::editor {
namespace {

/// The sum of the angles under which the pixel sees the sides, in turns.
double winding(std::span<const Vec2> polygon, Vec2 pixel) {
    double sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Double2 a = exact(polygon[i]) - exact(pixel), b = exact(polygon[(i + 1) % polygon.size()]) - exact(pixel);
        sum += std::atan2(a.x * b.y - a.y * b.x, dot(a, b));
    }
    return sum / (2 * 3.14159265358979);
}

/// Without a tree: all triangles one by one, by planes through the eye.
bool sees(Vec3 eye, Vec3 point, const TriangleMesh& mesh, float tolerance) {
    const Double3 o = exact(eye), way = exact(point) - o;
    const double reach = 1 - static_cast<double>(tolerance) / length(way);
    for (const auto& [a, b, c] : mesh.triangles) {
        const Double3 p = exact(mesh.positions[a]) - o, q = exact(mesh.positions[b]) - o,
                      r = exact(mesh.positions[c]) - o;
        const double u = dot(way, cross(q, r)), v = dot(way, cross(r, p)), w = dot(way, cross(p, q));
        if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) continue;
        const Double3 normal = cross(q - p, r - p);
        if (dot(normal, way) == 0) continue;
        const double t = dot(normal, p) / dot(normal, way);
        if (t > 0 && t < reach) return false;
    }
    return true;
}

std::vector<Vec2> random_lasso(Dice& dice, int corners) {
    std::vector<Vec2> polygon;
    for (int i = 0; i < corners; ++i) polygon.push_back(dice.pixel());
    return polygon;
}

TEST(Lasso, contains_what_it_winds_around) {
    Dice dice(30);
    int inside = 0;
    for (const int corners : {3, 4, 7, 50}) {
        for (int run = 0; run < 10; ++run) {
            const std::vector<Vec2> polygon = random_lasso(dice, corners);
            const Lasso lasso(polygon);
            for (int i = 0; i < 300; ++i) {
                const Vec2 pixel = dice.pixel();
                const bool expected = std::lround(winding(polygon, pixel)) != 0;
                EXPECT_EQ(lasso.contains(pixel), expected);
                inside += expected;
            }
        }
    }
    EXPECT_GT(inside, 1000);
}

TEST(Lasso, of_less_than_three_corners_contains_nothing) {
    const std::vector<Vec2> two{{0, 0}, {100, 100}}, flat{{0, 5}, {100, 5}, {50, 5}},
        bad{{nan_value, 0}, {0, 0}, {100, 100}};
    for (const auto& polygon : {std::vector<Vec2>{}, two, flat, bad}) {
        EXPECT_FALSE(Lasso(polygon).contains({50, 50}));
        EXPECT_FALSE(Lasso(polygon).contains({50, 5}));
    }
    const std::vector<Vec2> square{{0, 0}, {100, 0}, {nan_value, infinite}, {100, 100}, {0, 100}};
    EXPECT_TRUE(Lasso(square).contains({50, 50}));
    EXPECT_FALSE(Lasso(square).contains({nan_value, 50}));
    EXPECT_FALSE(Lasso(square).contains({150, 50}));
}

TEST(VertexSelection, lasso_and_box_find_what_a_search_of_all_vertices_finds) {
    Dice dice(31);
    std::size_t all = 0, visible = 0;
    for (unsigned run = 0; run < 12; ++run) {
        const TriangleMesh mesh = crumpled(18, run, 0.15f), other = crumpled(4, run + 100, 0.1f);
        const TriangleTree tree{MeshView(mesh)}, other_tree{MeshView(other)};
        const std::vector<PickSurface> surfaces{{.tree = &tree}, {.tree = &other_tree}};
        const HiddenBy hidden{{.cloths = surfaces}, 1e-3f};
        const Projection view(dice.camera(), usual_size);
        const std::vector<Vec2> polygon = random_lasso(dice, 6);
        const Vec2 a = dice.pixel(), b = dice.pixel();
        std::vector<std::uint32_t> in_lasso, in_box, seen_in_lasso, seen_in_box;
        for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
            const auto seen = view.project(mesh.positions[v]);
            if (!seen) continue;
            const Vec2 p = seen->pixel;
            const bool visible_vertex = sees(view.camera().position, mesh.positions[v], mesh, 1e-3f) &&
                                        sees(view.camera().position, mesh.positions[v], other, 1e-3f);
            if (std::lround(winding(polygon, p)) != 0) {
                in_lasso.push_back(v);
                if (visible_vertex) seen_in_lasso.push_back(v);
            }
            if (p.x >= std::min(a.x, b.x) && p.x <= std::max(a.x, b.x) && p.y >= std::min(a.y, b.y) &&
                p.y <= std::max(a.y, b.y)) {
                in_box.push_back(v);
                if (visible_vertex) seen_in_box.push_back(v);
            }
        }
        EXPECT_EQ(vertices_in_lasso(view, MeshView(mesh), polygon, nullptr), in_lasso);
        EXPECT_EQ(vertices_in_box(view, MeshView(mesh), a, b, nullptr), in_box);
        EXPECT_EQ(vertices_in_lasso(view, MeshView(mesh), polygon, &hidden), seen_in_lasso) << run;
        EXPECT_EQ(vertices_in_box(view, MeshView(mesh), a, b, &hidden), seen_in_box) << run;
        all += in_lasso.size() + in_box.size(), visible += seen_in_lasso.size() + seen_in_box.size();
    }
    EXPECT_GT(visible, 100u);
    EXPECT_LT(visible, all - 100);
}

TEST(VertexSelection, click_takes_the_nearest_visible_vertex) {
    TriangleMesh mesh = make_grid({1, 1}, {5, 5}, GridDiagonal::uniform);
    mesh.positions.push_back({0, 0.02f, 0});  // belongs to no triangle
    const TriangleTree tree{MeshView(mesh)};
    const std::vector<PickSurface> surfaces{{.tree = &tree}};
    const HiddenBy hidden{{.cloths = surfaces}};
    const Projection view(Camera{.position = {0, 2, 0.5f}, .target = {}, .fov = 40}, usual_size);
    const Vec2 middle = view.project({0, 0, 0})->pixel;
    EXPECT_EQ(vertex_at(view, MeshView(mesh), {middle.x + 5, middle.y}, 8, &hidden), 12u);
    EXPECT_FALSE(vertex_at(view, MeshView(mesh), {middle.x + 9, middle.y}, 8, &hidden));
    EXPECT_FALSE(vertex_at(view, MeshView(mesh), {nan_value, middle.y}, 8, &hidden));
    // A second sheet below: hidden, unless hidden ones are asked for.
    TriangleMesh below = mesh;
    for (Vec3& p : below.positions) p.y -= 0.2f;
    const Vec2 under = view.project(below.positions[12])->pixel;
    EXPECT_FALSE(vertex_at(view, MeshView(below), under, 8, &hidden));
    EXPECT_EQ(vertex_at(view, MeshView(below), under, 8, nullptr), 12u);
}

TEST(VertexSelection, malformed_vertices_are_left_out) {
    TriangleMesh mesh = make_grid({1, 1}, {5, 5}, GridDiagonal::uniform);
    mesh.positions[12].x = nan_value;
    mesh.triangles.push_back({0, 1, 99});
    const Projection view(Camera{.position = {0, 3, 0.1f}, .target = {}, .fov = 60}, usual_size);
    EXPECT_EQ(vertices_in_box(view, MeshView(mesh), {0, 0}, {1280, 720}, nullptr).size(), 24u);
    EXPECT_TRUE(vertices_in_box(view, MeshView(mesh), {nan_value, 0}, {1280, 720}, nullptr).empty());
    EXPECT_TRUE(vertices_in_box(view, MeshView(), {0, 0}, {1280, 720}, nullptr).empty());
}

}  // namespace
}  // namespace weft::editor
