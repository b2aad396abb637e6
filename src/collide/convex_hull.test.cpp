#include "collide/convex_hull.h"

#include "mesh/procedural.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>

namespace weft {
namespace {

class HullRandom {
  public:
    explicit HullRandom(unsigned seed) : engine_(seed) {}
    double number(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
    }
    Vec3 in_box(double size) {
        const auto x = number(-size, size), y = number(-size, size), z = number(-size, size);
        return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
    }
    Vec3 on_sphere() {
        for (;;) {
            const Vec3 p = in_box(1);
            if (length(p) > 0.1f && length(p) < 1) return p / length(p);
        }
    }

  private:
    std::mt19937 engine_;
};

Vec3 turned_by(Vec3 p, float yaw, float pitch) {
    const float c = std::cos(yaw), s = std::sin(yaw), d = std::cos(pitch), t = std::sin(pitch);
    const Vec3 q{c * p.x + s * p.z, p.y, c * p.z - s * p.x};
    return {q.x, d * q.y - t * q.z, t * q.y + d * q.z};
}

double beyond(const ConvexHull::Face& face, Vec3 p) {
    return double{face.normal.x} * p.x + double{face.normal.y} * p.y + double{face.normal.z} * p.z -
           double{face.offset};
}

// A closed surface of convex faces that all vertices are behind; Euler's formula for its triangles and for its faces.
void expect_sound(const ConvexHull& hull, double tolerance) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
    for (const Triangle& t : hull.triangles)
        for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(sides.insert({t[i], t[(i + 1) % 3]}).second);
    for (const auto& [a, b] : sides) EXPECT_TRUE(sides.contains({b, a}));
    const auto vertices = hull.vertices.size();
    EXPECT_EQ(hull.triangles.size(), 2 * vertices - 4);
    EXPECT_EQ(vertices + hull.faces.size(), hull.edges.size() + 2);
    ASSERT_EQ(hull.face_of_triangle.size(), hull.triangles.size());
    for (const ConvexHull::Face& face : hull.faces) {
        EXPECT_NEAR(length(face.normal), 1, 1e-6);
        for (const Vec3 v : hull.vertices) EXPECT_LE(beyond(face, v), tolerance);
    }
    for (std::size_t t = 0; t < hull.triangles.size(); ++t)
        for (const std::uint32_t v : hull.triangles[t])
            EXPECT_NEAR(beyond(hull.faces[hull.face_of_triangle[t]], hull.vertices[v]), 0, 2 * tolerance);
}

void expect_contains(const ConvexHull& hull, std::span<const Vec3> points, double tolerance) {
    double most = -1;
    for (const Vec3 p : points)
        for (const ConvexHull::Face& face : hull.faces) most = std::max(most, beyond(face, p));
    EXPECT_LE(most, tolerance);
}

ConvexHull hull_of(std::span<const Vec3> points, std::size_t max_vertices = max_hull_vertices) {
    Result<ConvexHull> hull = convex_hull(points, max_vertices);
    EXPECT_TRUE(hull.ok()) << (hull ? "" : hull.error().message());
    return hull ? *hull : ConvexHull{};
}

std::string hull_error(std::span<const Vec3> points) {
    const Result<ConvexHull> hull = convex_hull(points);
    return hull ? "none" : hull.error().message();
}

TEST(ConvexHull, of_a_tetrahedron) {
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const ConvexHull hull = hull_of(points);
    expect_sound(hull, 1e-6);
    EXPECT_EQ(hull.vertices, points);
    EXPECT_EQ(hull.faces.size(), 4u);
    EXPECT_EQ(hull.edges.size(), 6u);
    EXPECT_EQ(hull.shortfall, 0);
}

TEST(ConvexHull, of_a_box_has_6_faces_and_12_edges_however_it_is_turned_and_cut) {
    HullRandom random(1);
    for (const std::uint32_t cuts : {2u, 3u, 12u}) {
        std::vector<Vec3> box = make_box({1, 0.3f, 2}, {cuts, cuts + 1, cuts}).positions;
        for (int i = 0; i < 40; ++i) box.push_back({0.4f * random.in_box(1).x, 0.1f, 0});
        for (int turn = 0; turn < 50; ++turn) {
            std::vector<Vec3> points;
            const auto yaw = static_cast<float>(random.number(0, 6)), pitch = static_cast<float>(random.number(0, 6));
            const Vec3 place = random.in_box(turn % 3);
            for (const Vec3 p : box) points.push_back(turn == 0 ? p : turned_by(p, yaw, pitch) + place);
            const ConvexHull hull = hull_of(points);
            expect_sound(hull, 4e-6);
            expect_contains(hull, points, 4e-6);
            ASSERT_EQ(hull.vertices.size(), 8u) << turn;
            ASSERT_EQ(hull.faces.size(), 6u) << turn;
            ASSERT_EQ(hull.edges.size(), 12u) << turn;
        }
    }
}

TEST(ConvexHull, an_unturned_box_has_exact_faces) {
    const ConvexHull hull = hull_of(make_box({1, 0.5f, 2}, {3, 3, 3}).positions);
    for (const ConvexHull::Face& face : hull.faces) {
        EXPECT_EQ(std::abs(face.normal.x) + std::abs(face.normal.y) + std::abs(face.normal.z), 1);
        EXPECT_EQ(face.offset,
                  0.5f * std::abs(face.normal.x) + 0.25f * std::abs(face.normal.y) + std::abs(face.normal.z));
    }
}

TEST(ConvexHull, contains_all_points_and_has_only_some_of_them_as_vertices) {
    HullRandom random(2);
    for (const int count : {4, 5, 8, 20, 100, 1000, 20000}) {
        std::vector<Vec3> points;
        for (int i = 0; i < count; ++i) points.push_back(random.in_box(1));
        const ConvexHull hull = hull_of(points);
        expect_sound(hull, 2e-6);
        expect_contains(hull, points, 2e-6);
        for (const Vec3 v : hull.vertices) EXPECT_NE(std::ranges::find(points, v), points.end());
    }
}

// The faces of the hull of few points: those of three points with all others on one side.
TEST(ConvexHull, agrees_with_brute_force) {
    HullRandom random(3);
    for (int round = 0; round < 50; ++round) {
        std::vector<Vec3> points;
        for (int i = 0; i < 14; ++i) points.push_back(random.in_box(1));
        std::size_t expected = 0;
        for (std::size_t a = 0; a < points.size(); ++a)
            for (std::size_t b = a + 1; b < points.size(); ++b)
                for (std::size_t c = b + 1; c < points.size(); ++c) {
                    const Vec3 n = normalized(cross(points[b] - points[a], points[c] - points[a]));
                    int above = 0, below = 0;
                    for (std::size_t d = 0; d < points.size(); ++d) {
                        if (d == a || d == b || d == c) continue;
                        (dot(n, points[d] - points[a]) > 0 ? above : below) += 1;
                    }
                    if (above == 0 || below == 0) ++expected;
                }
        EXPECT_EQ(hull_of(points).faces.size(), expected);
    }
}

TEST(ConvexHull, keeps_polygons_with_many_corners) {
    constexpr int sides = 100;
    std::vector<Vec3> points;
    for (int i = 0; i < sides; ++i) {
        const float angle = 2 * std::numbers::pi_v<float> * i / sides;
        for (const float y : {-1.0f, 0.0f, 1.0f})
            points.push_back(turned_by({std::cos(angle), y, std::sin(angle)}, 1, 2));
    }
    const ConvexHull hull = hull_of(points);
    expect_sound(hull, 3e-6);
    EXPECT_EQ(hull.vertices.size(), 2u * sides);
    EXPECT_EQ(hull.faces.size(), sides + 2u);
    EXPECT_EQ(hull.edges.size(), 3u * sides);
}

TEST(ConvexHull, is_simplified_beyond_the_limit) {
    HullRandom random(4);
    std::vector<Vec3> points;
    for (int i = 0; i < 30000; ++i) points.push_back(random.on_sphere());
    double before = 1;
    for (const std::size_t vertices : {std::size_t{16}, std::size_t{64}, max_hull_vertices}) {
        const ConvexHull hull = hull_of(points, vertices);
        expect_sound(hull, 1e-6);
        EXPECT_EQ(hull.vertices.size(), vertices);
        EXPECT_GT(hull.shortfall, 0);
        EXPECT_LT(hull.shortfall, before / 2);
        expect_contains(hull, points, hull.shortfall + 2e-6);
        before = hull.shortfall;
    }
    EXPECT_LT(before, 0.02) << "of a ball of 1 m";
}

TEST(ConvexHull, thin_plates_and_far_places_keep_their_shape) {
    for (const float thickness : {1e-2f, 1e-4f, 1e-5f}) {
        const ConvexHull hull = hull_of(make_box({1, thickness, 1}, {4, 2, 4}).positions);
        expect_sound(hull, 1e-6);
        EXPECT_EQ(hull.faces.size(), 6u) << thickness;
    }
    std::vector<Vec3> far = make_box({1, 1, 1}, {4, 4, 4}).positions;
    for (Vec3& p : far) p += Vec3{1000, -2000, 500};
    EXPECT_EQ(hull_of(far).faces.size(), 6u);
    std::vector<Vec3> tiny = make_box({1e-4f, 1e-4f, 1e-4f}, {2, 2, 2}).positions;
    EXPECT_EQ(hull_of(tiny).faces.size(), 6u);
}

TEST(ConvexHull, the_order_of_the_points_and_repeated_ones_do_not_matter) {
    HullRandom random(5);
    std::vector<Vec3> points;
    for (int i = 0; i < 500; ++i) points.push_back(random.in_box(1));
    const ConvexHull hull = hull_of(points);
    std::vector<Vec3> other(points.rbegin(), points.rend());
    other.insert(other.end(), points.begin(), points.end());
    const ConvexHull again = hull_of(other);
    const auto sorted = [](std::vector<Vec3> v) {
        std::ranges::sort(v, {}, [](Vec3 p) { return std::array{p.x, p.y, p.z}; });
        return v;
    };
    EXPECT_EQ(sorted(hull.vertices), sorted(again.vertices));
    EXPECT_EQ(hull.faces.size(), again.faces.size());
    EXPECT_EQ(hull_of(points).triangles, hull.triangles) << "the same input gives the same hull";
}

TEST(ConvexHull, names_what_is_wrong_with_the_points) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    EXPECT_EQ(hull_error({}), "points: a convex hull needs at least 4 points, got 0");
    EXPECT_EQ(hull_error(std::span(points).first(3)), "points: a convex hull needs at least 4 points, got 3");
    points[2].y = nan;
    EXPECT_EQ(hull_error(points), "point 2: is not finite: (0, nan, 0)");
    points[2].y = -inf;
    EXPECT_EQ(hull_error(points), "point 2: is not finite: (0, -inf, 0)");
    points[2].y = 2e6f;
    EXPECT_EQ(hull_error(points), "point 2: coordinates must be from -1e6 to 1e6 m, got 2e+06 m");

    points.assign(100, {1, 2, 3});
    EXPECT_EQ(hull_error(points), "points: all 100 points lie at one place, within 0 m: a convex hull needs a volume");
    HullRandom random(6);
    const Vec3 u = turned_by({1, 0, 0}, 0.3f, 0.7f), v = turned_by({0, 1, 0}, 0.3f, 0.7f);
    for (Vec3& p : points) p = Vec3{1, 2, 3} + u * static_cast<float>(random.number(-1, 1));
    EXPECT_TRUE(hull_error(points).starts_with("points: all 100 points lie on one line, within "))
        << hull_error(points);
    for (Vec3& p : points) p += v * static_cast<float>(random.number(-1, 1));
    EXPECT_TRUE(hull_error(points).starts_with("points: all 100 points lie in one plane, within "))
        << hull_error(points);
    points.push_back({1, 2, 3.1f});
    EXPECT_EQ(hull_error(points), "none");
    for (Vec3& p : points) p = p * 1e-9f;
    EXPECT_TRUE(hull_error(points).starts_with("points: all 101 points lie at one place")) << hull_error(points);
}

}  // namespace
}  // namespace weft
