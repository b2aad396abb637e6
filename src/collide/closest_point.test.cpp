#include "collide/closest_point.h"

#include "mesh/procedural.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace weft {
namespace {

class Random {
  public:
    explicit Random(unsigned seed) : engine_(seed) {}
    float number(float min, float max) {
        return min + (max - min) * static_cast<float>(engine_() % 1000003) / 1000003.0f;
    }
    Vec3 point(float reach) { return {number(-reach, reach), number(-reach, reach), number(-reach, reach)}; }

  private:
    std::mt19937 engine_;
};

double squared_distance_at(Vec3 p, Vec3 a, Vec3 b, Vec3 c, double wb, double wc) {
    const auto part = [&](float x, float y, float z, float from) {
        const double d = (1 - wb - wc) * double{x} + wb * double{y} + wc * double{z} - double{from};
        return d * d;
    };
    return part(a.x, b.x, c.x, p.x) + part(a.y, b.y, c.y, p.y) + part(a.z, b.z, c.z, p.z);
}

void expect_barycentric(const std::array<double, 3>& w) {
    for (const double weight : w) EXPECT_GE(weight, 0);
    EXPECT_NEAR(w[0] + w[1] + w[2], 1, 1e-12);
}

TEST(ClosestOnTriangle, knows_its_inside_its_sides_and_its_corners) {
    const Vec3 a{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0};
    const struct {
        Vec3 p;
        std::array<double, 3> weights;
        double squared_distance;
    } cases[] = {
        {{1, 1, 2}, {0.5, 0.25, 0.25}, 4}, {{1, 1, 0}, {0.5, 0.25, 0.25}, 0}, {{2, -3, 0}, {0.5, 0.5, 0}, 9},
        {{-1, 3, 1}, {0.25, 0, 0.75}, 2},  {{3, 3, 0}, {0, 0.5, 0.5}, 2},     {{-1, -1, 1}, {1, 0, 0}, 3},
        {{9, -1, 0}, {0, 1, 0}, 26},       {{-1, 6, 0}, {0, 0, 1}, 5},        {{4, 0, 0}, {0, 1, 0}, 0},
    };
    for (const auto& [p, weights, squared_distance] : cases) {
        const TrianglePoint point = closest_on_triangle(p, a, b, c);
        EXPECT_NEAR(point.squared_distance, squared_distance, 1e-12);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(point.weights[i], weights[i], 1e-12);
    }
}

TEST(ClosestOnTriangle, no_point_of_the_triangle_is_closer) {
    Random random(1);
    for (int i = 0; i < 300; ++i) {
        const Vec3 a = random.point(1), b = random.point(1), c = random.point(1), p = random.point(2);
        const TrianglePoint point = closest_on_triangle(p, a, b, c);
        expect_barycentric(point.weights);
        EXPECT_NEAR(point.squared_distance, squared_distance_at(p, a, b, c, point.weights[1], point.weights[2]), 1e-12);
        constexpr int steps = 40;
        for (int v = 0; v <= steps; ++v)
            for (int u = 0; u + v <= steps; ++u) {
                const double there = squared_distance_at(p, a, b, c, double(u) / steps, double(v) / steps);
                ASSERT_GE(there, point.squared_distance - 1e-12);
            }
    }
}

TEST(ClosestOnTriangle, survives_triangles_without_an_area) {
    const Vec3 o{1, 2, 3};
    const Vec3 along{2, 0, 0};
    const TrianglePoint of_point = closest_on_triangle({1, 2, 5}, o, o, o);
    expect_barycentric(of_point.weights);
    EXPECT_EQ(of_point.squared_distance, 4);
    // Three points on a line in every order, and two of them the same: the segment from o to o + 2·along.
    const Vec3 middle = o + along, end = o + along * 2;
    const Vec3 orders[][3] = {{o, middle, end}, {middle, o, end}, {end, middle, o}, {o, o, end}, {end, o, end}};
    for (const auto& [a, b, c] : orders) {
        for (const float x : {-1.0f, 0.5f, 2.0f, 3.7f, 9.0f}) {
            const TrianglePoint point = closest_on_triangle(o + Vec3{x, 0, 2}, a, b, c);
            expect_barycentric(point.weights);
            const double beyond = x < 0 ? -x : x > 4 ? x - 4 : 0;
            EXPECT_NEAR(point.squared_distance, 4 + beyond * beyond, 1e-5);
        }
    }
}

TEST(ClosestOnTriangle, is_sharp_on_slivers) {
    Random random(2);
    for (int i = 0; i < 200; ++i) {
        const Vec3 a = random.point(1), b = random.point(1);
        const float t = random.number(0, 1);
        const Vec3 c = a + (b - a) * t + random.point(1e-7f);
        const Vec3 p = random.point(2);
        const TrianglePoint point = closest_on_triangle(p, a, b, c), side = closest_on_triangle(p, a, b, b);
        expect_barycentric(point.weights);
        EXPECT_NEAR(std::sqrt(point.squared_distance), std::sqrt(side.squared_distance), 3e-7);
    }
}

TEST(SurfaceSearch, agrees_with_brute_force) {
    Random random(3);
    TriangleMesh soup;
    for (std::uint32_t i = 0; i < 500; ++i) {
        const Vec3 center = random.point(1);
        const float size = i % 50 == 0 ? 1.5f : 0.1f;
        for (int k = 0; k < 3; ++k) soup.positions.push_back(i % 9 == 0 ? center : center + random.point(size));
        soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    for (const TriangleMesh& mesh :
         {soup, make_sphere(0.7f, 3), make_grid({1, 1}, {9, 9}, GridDiagonal::alternating)}) {
        const SurfaceSearch search(mesh.positions, mesh.triangles);
        for (int i = 0; i < 500; ++i) {
            // Far away, near, and right on vertices, where many triangles are equally close.
            const Vec3 p = i % 3 == 0   ? random.point(30)
                           : i % 3 == 1 ? random.point(1.2f)
                                        : mesh.positions[static_cast<std::size_t>(i) * 7 % mesh.positions.size()];
            std::uint32_t triangle = none;
            TrianglePoint expected{.weights = {}, .squared_distance = 1e30};
            for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
                const auto [a, b, c] = mesh.triangles[t];
                const auto point = closest_on_triangle(p, mesh.positions[a], mesh.positions[b], mesh.positions[c]);
                if (point.squared_distance < expected.squared_distance) expected = point, triangle = t;
            }
            const SurfacePoint found = search.closest(p);
            EXPECT_EQ(found.triangle, triangle);
            EXPECT_EQ(found.weights, expected.weights);
            EXPECT_EQ(found.distance, std::sqrt(expected.squared_distance));
        }
    }
}

TEST(SurfaceSearch, finds_nothing_on_nothing) {
    const SurfaceSearch search({}, {});
    EXPECT_EQ(search.closest({1, 2, 3}).triangle, none);
}

}  // namespace
}  // namespace weft
