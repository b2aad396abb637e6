#include "physics/testing.h"

namespace weft {
namespace {

using namespace testing_kernels;

constexpr double far_apart = 1e6;

// Kinds by their numbers in shapes.def.
constexpr int plane = 0, sphere = 1, box = 2;

reference::Solid solid(int kind, std::array<double, 4> n, bool convex = true) {
    return {kind, {n[0], n[1], n[2], n[3], {}}, 1, 0, convex ? far_apart : 0.1};
}

bool sheltered(const reference::Solid& of, vec3 p, vec3 ray, double reach) {
    return reference::is_sheltered(of, p, ray * (1 / norm(ray)), reach);
}

// Where a ray first enters a sphere around the origin; negative: never.
double entry(vec3 p, vec3 ray, double radius) {
    const double b = reference::dot(p, ray), c = reference::dot(p, p) - radius * radius, root = b * b - c;
    return root < 0 ? -1 : -b - std::sqrt(root);
}

TEST(Shelter, of_a_sphere_is_where_the_ray_meets_it_within_reach) {
    Random random(1);
    for (const bool convex : {true, false}) {
        const auto ball = solid(sphere, {0.5, 0, 0, 0}, convex);
        int hits = 0;
        for (int i = 0; i < 5000; ++i) {
            const vec3 p = random.vector(2);
            vec3 ray = random.vector(1);
            ray = ray * (1 / norm(ray));
            const double reach = random.number(0.1, 3), at = entry(p, ray, 0.5);
            if (norm(p) < 0.51 || std::abs(at - reach) < 0.01) continue;
            // Rays that graze the sphere may go either way.
            if (std::abs(norm(reference::cross(p, ray)) - 0.5) < 0.01) continue;
            const bool expected = at > 0 && at < reach;
            EXPECT_EQ(sheltered(ball, p, ray, reach), expected) << i << ' ' << at << ' ' << reach;
            hits += expected;
        }
        EXPECT_GT(hits, 50);
    }
}

TEST(Shelter, ends_with_the_reach) {
    for (const bool convex : {true, false}) {
        const auto of = solid(box, {0.05, 1, 1, 0}, convex);
        EXPECT_TRUE(sheltered(of, {1.05, 0, 0}, {-1, 0, 0}, 1.01));
        EXPECT_FALSE(sheltered(of, {1.05, 0, 0}, {-1, 0, 0}, 0.99));
        EXPECT_FALSE(sheltered(of, {1.05, 0, 0}, {1, 0, 0}, 9)) << "the lee side alone";
        EXPECT_FALSE(sheltered(of, {1.05, 1.1, 0}, {-1, 0, 0}, 9)) << "above the wall";
        EXPECT_TRUE(sheltered(of, {1.05, 1.1, 0}, {-1, -0.4, 0}, 9));
        EXPECT_FALSE(sheltered(of, {1.05, 0, 0}, {-1, 0, 0}, 0));
    }
}

TEST(Shelter, knows_the_two_sides_of_a_wall_that_the_cloth_touches) {
    for (const bool convex : {true, false}) {
        const auto of = solid(box, {0.05, 1, 1, 0}, convex);
        for (const double gap : {-1e-3, -1e-5, 0.0, 1e-5, 1e-3}) {
            EXPECT_TRUE(sheltered(of, {0.05 + gap, 0, 0}, {-1, 0, 0}, 1)) << gap;
            EXPECT_FALSE(sheltered(of, {0.05 + gap, 0, 0}, {1, 0, 0}, 1)) << gap;
        }
    }
}

TEST(Shelter, is_none_beside_a_ground_along_which_the_wind_blows) {
    const auto ground = solid(plane, {0, 1, 0, 0});
    for (const double height : {0.0, 1e-5, 1e-3, 0.3}) {
        EXPECT_FALSE(sheltered(ground, {0, height, 0}, {1, 0, 0.3}, 10)) << height;
        EXPECT_FALSE(sheltered(ground, {0, height, 0}, {1, 0.1, 0}, 10)) << height;
        EXPECT_TRUE(sheltered(ground, {0, height, 0}, {1, -0.1, 0}, 10)) << height;
    }
}

TEST(Shelter, behind_a_wall_that_is_thinner_than_a_step) {
    Random random(2);
    for (const bool convex : {true, false}) {
        const auto of = solid(box, {0.001, 5, 5, 0}, convex);
        for (int i = 0; i < 300; ++i) {
            const vec3 p(random.number(0.01, 1.9), random.number(-1, 1), random.number(-1, 1));
            EXPECT_TRUE(sheltered(of, p, {-1, random.number(-0.5, 0.5), random.number(-0.5, 0.5)}, 4)) << p.x;
        }
    }
}

}  // namespace
}  // namespace weft
