#include "editor/tools/brush.h"

#include "editor/tools/random_views.test.h"
#include "editor/tools/stroke_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace weft::editor {
namespace {

/// The triangle of a flat mesh in the xz plane that contains a point.
MeshPlace place_at(const TriangleMesh& mesh, float x, float z) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [a, b, c] = mesh.triangles[t];
        const Vec3 p = mesh.positions[a], q = mesh.positions[b], r = mesh.positions[c];
        const auto area = [](Vec3 i, Vec3 j, Vec3 k) { return (j.x - i.x) * (k.z - i.z) - (j.z - i.z) * (k.x - i.x); };
        const Vec3 at{x, 0, z};
        const float whole = area(p, q, r), u = area(at, q, r) / whole, v = area(p, at, r) / whole;
        if (u >= -1e-5f && v >= -1e-5f && u + v <= 1 + 1e-5f) return {t, {u, v, 1 - u - v}};
    }
    ADD_FAILURE();
    return {};
}

TEST(SurfaceDistance, is_the_straight_distance_on_a_flat_sheet) {
    constexpr float edge = 1.0f / 40;
    for (const GridDiagonal diagonal : {GridDiagonal::uniform, GridDiagonal::alternating, GridDiagonal::cross}) {
        const TriangleMesh mesh = make_grid({1, 1}, {41, 41}, diagonal);
        SurfaceDistance distance{MeshView(mesh)};
        Dice dice(70);
        for (int i = 0; i < 20; ++i) {
            const float x = dice.between(-0.45f, 0.45f), z = dice.between(-0.45f, 0.45f);
            const auto reached = distance.from(MeshView(mesh), place_at(mesh, x, z), 0.3f);
            std::vector<std::uint8_t> found(mesh.positions.size());
            for (std::size_t k = 0; k < reached.size(); ++k) {
                const Vec3 p = mesh.positions[reached[k].vertex];
                const float straight = length(p - Vec3{x, 0, z});
                EXPECT_GE(reached[k].distance, straight - 1e-5f);
                EXPECT_LE(reached[k].distance, straight + 0.2f * edge);
                if (k > 0) {
                    EXPECT_GE(reached[k].distance, reached[k - 1].distance);
                }
                EXPECT_LE(reached[k].distance, 0.3f);
                found[reached[k].vertex] = 1;
            }
            for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
                if (length(mesh.positions[v] - Vec3{x, 0, z}) < 0.3f - 0.2f * edge) {
                    EXPECT_TRUE(found[v]);
                }
        }
    }
}

TEST(SurfaceDistance, runs_around_a_fold) {
    // Two layers 1 mm apart, connected at x = 0.
    TriangleMesh mesh = make_grid({1, 0.5f}, {41, 21}, GridDiagonal::uniform);
    for (Vec3& p : mesh.positions)
        if (p.x < 0) p = {-p.x, -0.001f, p.z};
    SurfaceDistance distance{MeshView(mesh)};
    const std::uint32_t vertices = 41;
    // On the upper layer, 0.2 m from the fold.
    const std::uint32_t row = 10 * vertices, upper = row + 28, lower = row + 12;
    expect_close(mesh.positions[upper], {0.2f, 0, 0}, 1e-5f);
    expect_close(mesh.positions[lower], {0.2f, -0.001f, 0}, 1e-5f);
    std::uint32_t triangle = 0;
    Vec3 weights;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        if (mesh.triangles[t][0] == upper) triangle = t, weights = {1, 0, 0};
    std::map<std::uint32_t, float> at;
    for (const auto& [v, d] : distance.from(MeshView(mesh), {triangle, weights}, 0.5f)) at[v] = d;
    ASSERT_TRUE(at.count(lower));
    EXPECT_NEAR(at[lower], 0.4f, 0.005f);
    at.clear();
    for (const auto& [v, d] : distance.from(MeshView(mesh), {triangle, weights}, 0.15f)) {
        at[v] = d;
        EXPECT_GE(v % vertices, 20u) << "the other side of the fold is farther away";
    }
    EXPECT_GT(at.size(), 100u);
}

TEST(SurfaceDistance, ends_at_holes_and_malformed_triangles) {
    TriangleMesh mesh = make_grid({1, 1}, {11, 11}, GridDiagonal::uniform);
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        const Vec3 center = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) * (1.0f / 3);
        return std::abs(center.x) < 0.09f;
    });
    mesh.positions[5 * 11 + 9].y = nan_value;
    mesh.triangles.push_back({0, 1, 77777});
    SurfaceDistance distance{MeshView(mesh)};
    const auto reached = distance.from(MeshView(mesh), place_at(mesh, 0.22f, 0.03f), 5);
    EXPECT_GT(reached.size(), 40u);
    for (const ReachedVertex& r : reached) {
        EXPECT_GE(mesh.positions[r.vertex].x, -0.001f);
        EXPECT_NE(r.vertex, 5u * 11 + 9);
    }
    EXPECT_TRUE(distance.from(MeshView(mesh), {99999, {1, 0, 0}}, 5).empty());
    EXPECT_TRUE(distance.from(MeshView(mesh), {0, {nan_value, 0, 0}}, 5).empty());
    EXPECT_TRUE(distance.from(MeshView(mesh), {0, {1, 0, 0}}, nan_value).empty());
    EXPECT_TRUE(distance.from(MeshView(), {0, {1, 0, 0}}, 5).empty()) << "another mesh";
    EXPECT_EQ(distance.from(MeshView(mesh), place_at(mesh, 0.22f, 0.03f), 5).size(), reached.size());
}

TEST(Brush, falls_off_smoothly) {
    EXPECT_EQ(brush_fall_off(0, 0.1f), 1);
    EXPECT_EQ(brush_fall_off(0.1f, 0.1f), 0);
    EXPECT_EQ(brush_fall_off(3, 0.1f), 0);
    EXPECT_EQ(brush_fall_off(0.1f, 0), 0);
    EXPECT_EQ(brush_fall_off(nan_value, 0.1f), 0);
    EXPECT_NEAR(brush_fall_off(0.05f, 0.1f), 0.5625f, 1e-6f);
    for (float d = 0; d < 0.1f; d += 0.001f) EXPECT_GT(brush_fall_off(d, 0.1f), brush_fall_off(d + 0.001f, 0.1f));
    EXPECT_NEAR(brush_fall_off(0.0001f, 0.1f), 1, 1e-5f);
    EXPECT_NEAR(brush_fall_off(0.0999f, 0.1f), 0, 1e-5f);
}

struct Painted {
    TriangleMesh mesh = make_grid({1, 1}, {21, 21}, GridDiagonal::alternating);
    SurfaceDistance distance{MeshView(mesh)};
    std::uint32_t center = 10 * 21 + 10;

    std::vector<BrushWeight> under(float x, float z, float radius = 0.2f) {
        return brush_weights(distance, MeshView(mesh), place_at(mesh, x, z), radius);
    }
};

TEST(Brush, adds_subtracts_and_sets_with_strength_and_limits) {
    Painted sheet;
    const std::vector<float> start(21 * 21, 0.5f);
    const auto after = [&](BrushMode mode, float strength, float value) {
        BrushStroke stroke({.mode = mode, .strength = strength, .value = value}, start);
        stroke.dab(sheet.under(0, 0), sheet.distance);
        for (const std::uint32_t v : stroke.changed()) EXPECT_LT(length(sheet.mesh.positions[v]), 0.2f);
        return stroke.values();
    };
    const std::uint32_t beside = sheet.center + 2;  // 0.1 m
    EXPECT_NEAR(after(BrushMode::add, 0.5f, 0.4f)[sheet.center], 0.7f, 1e-6f);
    EXPECT_NEAR(after(BrushMode::add, 0.5f, 0.4f)[beside], 0.5f + 0.2f * 0.5625f, 1e-5f);
    EXPECT_NEAR(after(BrushMode::subtract, 1, 0.3f)[sheet.center], 0.2f, 1e-6f);
    EXPECT_NEAR(after(BrushMode::set, 1, 0.9f)[sheet.center], 0.9f, 1e-6f);
    EXPECT_NEAR(after(BrushMode::set, 1, 0.9f)[beside], 0.5f + 0.4f * 0.5625f, 1e-5f);
    EXPECT_EQ(after(BrushMode::add, 1, 5)[sheet.center], 1);
    EXPECT_EQ(after(BrushMode::subtract, 1, 5)[sheet.center], 0);
    EXPECT_EQ(after(BrushMode::add, 1, 1)[0], 0.5f);
}

TEST(Brush, smoothing_keeps_a_constant_and_brings_a_peak_down) {
    Painted sheet;
    const BrushSettings smooth{.mode = BrushMode::smooth};
    BrushStroke flat(smooth, std::vector<float>(21 * 21, 0.3f));
    for (int i = 0; i < 5; ++i) flat.dab(sheet.under(0, 0), sheet.distance);
    for (const float value : flat.values()) EXPECT_NEAR(value, 0.3f, 1e-6f);
    std::vector<float> peak(21 * 21, 0);
    peak[sheet.center] = 1;
    BrushStroke stroke(smooth, peak);
    stroke.dab(sheet.under(0, 0), sheet.distance);
    EXPECT_NEAR(stroke.values()[sheet.center], 0, 1e-6f);
    EXPECT_GT(stroke.values()[sheet.center + 1], 0.05f);
    EXPECT_EQ(stroke.values()[sheet.center + 8], 0) << "outside the brush";
}

TEST(Brush, the_same_place_twice_in_a_stroke_counts_once) {
    Painted sheet;
    BrushStroke once({.strength = 0.5f}, std::vector<float>(21 * 21)), often = once;
    once.dab(sheet.under(0, 0), sheet.distance);
    for (int i = 0; i < 30; ++i) often.dab(sheet.under(0, 0), sheet.distance);
    EXPECT_EQ(once.values(), often.values());
}

TEST(Brush, paints_the_mirror_image_across_the_rest_shape) {
    // At rest a sheet in the plane of its frame, now crumpled.
    const TriangleMesh rest = make_grid({1, 1}, {21, 21}, GridDiagonal::uniform);
    const TriangleMesh now = crumpled(21, 3, 0.1f);
    const RestMirror mirror(rest.positions, rest.triangles);
    SurfaceDistance distance{MeshView(rest)};
    const MeshPlace place = place_at(rest, 0.3f, 0.1f);
    const auto other = mirror.of(place, 0.01f);
    ASSERT_TRUE(other);
    expect_close(point_of(MeshView(rest), *other), {-0.3f, 0, 0.1f}, 1e-5f);
    const auto weights = brush_weights(distance, MeshView(rest), place, 0.15f, other);
    std::map<std::uint32_t, float> at;
    for (const auto& [v, w] : weights) at[v] = w;
    EXPECT_EQ(at.size(), weights.size()) << "each vertex once";
    for (const auto& [v, w] : at) {
        const std::uint32_t image = v / 21 * 21 + (20 - v % 21);
        ASSERT_TRUE(at.count(image));
        EXPECT_NEAR(at[image], w, 0.02f);
    }
    EXPECT_GT(brush_weights(distance, MeshView(now.positions, rest.triangles), place, 0.15f, other).size(), 10u);
    // On the plane itself both are one.
    const MeshPlace middle = place_at(rest, 0, 0);
    EXPECT_EQ(brush_weights(distance, MeshView(rest), middle, 0.15f, mirror.of(middle, 0.01f)).size(),
              brush_weights(distance, MeshView(rest), middle, 0.15f).size());
}

TEST(Brush, is_mirrored_across_the_middle_of_any_axis) {
    TriangleMesh rest = make_grid({1, 1}, {21, 21}, GridDiagonal::uniform);
    const MeshPlace place = place_at(rest, 0.3f, 0.1f);
    for (Vec3& p : rest.positions) p = p + Vec3{7, 0, -4};
    const auto image = [&](MirrorAxis axis) {
        const auto other = RestMirror(rest.positions, rest.triangles, axis).of(place, 0.01f);
        EXPECT_TRUE(other);
        return other ? point_of(MeshView(rest), *other) : Vec3{};
    };
    expect_close(image(MirrorAxis::x), {6.7f, 0, -3.9f}, 1e-5f);
    expect_close(image(MirrorAxis::y), {7.3f, 0, -3.9f}, 1e-5f);
    expect_close(image(MirrorAxis::z), {7.3f, 0, -4.1f}, 1e-5f);
}

TEST(Brush, falls_off_as_asked) {
    for (const BrushFallOff kind : {BrushFallOff::smooth, BrushFallOff::linear, BrushFallOff::none}) {
        EXPECT_EQ(brush_fall_off(0, 2, kind), 1);
        EXPECT_EQ(brush_fall_off(2, 2, kind), 0);
        EXPECT_EQ(brush_fall_off(1, 0, kind), 0);
    }
    EXPECT_EQ(brush_fall_off(0.5f, 2, BrushFallOff::linear), 0.75f);
    EXPECT_EQ(brush_fall_off(1.9f, 2, BrushFallOff::none), 1);
}

TEST(Brush, what_has_no_mirror_image_is_not_mirrored) {
    // A sheet of which one corner is missing.
    TriangleMesh part = make_grid({1, 1}, {11, 11}, GridDiagonal::uniform);
    const MeshPlace opposite = place_at(part, 0.42f, 0.42f);
    for (Triangle& t : part.triangles) {
        const Vec3 p = part.positions[t[0]];
        if (p.x < 0.05f && p.z > 0.05f) t = {0, 0, 999};
    }
    part.positions[13].x = nan_value;
    const RestMirror mirror(part.positions, part.triangles);
    EXPECT_FALSE(mirror.of(opposite, 0.1f));
    EXPECT_TRUE(mirror.of(opposite, 10));
    EXPECT_FALSE(mirror.of({999999, {1, 0, 0}}, 10));
    EXPECT_FALSE(RestMirror({}, {}).of({0, {1, 0, 0}}, 10));
}

TEST(StrokeSampler, has_no_gaps_and_does_not_depend_on_how_often_the_pointer_is_read) {
    const auto sampled = [](const std::vector<Vec2>& pointers) {
        StrokeSampler sampler(5);
        std::vector<Vec2> points;
        for (const Vec2 p : pointers)
            for (const Vec2 point : sampler.add(p)) points.push_back(point);
        return points;
    };
    const auto fast = sampled({{0, 0}, {300, 400}});
    ASSERT_EQ(fast.size(), 101u);
    for (std::size_t i = 1; i < fast.size(); ++i) EXPECT_NEAR(length(exact(fast[i]) - exact(fast[i - 1])), 5, 1e-3);
    std::vector<Vec2> slow;
    for (int i = 0; i <= 1000; ++i) slow.push_back({0.3f * static_cast<float>(i), 0.4f * static_cast<float>(i)});
    const auto same = sampled(slow);
    ASSERT_GE(same.size(), 100u);
    for (std::size_t i = 0; i < 100; ++i) EXPECT_LT(length(exact(same[i]) - exact(fast[i])), 0.02);
    Dice dice(71);
    std::vector<Vec2> wild;
    for (int i = 0; i < 50; ++i) wild.push_back(i % 7 == 3 ? Vec2{nan_value, 0} : dice.pixel());
    const auto points = sampled(wild);
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_TRUE(finite(points[i]));
        if (i > 0) {
            EXPECT_LE(length(exact(points[i]) - exact(points[i - 1])), 5.01);
        }
    }
}

}  // namespace
}  // namespace weft::editor
