#include "physics/contact/tapered_capsule.data.h"
#include "physics/testing.h"

#include <numbers>

namespace weft {
namespace {

using namespace testing_kernels;

reference::ShapeNumbers in_double(const TaperedCapsuleDesc& desc) {
    const std::array<float, 4> n = shape_numbers(desc);
    return {n[0], n[1], n[2], n[3], {}};
}

// The shape is the convex hull of its two balls. Outside, the distance is the least one to the balls of all radii along
// the axis. Inside, it is the least distance to a tangent plane: minus the minimum over directions u of
// max(radius + u·(center - p)). Both by fine sampling, in the half plane of p and the axis.
double sampled_distance(const TaperedCapsuleDesc& desc, vec3 p) {
    constexpr int samples = 50000;
    const double r = std::sqrt(p.x * p.x + p.z * p.z), h = desc.half_height;
    double outside = 1e30, inside = 1e30;
    for (int i = 0; i <= samples; ++i) {
        const double t = double(i) / samples;
        const double radius = desc.radius[0] * (1 - t) + desc.radius[1] * t;
        outside = std::min(outside, std::hypot(r, p.y + h - 2 * h * t) - radius);
        const double angle = std::numbers::pi * t;
        const double u = std::sin(angle), v = std::cos(angle);
        inside = std::min(inside, std::max(desc.radius[0] + v * (-h - p.y), desc.radius[1] + v * (h - p.y)) - u * r);
    }
    return outside > 0 ? outside : -inside;
}

const TaperedCapsuleDesc tapered_capsules[] = {
    {.radius = {0.5f, 0.2f}, .half_height = 0.6f},   {.radius = {0.1f, 0.4f}, .half_height = 0.3f},
    {.radius = {0.3f, 0.3f}, .half_height = 0.5f},   {.radius = {0.7f, 0.11f}, .half_height = 0.3f},
    {.radius = {0.05f, 0.01f}, .half_height = 1.0f},
};

TEST(TaperedCapsule, distances_agree_with_sampling) {
    Random random(3);
    for (const TaperedCapsuleDesc& desc : tapered_capsules) {
        for (int i = 0; i < 60; ++i) {
            const vec3 p = random.vector(i % 2 == 0 ? 1.3 : 0.4);
            vec3 n;
            EXPECT_NEAR(reference::distance_tapered_capsule(p, in_double(desc), n), sampled_distance(desc, p), 2e-5)
                << p.x << ' ' << p.y << ' ' << p.z;
        }
    }
}

TEST(TaperedCapsule, normals_are_gradients) {
    Random random(4);
    for (const TaperedCapsuleDesc& desc : tapered_capsules) {
        for (int i = 0; i < 100; ++i) {
            vec3 p[1] = {random.vector(1)};
            vec3 n, unused;
            reference::distance_tapered_capsule(p[0], in_double(desc), n);
            EXPECT_NEAR(norm(n), 1, 1e-7);
            const double radius = std::hypot(p[0].x, p[0].z);
            if (radius < 0.01) continue;  // on the axis the distance has no gradient inside
            expect_gradient(
                p, std::span<const vec3>(&n, 1),
                [&] { return reference::distance_tapered_capsule(p[0], in_double(desc), unused); }, 2e-3);
        }
    }
}

// Across the lines between the cone and the balls.
TEST(TaperedCapsule, normals_are_continuous) {
    for (const TaperedCapsuleDesc& desc : tapered_capsules) {
        vec3 before;
        for (int i = 0; i <= 20000; ++i) {
            const vec3 p(0.15, -1.2 + 2.4 * i / 20000, 0.1);
            vec3 n;
            reference::distance_tapered_capsule(p, in_double(desc), n);
            if (i > 0) {
                EXPECT_LT(norm(n - before), 2e-3) << p.y;
            }
            before = n;
        }
    }
}

TEST(TaperedCapsule, equal_radii_make_a_capsule) {
    Random random(5);
    const TaperedCapsuleDesc desc{.radius = {0.25f, 0.25f}, .half_height = 0.75f};
    for (int i = 0; i < 100; ++i) {
        const vec3 p = random.vector(1.5);
        vec3 n, expected;
        const double d = reference::distance_tapered_capsule(p, in_double(desc), n);
        EXPECT_NEAR(d, reference::distance_capsule(p, {0.25, 0.75, 0, 0, {}}, expected), 1e-15);
        EXPECT_LT(norm(n - expected), 1e-14);
    }
}

TEST(TaperedCapsule, is_the_larger_ball_if_that_holds_the_other) {
    Random random(6);
    for (const TaperedCapsuleDesc& desc : {TaperedCapsuleDesc{.radius = {1, 0.5f}, .half_height = 0.25f},
                                           TaperedCapsuleDesc{.radius = {0.5f, 1}, .half_height = 0.25f},
                                           TaperedCapsuleDesc{.radius = {0.5f, 1}, .half_height = 0.125f},
                                           TaperedCapsuleDesc{.radius = {1, 0.5f}, .half_height = 0},
                                           TaperedCapsuleDesc{.radius = {0.5f, 0.5f}, .half_height = 0}}) {
        const bool first = desc.radius[0] >= desc.radius[1];
        const vec3 center(0, first ? -desc.half_height : desc.half_height, 0);
        const reference::ShapeNumbers ball{std::max(desc.radius[0], desc.radius[1]), 0, 0, 0, {}};
        for (int i = 0; i < 100; ++i) {
            vec3 p = random.vector(2);
            if (i % 4 == 0) p.x = p.z = 0;
            vec3 n, expected;
            EXPECT_NEAR(reference::distance_tapered_capsule(p, in_double(desc), n),
                        reference::distance_sphere(p - center, ball, expected), 1e-15);
            EXPECT_LT(norm(n - expected), 1e-14);
        }
    }
}

TEST(TaperedCapsule, normal_on_the_axis_points_along_x) {
    vec3 n;
    EXPECT_NEAR(reference::distance_tapered_capsule({0, 0.1, 0}, in_double({.radius = {0.3f, 0.3f}}), n), -0.3, 1e-7);
    EXPECT_LT(norm(n - vec3(1, 0, 0)), 1e-7);
    reference::distance_tapered_capsule({0, 0.1, 0}, in_double({.radius = {0.5f, 0.2f}}), n);
    EXPECT_NEAR(n.x, std::sqrt(1 - 0.3 * 0.3), 1e-7);
    EXPECT_NEAR(n.y, 0.3, 1e-7);
    EXPECT_EQ(n.z, 0);
}

TEST(TaperedCapsule, float_agrees_and_survives_degenerate_input) {
    Random random(7);
    for (const TaperedCapsuleDesc& desc :
         {tapered_capsules[0], tapered_capsules[3], TaperedCapsuleDesc{.radius = {1, 0.5f}, .half_height = 0.25f},
          TaperedCapsuleDesc{.radius = {1, 1}, .half_height = 0},
          TaperedCapsuleDesc{.radius = {1, 0.50000006f}, .half_height = 0.25f}}) {
        const std::array<float, 4> f = shape_numbers(desc);
        for (int i = 0; i < 300; ++i) {
            vec3 p = random.vector(1.2);
            if (i % 5 == 0) p.x = p.z = 0;
            if (i % 5 == 1) p = vec3(random.number(-1e-12, 1e-12), p.y, 0);
            if (i % 15 == 0) p.y = i % 2 == 0 ? desc.half_height : -desc.half_height;
            if (i == 299) p = vec3(1e10, -1e10, 1e10);
            vec3 unused;
            scalar::vec3 n;
            const auto x = static_cast<float>(p.x), y = static_cast<float>(p.y), z = static_cast<float>(p.z);
            const float d = scalar::distance_tapered_capsule({x, y, z}, {f[0], f[1], f[2], f[3], {}}, n);
            const double expected = reference::distance_tapered_capsule({x, y, z}, in_double(desc), unused);
            EXPECT_NEAR(d, expected, 1e-6 * std::max(1.0, std::abs(expected)));
            EXPECT_NEAR(std::hypot(n.x, n.y, n.z), 1, 1e-5);
        }
    }
}

TEST(TaperedCapsule, bounds_hold_the_surface) {
    for (const TaperedCapsuleDesc& desc :
         {tapered_capsules[0], tapered_capsules[1], TaperedCapsuleDesc{.radius = {1, 0.1f}, .half_height = 0.25f},
          TaperedCapsuleDesc{.radius = {0.1f, 1}, .half_height = 0.25f}}) {
        const Bounds box = shape_bounds(desc);
        vec3 unused;
        for (const float y : {box.min.y, box.max.y})
            EXPECT_NEAR(reference::distance_tapered_capsule({0, y, 0}, in_double(desc), unused), 0, 1e-6);
    }
}

}  // namespace
}  // namespace weft
