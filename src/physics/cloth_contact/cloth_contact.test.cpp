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

// Rounding of the closest points on features of 6 m, 3 m from the origin, tilts the normal at a distance of 1 mm.
TEST(ClothContactKernels, normals_of_large_features_are_square_to_them) {
    const auto on_lane = [](vec3 x) { return scalar::vec3{float(x.x), float(x.y), float(x.z)}; };
    const vec3 up(-0.342020143325669, 0.939692620785908, 0), along(0.939692620785908, 0.342020143325669, 0);
    Random random(11);
    double most = 0, most_before = 0;
    for (int i = 0; i < 500; ++i) {
        const vec3 at = random.vector(0.2);
        const scalar::vec3 p = on_lane(along * at.x + vec3(0, 0, at.z) + up * 0.001);
        const scalar::vec3 a = on_lane(along * -3.0 + vec3(0, 0, -3)), b = on_lane(along * 3.0 + vec3(0, 0, -3)),
                           c = on_lane(vec3(0, 0, 3));
        const scalar::ClosestPoints points = scalar::closest_vertex_triangle(p, a, b, c);
        const auto tilt = [&](scalar::vec3 n) { return norm(vec3(n.x, n.y, n.z) - up); };
        most = std::max(most, tilt(scalar::normal_vertex_triangle(points, a, b, c)));
        most_before = std::max(most_before, tilt(points.normal));
    }
    EXPECT_LT(most, 1e-6);
    EXPECT_GT(most_before, 1e-5) << "nothing to correct";
}

// Where rounding does not matter, nothing changes.
TEST(ClothContactKernels, normals_of_random_features_are_those_of_their_closest_points) {
    Random random(12);
    for (int i = 0; i < 2000; ++i) {
        vec3 x[4];
        for (vec3& p : x) p = random.vector(1);
        x[0] = i % 2 == 0 ? x[0] : (x[1] + x[2] + x[3]) * (1.0 / 3) + random.vector(0.001);
        const ClosestPoints face = reference::closest_vertex_triangle(x[0], x[1], x[2], x[3]);
        EXPECT_LT(norm(reference::normal_vertex_triangle(face, x[1], x[2], x[3]) - face.normal), 1e-6);
        const ClosestPoints edge = reference::closest_edge_edge(x[0], x[1], x[2], x[3]);
        EXPECT_LT(norm(reference::normal_edge_edge(edge, x[0], x[1], x[2], x[3]) - edge.normal), 1e-6);
    }
}

// Pairs of edges that are not pushed: a vertex and a triangle of the other edge are no farther apart.
TEST(ClothContactKernels, closest_points_that_are_an_end_of_an_edge_leave_the_push_to_a_vertex_and_a_triangle) {
    Random random(7);
    int ends = 0;
    for (int i = 0; i < 2000; ++i) {
        vec3 x[4];
        for (vec3& p : x) p = random.vector(1);
        const ClosestPoints edges = reference::closest_edge_edge(x[0], x[1], x[2], x[3]);
        if (reference::closest_inside_edges(edges.w0, edges.w1, edges.w2, edges.w3)) continue;
        ++ends;
        double nearest = 1e300;
        for (int k = 0; k < 4; ++k) {
            const int other = k < 2 ? 2 : 0;
            nearest = std::min(
                nearest, reference::closest_vertex_triangle(x[k], x[other], x[other + 1], random.vector(1)).distance);
        }
        EXPECT_LE(nearest, edges.distance + 1e-9);
    }
    EXPECT_GT(ends, 500);
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

TEST(ClothContactKernels, the_brake_leaves_the_part_of_a_motion_that_loses_no_more_than_its_depth) {
    constexpr double start = 0.001, least = 0.0002, depth = 0.0005;
    EXPECT_EQ(reference::part_to_depth(start, start, least, depth), 1) << "at rest";
    EXPECT_EQ(reference::part_to_depth(-0.00029, start, least, depth), 1) << "contact can answer that";
    for (const double gap : {-0.00031, -0.001, -0.5}) {
        const double part = reference::part_to_depth(gap, start, least, depth);
        EXPECT_NEAR(start + part * (gap - start), least - depth, 1e-12);
    }
    const double closed = reference::part_to_depth(-0.002, 0.0, least, depth);
    EXPECT_NEAR(closed * -0.002, -depth, 1e-12) << "a pair without a gap";
}

TEST(ClothContactKernels, sides_that_keep_their_least_motions_keep_their_gap) {
    Random random(9);
    for (int i = 0; i < 2000; ++i) {
        const bool edges = i % 2 == 0;
        double start[4], moved[4], mass[4];
        for (int k = 0; k < 4; ++k) {
            start[k] = random.vector(1).x, moved[k] = random.vector(1).x;
            mass[k] = random.vector(1).x > 0.5 ? 0 : 1;
        }
        const auto gap = [&](const double(&x)[4]) {
            return edges ? reference::gap_edge_edge(x[0], x[1], x[2], x[3])
                         : reference::gap_vertex_triangle(x[0], x[1], x[2], x[3]);
        };
        const double before = gap(start), spare = i % 3 == 0 ? 0.1 : 0;
        const auto least_motions =
            edges ? reference::least_motions_edge_edge : reference::least_motions_vertex_triangle;
        const auto least =
            least_motions(moved[0], moved[1], moved[2], moved[3], mass[0], mass[1], mass[2], mass[3], spare);
        double end[4];
        bool fixed[2] = {false, false};
        for (int k = 0; k < 4; ++k) {
            const bool one = k < (edges ? 2 : 1);
            fixed[one ? 0 : 1] |= mass[k] == 0;
            double motion = one ? moved[k] : -moved[k];
            if (mass[k] > 0) motion = std::max(motion, one ? least.one : least.two);
            end[k] = start[k] + (one ? motion : -motion);
        }
        if (fixed[0] && fixed[1]) continue;  // nothing can hold their sides apart
        EXPECT_GE(gap(end), before - spare - 1e-12) << i;
    }
    // A side may follow the other one, and gives way to what is prescribed.
    EXPECT_EQ(reference::least_motions_vertex_triangle(-1, -3, -2, -4, 1, 1, 1, 1, 0).one, -2);
    EXPECT_EQ(reference::least_motions_vertex_triangle(0, 3, 2, 4, 1, 1, 1, 1, 0).one, 0);
    EXPECT_EQ(reference::least_motions_vertex_triangle(0, 3, 2, 4, 1, 0, 1, 1, 0).one, 3);
}

TEST(ClothContactKernels, sliding_stays_near_the_way_of_the_particle) {
    Random random(4);
    for (int i = 0; i < 1000; ++i) {
        const vec3 asked = random.vector(1), slide = random.vector(1);
        const vec3 left = reference::slide_near(asked, slide, 0.05);
        EXPECT_LT(norm(cross(left, slide)), 1e-9) << "the direction stays";
        EXPECT_LE(norm(left), norm(slide) + 1e-12);
        const double along = std::clamp(dot(left, asked) / dot(asked, asked), 0.0, 1.0);
        EXPECT_LE(norm(left - asked * along), 0.05 + 1e-9);
    }
    const vec3 asked(1, 0, 0);
    EXPECT_LT(norm(reference::slide_near(asked, vec3(0.5, 0.04, 0), 0.05) - vec3(0.5, 0.04, 0)), 1e-12)
        << "near enough";
    EXPECT_EQ(norm(reference::slide_near(vec3(0, 0, 0), vec3(0, 0, 0), 0.05)), 0);
}

}  // namespace
}  // namespace weft
