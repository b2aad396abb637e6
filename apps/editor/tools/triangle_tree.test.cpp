#include "editor/tools/triangle_tree.h"

#include "editor/tools/random_views.test.h"

#include <gtest/gtest.h>

#include <optional>

namespace weft::editor {
namespace {

Ray random_ray(Dice& dice) {
    const Vec3 from = dice.point(1.5f);
    return {from, normalized(dice.point(0.5f) - from)};
}

/// All triangles one by one, with another method: Möller and Trumbore 1997, in doubles.
std::optional<SurfaceHit> brute_force(const TriangleMesh& mesh, const Ray& ray) {
    std::optional<SurfaceHit> best;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [a, b, c] = mesh.triangles[t];
        const Double3 p = exact(mesh.positions[a]), e1 = exact(mesh.positions[b]) - p,
                      e2 = exact(mesh.positions[c]) - p;
        const Double3 d = exact(ray.direction), h = cross(d, e2), s = exact(ray.origin) - p;
        const double det = dot(e1, h);
        if (det == 0) continue;
        const double v = dot(s, h) / det, w = dot(d, cross(s, e1)) / det, at = dot(e2, cross(s, e1)) / det;
        if (v < 0 || w < 0 || v + w > 1 || at < 0) continue;
        if (best && at >= static_cast<double>(best->distance)) continue;
        best = SurfaceHit{static_cast<float>(at), {}, t, {a, b, c}, rounded(Double3{1 - v - w, v, w}), det > 0};
    }
    return best;
}

void expect_same(const std::optional<SurfaceHit>& a, const std::optional<SurfaceHit>& b) {
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) return;
    EXPECT_EQ(a->triangle, b->triangle);
    EXPECT_EQ(a->corners, b->corners);
    EXPECT_EQ(a->distance, b->distance);
    EXPECT_EQ(a->weights, b->weights);
    EXPECT_EQ(a->front, b->front);
}

TEST(TriangleTree, finds_what_a_search_through_all_triangles_finds) {
    int hits = 0;
    for (const std::uint32_t side : {2u, 3u, 5u, 9u, 30u}) {
        const TriangleMesh mesh = crumpled(side, side, 0.2f);
        const TriangleTree tree{MeshView(mesh)};
        Dice dice(side);
        for (int i = 0; i < 400; ++i) {
            const Ray ray = random_ray(dice);
            const auto found = tree.nearest(ray), expected = brute_force(mesh, ray);
            ASSERT_EQ(found.has_value(), expected.has_value()) << side << ", " << i;
            if (!found) continue;
            ++hits;
            EXPECT_EQ(found->triangle, expected->triangle);
            EXPECT_NEAR(found->distance, expected->distance, 1e-5f);
            EXPECT_EQ(found->front, expected->front);
            expect_close(found->weights, expected->weights, 1e-5f);
            const auto [a, b, c] = mesh.triangles[found->triangle];
            expect_close(mesh.positions[a] * found->weights.x + mesh.positions[b] * found->weights.y +
                             mesh.positions[c] * found->weights.z,
                         found->point, 1e-5f);
        }
    }
    EXPECT_GT(hits, 300);
}

TEST(TriangleTree, a_refitted_tree_finds_the_same_as_a_new_one) {
    TriangleTree refitted{MeshView(crumpled(40, 1, 0.05f))};
    Dice dice(11);
    int hits = 0;
    for (unsigned frame = 2; frame < 12; ++frame) {
        const TriangleMesh mesh = crumpled(40, frame, 0.05f * static_cast<float>(frame));
        refitted.refit(MeshView(mesh));
        const TriangleTree built{MeshView(mesh)};
        EXPECT_EQ(refitted.bounds(), built.bounds());
        EXPECT_GE(refitted.looseness(), 0.5);
        for (int i = 0; i < 200; ++i) {
            const Ray ray = random_ray(dice);
            const auto found = refitted.nearest(ray);
            expect_same(found, built.nearest(ray));
            hits += found.has_value();
            if (!found) continue;
            EXPECT_TRUE(refitted.blocks(ray, 0, found->distance * 1.001f));
            EXPECT_FALSE(refitted.blocks(ray, 0, found->distance * 0.999f));
            const auto behind = refitted.nearest(ray, found->distance * 1.001f);
            EXPECT_TRUE(!behind || behind->distance > found->distance);
        }
    }
    EXPECT_GT(hits, 500);
}

TEST(TriangleTree, no_ray_passes_between_two_triangles) {
    const TriangleMesh mesh = crumpled(20, 3, 0.1f);
    const TriangleTree tree{MeshView(mesh)};
    Dice dice(12);
    const auto inner = [](Vec3 p) { return std::abs(p.x) < 0.42f && std::abs(p.z) < 0.42f; };
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 a = mesh.positions[t[k]], b = mesh.positions[t[(k + 1) % 3]];
            if (!inner(a) || !inner(b)) continue;
            const float part = dice.between(0, 1);
            for (const Vec3 p : {a, a + (b - a) * part}) {
                const Vec3 from = p + Vec3{dice.between(-0.2f, 0.2f), 2, dice.between(-0.2f, 0.2f)};
                EXPECT_TRUE(tree.nearest({from, normalized(p - from)}));
                EXPECT_TRUE(tree.nearest({{p.x, 2, p.z}, {0, -1, 0}})) << "parallel to an axis";
            }
        }
    }
}

TEST(TriangleTree, hits_have_weights_sides_and_the_lowest_number) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {2, 1, 0}, {0, 1, 2}};
    const TriangleTree tree{MeshView(mesh)};
    const auto front = tree.nearest({{0.25f, 0.5f, 1}, {0, 0, -1}});
    ASSERT_TRUE(front);
    EXPECT_EQ(front->triangle, 0u);
    EXPECT_TRUE(front->front);
    expect_close(front->weights, {0.25f, 0.25f, 0.5f}, 1e-6f);
    EXPECT_FLOAT_EQ(front->distance, 1);
    const auto back = tree.nearest({{0.25f, 0.5f, -3}, {0, 0, 1}});
    ASSERT_TRUE(back);
    EXPECT_FALSE(back->front);
    EXPECT_FALSE(tree.nearest({{0.75f, 0.5f, 1}, {0, 0, -1}}));
    EXPECT_FALSE(tree.nearest({{0.25f, 0.5f, 1}, {0, 0, 1}})) << "behind";
    EXPECT_FALSE(tree.nearest({{0.25f, 0.5f, 1}, {0, 0, -1}}, 0, 0.5f));
    EXPECT_FALSE(tree.nearest({{0.25f, 0.5f, 1}, {0, 0, -1}}, 1.5f));
}

TEST(TriangleTree, malformed_triangles_and_rays_meet_nothing) {
    TriangleMesh mesh = crumpled(12, 4, 0.05f);
    const TriangleMesh sound = mesh;
    const TriangleTree reference{MeshView(sound)};
    mesh.positions[30].y = nan_value;
    mesh.positions[31].x = infinite;
    mesh.triangles.push_back({0, 1, 4000000000u});
    mesh.triangles.push_back({0, 0, 0});
    TriangleTree tree{MeshView(mesh)};
    Dice dice(13);
    int hits = 0, lost = 0;
    for (int i = 0; i < 500; ++i) {
        const Ray ray = random_ray(dice);
        const auto found = tree.nearest(ray), whole = reference.nearest(ray);
        if (found) {
            EXPECT_LT(found->triangle, sound.triangles.size());
            for (const std::uint32_t v : mesh.triangles[found->triangle]) EXPECT_TRUE(finite(mesh.positions[v]));
        }
        hits += found.has_value(), lost += whole && !found;
    }
    EXPECT_GT(hits, 50);
    EXPECT_GT(lost, 0);
    mesh.positions = sound.positions;
    tree.refit(MeshView(mesh));
    for (int i = 0; i < 200; ++i) {
        const Ray ray = random_ray(dice);
        expect_same(tree.nearest(ray), reference.nearest(ray));
    }
    for (const Ray& ray : {Ray{{nan_value, 0, 0}, {0, 0, 1}}, Ray{{0, 3, 0}, {0, nan_value, 0}}, Ray{{0, 3, 0}, {}}}) {
        EXPECT_FALSE(reference.nearest(ray));
        EXPECT_FALSE(reference.blocks(ray, 0, 10));
    }
    const TriangleTree empty, without_vertices(MeshView(std::span<const Vec3>(), std::span(sound.triangles)));
    for (const TriangleTree* nothing : {&empty, &without_vertices}) {
        EXPECT_FALSE(nothing->nearest({{0, 3, 0}, {0, -1, 0}}));
        EXPECT_TRUE(nothing->bounds().empty());
    }
}

TEST(TriangleTree, triangles_in_one_place_cost_no_more_than_others) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles.assign(5000, {0, 1, 2});
    const TriangleTree tree{MeshView(mesh)};
    EXPECT_EQ(tree.nearest({{0.2f, 0.2f, 1}, {0, 0, -1}})->triangle, 0u);
    EXPECT_FALSE(tree.nearest({{2, 2, 1}, {0, 0, -1}}));
}

TEST(TriangleTree, reads_frames_of_cloths) {
    const TriangleMesh mesh = crumpled(10, 5, 0.1f);
    std::vector<Vec4> positions;
    for (const Vec3 p : mesh.positions) positions.push_back({p.x, p.y, p.z, 1});
    const std::size_t stride = mesh.triangles.size() + 5;
    std::vector<std::uint32_t> corners(3 * stride);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) corners[k * stride + t] = mesh.triangles[t][k];
    const TriangleView triangles(corners.data(), static_cast<std::uint32_t>(stride),
                                 static_cast<std::uint32_t>(mesh.triangles.size()));
    const TriangleTree from_mesh{MeshView(mesh)}, from_frame{MeshView(std::span<const Vec4>(positions), triangles)};
    Dice dice(14);
    for (int i = 0; i < 100; ++i) {
        const Ray ray = random_ray(dice);
        expect_same(from_frame.nearest(ray), from_mesh.nearest(ray));
    }
}

TEST(SurfaceTree, follows_positions_and_triangles) {
    const Ray down{{0.1f, 5, 0.1f}, {0, -1, 0}};
    TriangleMesh mesh = crumpled(8, 6, 0.0f);
    SurfaceTree surface;
    EXPECT_NEAR(surface.of(MeshView(mesh), 1, 1).nearest(down)->distance, 5, 1e-5f);
    for (Vec3& p : mesh.positions) p.y += 1;
    EXPECT_NEAR(surface.of(MeshView(mesh), 1, 1).nearest(down)->distance, 5, 1e-5f) << "the same frame";
    EXPECT_NEAR(surface.of(MeshView(mesh), 1, 2).nearest(down)->distance, 4, 1e-5f);
    std::erase_if(mesh.triangles, [&](const Triangle& t) { return std::abs(mesh.positions[t[0]].x) < 0.4f; });
    EXPECT_FALSE(surface.of(MeshView(mesh), 2, 2).nearest(down));
    for (Vec3& p : mesh.positions) p = {3 * p.z, p.x, p.y};
    EXPECT_LE(surface.of(MeshView(mesh), 2, 3).looseness(), 2);
}

}  // namespace
}  // namespace weft::editor
