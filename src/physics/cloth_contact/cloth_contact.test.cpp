#include "physics/testing.h"

#include <algorithm>

namespace weft {
namespace {

using namespace testing_kernels;
using reference::ClosestPoints;

constexpr int grid = 160;

double sampled_vertex_triangle(const vec3 (&x)[4]) {
    double least = 1e300;
    for (int i = 0; i <= grid; ++i)
        for (int j = 0; i + j <= grid; ++j) {
            const double b = double(i) / grid, c = double(j) / grid;
            least = std::min(least, norm(x[0] - (x[1] * (1 - b - c) + x[2] * b + x[3] * c)));
        }
    return least;
}

double sampled_edge_edge(const vec3 (&x)[4]) {
    double least = 1e300;
    for (int i = 0; i <= grid; ++i)
        for (int j = 0; j <= grid; ++j) {
            const double s = double(i) / grid, t = double(j) / grid;
            least = std::min(least, norm(x[0] * (1 - s) + x[1] * s - (x[2] * (1 - t) + x[3] * t)));
        }
    return least;
}

// The weights give the distance and lie on the features; no sampled point is closer.
void expect_closest(const ClosestPoints& points, const vec3 (&x)[4], bool edges, double longest) {
    const vec3 difference = x[0] * points.w0 + x[1] * points.w1 + x[2] * points.w2 + x[3] * points.w3;
    EXPECT_NEAR(norm(difference), points.distance, 1e-9);
    EXPECT_NEAR(norm(points.normal), 1, 1e-9);
    EXPECT_LT(points.distance > 1e-6 ? norm(points.normal * points.distance - difference) : 0, 1e-9);
    EXPECT_NEAR(points.w0 + points.w1 + points.w2 + points.w3, 0, 1e-12);
    const double one = edges ? points.w0 + points.w1 : points.w0;
    EXPECT_NEAR(one, 1, 1e-12);
    for (const double w : {points.w0, edges ? points.w1 : -points.w1, -points.w2, -points.w3}) EXPECT_GE(w, -1e-12);
    const double sampled = edges ? sampled_edge_edge(x) : sampled_vertex_triangle(x);
    EXPECT_LE(points.distance, sampled + 1e-9);
    EXPECT_GE(points.distance, sampled - 2 * longest / grid);
}

TEST(ClothContactKernels, finds_closest_points_of_random_features) {
    Random random(3);
    for (int i = 0; i < 300; ++i) {
        vec3 x[4];
        for (vec3& p : x) p = random.vector(1);
        expect_closest(reference::closest_vertex_triangle(x[0], x[1], x[2], x[3]), x, false, 3.5);
        expect_closest(reference::closest_edge_edge(x[0], x[1], x[2], x[3]), x, true, 3.5);
    }
}

TEST(ClothContactKernels, finds_closest_points_of_degenerate_features) {
    Random random(5);
    for (int i = 0; i < 200; ++i) {
        const vec3 p = random.vector(1), a = random.vector(1), along = random.vector(1);
        const vec3 triangles[][4] = {{p, a, a, a},
                                     {p, a, a, a + along},
                                     {p, a, a + along, a + along},
                                     {p, a, a + along, a + along * 0.3},
                                     {p, a, a - along, a + along * 2.0}};
        for (const auto& x : triangles)
            expect_closest(reference::closest_vertex_triangle(x[0], x[1], x[2], x[3]), x, false, 6);
        const vec3 edges[][4] = {{p, p, a, a},
                                 {p, p, a, a + along},
                                 {a, a + along, p, p},
                                 {a, a + along, p, p + along},
                                 {a, a + along, p, p - along * 0.5},
                                 {a, a + along, a + along * 0.2, a + along * 0.7}};
        for (const auto& x : edges) expect_closest(reference::closest_edge_edge(x[0], x[1], x[2], x[3]), x, true, 6);
    }
}

TEST(ClothContactKernels, float_agrees_with_double) {
    Random random(8);
    for (int i = 0; i < 2000; ++i) {
        vec3 x[4];
        scalar::vec3 y[4];
        for (int k = 0; k < 4; ++k) {
            x[k] = random.vector(0.01);
            y[k] = {float(x[k].x), float(x[k].y), float(x[k].z)};
        }
        EXPECT_NEAR(scalar::closest_vertex_triangle(y[0], y[1], y[2], y[3]).distance,
                    reference::closest_vertex_triangle(x[0], x[1], x[2], x[3]).distance, 2e-6);
        EXPECT_NEAR(scalar::closest_edge_edge(y[0], y[1], y[2], y[3]).distance,
                    reference::closest_edge_edge(x[0], x[1], x[2], x[3]).distance, 2e-6);
    }
}

TEST(ClothContactKernels, a_gap_along_the_normal_separates_the_sides) {
    Random random(2);
    for (int i = 0; i < 1000; ++i) {
        vec3 x[4];
        for (vec3& p : x) p = random.vector(1);
        double along[4];
        const ClosestPoints face = reference::closest_vertex_triangle(x[0], x[1], x[2], x[3]);
        for (int k = 0; k < 4; ++k) along[k] = dot(face.normal, x[k]);
        EXPECT_NEAR(reference::gap_vertex_triangle(along[0], along[1], along[2], along[3]), face.distance, 1e-9);
        const ClosestPoints edge = reference::closest_edge_edge(x[0], x[1], x[2], x[3]);
        for (int k = 0; k < 4; ++k) along[k] = dot(edge.normal, x[k]);
        EXPECT_NEAR(reference::gap_edge_edge(along[0], along[1], along[2], along[3]), edge.distance, 1e-9);
    }
}

TEST(ClothContactKernels, old_overlap_is_removed_at_a_limited_speed) {
    constexpr double thickness = 0.002, recovery = 1e-4;
    EXPECT_NEAR(reference::cloth_overlap(0.0015, 0.003, thickness, recovery), -0.0005, 1e-12) << "new overlap";
    EXPECT_NEAR(reference::cloth_overlap(0.0005, 0.0005, thickness, recovery), -recovery, 1e-12) << "old overlap";
    EXPECT_GT(reference::cloth_overlap(0.0021, 0.001, thickness, recovery), 0);
}

TEST(ClothContactKernels, friction_takes_back_slip_up_to_the_coulomb_limit) {
    const vec3 normal(0, 1, 0), moved(0.003, 0.5, 0.004);
    EXPECT_LT(norm(reference::cloth_friction(moved, normal, 0.02, 0.3, 0.2) - vec3(0.003, 0, 0.004)), 1e-12)
        << "the push of 20 mm holds a slip of 5 mm";
    EXPECT_NEAR(norm(reference::cloth_friction(moved, normal, 0.01, 0.3, 0.2)), 0.002, 1e-12) << "it slides";
    EXPECT_EQ(norm(reference::cloth_friction(vec3(0, 1, 0), normal, 0.01, 0.3, 0.2)), 0);
}

}  // namespace
}  // namespace weft
