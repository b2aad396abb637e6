// distance_convex (physics/contact/convex.kernel.h) on hulls.
#include "collide/closest_point.h"
#include "collide/convex_hull.h"
#include "mesh/procedural.h"
#include "physics/testing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft {
namespace {

using testing_kernels::expect_gradient;
using testing_kernels::norm;

struct TestHull {
    const char* name;
    ConvexHull hull;
    ShapeData data;
    double size = 0;  // largest extent

    TestHull(const char* called, const std::vector<Vec3>& points) : name(called) {
        Result<ConvexHull> made = convex_hull(points);
        EXPECT_TRUE(made.ok()) << called;
        hull = *made;
        data = make_convex_data(hull);
        const Vec3 s = data.bounds.size();
        size = double{std::max({s.x, s.y, s.z})};
    }
    double distance(reference::vec3 p, reference::vec3& n, double radius = 0) const {
        return reference::distance_convex(p, {radius, 0, 0, 0, data.blocks()}, n);
    }
    // The least distance to a triangle; negative inside.
    double brute_force(Vec3 p) const {
        double least = std::numeric_limits<double>::infinity(), beyond = -least;
        for (const auto& [a, b, c] : hull.triangles)
            least = std::min(
                least, closest_on_triangle(p, hull.vertices[a], hull.vertices[b], hull.vertices[c]).squared_distance);
        for (const ConvexHull::Face& face : hull.faces)
            beyond = std::max(beyond, reference::dot(reference::to_double(face.normal), reference::to_double(p)) -
                                          double{face.offset});
        return beyond > 0 ? std::sqrt(least) : -std::sqrt(least);
    }
};

std::vector<TestHull> test_hulls() {
    testing_kernels::Random random(1);
    const auto cloud = [&](int count, Vec3 scale, Vec3 place) {
        std::vector<Vec3> points;
        for (int i = 0; i < count; ++i) {
            const reference::vec3 v = random.vector(1);
            points.push_back(place + Vec3{scale.x * static_cast<float>(v.x), scale.y * static_cast<float>(v.y),
                                          scale.z * static_cast<float>(v.z)});
        }
        return points;
    };
    std::vector<Vec3> prism;
    for (int i = 0; i < 40; ++i) {
        const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / 40;
        for (const float y : {-0.5f, 0.5f}) prism.push_back({std::cos(angle), y, std::sin(angle)});
    }
    std::vector<TestHull> hulls;
    hulls.emplace_back("box", make_box({1, 0.5f, 2}, {2, 2, 2}).positions);
    hulls.emplace_back("tetrahedron", std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    hulls.emplace_back("plate", make_box({1, 0.002f, 1}, {2, 2, 2}).positions);
    hulls.emplace_back("prism", prism);
    hulls.emplace_back("ball", make_sphere(0.5f, 2).positions);
    hulls.emplace_back("cloud", cloud(200, {1, 1, 1}, {}));
    hulls.emplace_back("needle", cloud(100, {1, 0.01f, 0.02f}, {}));
    hulls.emplace_back("far away", cloud(50, {0.5f, 0.5f, 0.5f}, {20, -30, 10}));
    return hulls;
}

Vec3 along_edge(const TestHull& t, testing_kernels::Random& random) {
    const auto [a, b] = t.hull.edges[random.index(static_cast<std::uint32_t>(t.hull.edges.size()))];
    return t.hull.vertices[a] + (t.hull.vertices[b] - t.hull.vertices[a]) * static_cast<float>(random.number(0, 1));
}

Vec3 on_triangle(const TestHull& t, testing_kernels::Random& random) {
    const auto [a, b, c] = t.hull.triangles[random.index(static_cast<std::uint32_t>(t.hull.triangles.size()))];
    auto u = random.number(0, 1), v = random.number(0, 1);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const Vec3 o = t.hull.vertices[a];
    return o + (t.hull.vertices[b] - o) * static_cast<float>(u) + (t.hull.vertices[c] - o) * static_cast<float>(v);
}

// Inside, far outside, and near faces, edges and corners.
Vec3 test_point(const TestHull& t, testing_kernels::Random& random, int kind) {
    const Vec3 center = t.data.bounds.center(), half = t.data.bounds.size() * 0.5f;
    const auto within = [&](double reach) {
        const reference::vec3 v = random.vector(reach);
        return Vec3{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    };
    const double near[] = {0, 1e-6, 1e-4, 1e-2};
    const Vec3 by = within(t.size * near[random.index(4)]), wide = within(1.5);
    switch (kind % 5) {
        case 0:
            return center + Vec3{half.x * wide.x, half.y * wide.y, half.z * wide.z};
        case 1:
            return center + wide * static_cast<float>(3 * t.size);
        case 2:
            return on_triangle(t, random) + by;
        case 3:
            return along_edge(t, random) + by;
        default:
            return t.hull.vertices[random.index(static_cast<std::uint32_t>(t.hull.vertices.size()))] + by;
    }
}

TEST(ConvexDistance, agrees_with_brute_force) {
    testing_kernels::Random random(2);
    for (const TestHull& t : test_hulls()) {
        double worst = 0, worst_float = 0;
        for (int i = 0; i < 4000; ++i) {
            const Vec3 p = test_point(t, random, i);
            const double expected = t.brute_force(p), scale = t.size + std::abs(expected);
            reference::vec3 n;
            scalar::vec3 n_float;
            const double d = t.distance({p.x, p.y, p.z}, n);
            const float f = scalar::distance_convex({p.x, p.y, p.z}, {0, 0, 0, 0, t.data.blocks()}, n_float);
            worst = std::max(worst, std::abs(d - expected) / scale);
            worst_float = std::max(worst_float, std::abs(double{f} - expected) / scale);
            ASSERT_NEAR(norm(n), 1, 1e-6) << t.name;
            ASSERT_NEAR(std::hypot(n_float.x, n_float.y, n_float.z), 1, 1e-4) << t.name << ' ' << i;
        }
        EXPECT_LT(worst, 3e-6) << t.name;
        EXPECT_LT(worst_float, 5e-6) << t.name;
    }
}

// Within the step of the differences from a change of the nearest face, edge or corner, the gradient differs.
TEST(ConvexDistance, normals_are_gradients) {
    testing_kernels::Random random(3);
    for (const TestHull& t : test_hulls()) {
        int checked = 0;
        for (int i = 0; i < 2000 && checked < 200; ++i) {
            const Vec3 at = test_point(t, random, i);
            reference::vec3 p[1] = {{at.x, at.y, at.z}};
            reference::vec3 n, other, unused;
            if (std::abs(t.distance(p[0], n)) < 1e-2 * t.size) continue;
            const auto shifted = [&](reference::vec3 by) {
                t.distance(p[0] + by, other);
                return norm(other - n) < 1e-2;
            };
            const double step = 2e-5;
            if (!shifted({step, step, 0}) || !shifted({-step, 0, step}) || !shifted({0, -step, -step})) continue;
            ++checked;
            expect_gradient(
                p, std::span<const reference::vec3>(&n, 1), [&] { return t.distance(p[0], unused); }, 5e-3);
        }
        EXPECT_GT(checked, 20) << t.name;
    }
}

// Along lines past the hull: the distance changes no more than the point moves. The normal outside has no jumps: by
// the distance from the hull, it turns no more than the point moves.
TEST(ConvexDistance, is_continuous) {
    testing_kernels::Random random(4);
    for (const TestHull& t : test_hulls()) {
        const Vec3 center = t.data.bounds.center();
        for (int line = 0; line < 20; ++line) {
            const reference::vec3 o = reference::to_double(center) + random.vector(1.5 * t.size);
            const reference::vec3 to = reference::to_double(center) + random.vector(1.5 * t.size);
            constexpr int steps = 2000;
            const double step = norm(to - o) / steps;
            double before = 0;
            reference::vec3 n_before;
            for (int i = 0; i <= steps; ++i) {
                const reference::vec3 p = o + (to - o) * (double(i) / steps);
                reference::vec3 n;
                const double d = t.distance(p, n);
                if (i > 0) {
                    ASSERT_LE(std::abs(d - before), step + 4e-6 * t.size) << t.name;
                    if (std::min(d, before) > 0.05 * t.size) {
                        ASSERT_LE(norm(n - n_before), step / std::min(d, before) + 1e-3) << t.name;
                    }
                }
                before = d;
                n_before = n;
            }
        }
    }
}

TEST(ConvexDistance, of_a_box_is_that_of_the_box_kernel) {
    testing_kernels::Random random(5);
    const TestHull t("box", make_box({1, 0.5f, 2}, {2, 2, 2}).positions);
    for (int i = 0; i < 1000; ++i) {
        const reference::vec3 p = random.vector(2);
        reference::vec3 n, expected;
        EXPECT_NEAR(t.distance(p, n, 0.125), reference::distance_box(p, {0.5, 0.25, 1, 0, {}}, expected) - 0.125, 1e-6);
        EXPECT_LT(norm(n - expected), 1e-4);
    }
}

TEST(ConvexDistance, float_survives_degenerate_input) {
    for (const TestHull& t : test_hulls()) {
        for (const float x : {0.0f, 1e-30f, -1e10f, 1e15f}) {
            for (const Vec3 from : {Vec3{}, t.data.bounds.center(), t.hull.vertices[0]}) {
                scalar::vec3 n;
                const float d =
                    scalar::distance_convex({from.x + x, from.y - x, from.z + x}, {0.01f, 0, 0, 0, t.data.blocks()}, n);
                EXPECT_TRUE(std::isfinite(d)) << t.name << ' ' << x;
                EXPECT_NEAR(std::hypot(n.x, n.y, n.z), 1, 1e-4) << t.name << ' ' << x;
            }
        }
    }
}

TEST(ConvexDistance, data_are_whole_blocks_with_the_bounds_of_the_vertices) {
    const TestHull t("box", make_box({1, 0.5f, 2}, {3, 3, 3}).positions);
    EXPECT_EQ(t.data.words.size(), 4u * (2 + 6 + 2 * 12));
    EXPECT_EQ(scalar::integer_of(t.data.blocks(), 0), 6);
    EXPECT_EQ(scalar::integer_of(t.data.blocks(), 1), 12);
    EXPECT_EQ(t.data.bounds, (Bounds{{-0.5f, -0.25f, -1}, {0.5f, 0.25f, 1}}));
}

}  // namespace
}  // namespace weft
