#include "collide/crossings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace weft {
namespace {

struct Soup {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
};

Crossings count(const Soup& soup) {
    return count_crossings(soup.positions, soup.triangles);
}

using Real = long double;
using Point = std::array<Real, 3>;

Point point(Vec3 v) {
    return {v.x, v.y, v.z};
}
Point operator-(const Point& a, const Point& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Point cross(const Point& a, const Point& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Real dot(const Point& a, const Point& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997: a different method from the one under
/// test.
bool segment_meets_triangle(const Soup& soup, std::uint32_t from, std::uint32_t to, const Triangle& triangle) {
    const Point origin = point(soup.positions[from]);
    const Point direction = point(soup.positions[to]) - origin;
    const Point corner = point(soup.positions[triangle[0]]);
    const Point e1 = point(soup.positions[triangle[1]]) - corner, e2 = point(soup.positions[triangle[2]]) - corner;
    const Point p = cross(direction, e2);
    const Real det = dot(e1, p);
    if (det == 0) return false;
    const Point s = origin - corner, q = cross(s, e1);
    const Real u = dot(s, p) / det, v = dot(direction, q) / det, t = dot(e2, q) / det;
    return u >= 0 && v >= 0 && u + v <= 1 && t >= 0 && t <= 1;
}

bool contains(const Triangle& triangle, std::uint32_t particle) {
    return std::ranges::count(triangle, particle) > 0;
}

/// Every edge against every triangle, every triangle against every other.
Crossings brute_force(const Soup& soup) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const Triangle& t : soup.triangles) {
        for (int c = 0; c < 3; ++c) edges.insert(std::minmax(t[c], t[(c + 1) % 3]));
    }
    Crossings result;
    const auto meets = [&](std::uint32_t a, std::uint32_t b, const Triangle& t) {
        return !contains(t, a) && !contains(t, b) && segment_meets_triangle(soup, a, b, t);
    };
    for (const auto& [a, b] : edges) {
        for (const Triangle& t : soup.triangles) result.edges += meets(a, b, t);
    }
    for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
        for (std::size_t j = i + 1; j < soup.triangles.size(); ++j) {
            const Triangle &s = soup.triangles[i], &t = soup.triangles[j];
            if (contains(t, s[0]) || contains(t, s[1]) || contains(t, s[2])) continue;
            bool any = false;
            for (int c = 0; c < 3; ++c) any |= meets(s[c], s[(c + 1) % 3], t) || meets(t[c], t[(c + 1) % 3], s);
            result.triangles += any;
        }
    }
    return result;
}

Soup random_soup(std::size_t triangle_count, float size, unsigned seed, std::uint32_t shared_particles = 0) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(-1, 1), offset(-size, size);
    Soup soup;
    for (std::size_t t = 0; t < triangle_count; ++t) {
        const Vec3 center{place(random), place(random), place(random)};
        Triangle triangle{};
        for (std::uint32_t& corner : triangle) {
            corner = static_cast<std::uint32_t>(soup.positions.size());
            soup.positions.push_back(center + Vec3{offset(random), offset(random), offset(random)});
        }
        soup.triangles.push_back(triangle);
    }
    if (shared_particles > 0) {
        for (Triangle& triangle : soup.triangles) {
            for (std::uint32_t& corner : triangle) corner %= shared_particles;
        }
    }
    return soup;
}

/// A grid of n × n particles over the unit square, placed by `place(u, v)`, first particle `first`.
template <class Place>
void add_grid(Soup& soup, std::uint32_t n, Place&& place) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (std::uint32_t j = 0; j < n; ++j) {
        for (std::uint32_t i = 0; i < n; ++i) {
            soup.positions.push_back(place(float(i) / float(n - 1), float(j) / float(n - 1)));
        }
    }
    for (std::uint32_t j = 0; j + 1 < n; ++j) {
        for (std::uint32_t i = 0; i + 1 < n; ++i) {
            const std::uint32_t a = first + j * n + i, b = a + 1, c = a + n, d = c + 1;
            soup.triangles.push_back({a, c, b});
            soup.triangles.push_back({b, c, d});
        }
    }
}

void expect_same(const Crossings& actual, const Crossings& expected) {
    EXPECT_EQ(actual.triangles, expected.triangles);
    EXPECT_EQ(actual.edges, expected.edges);
}

// Two triangles that pass through each other: two edges of the second pass through the first.
Soup two_triangles() {
    return {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1.2f, 1, 1}, {1, 1.3f, 1}}, {{0, 1, 2}, {3, 4, 5}}};
}

TEST(Crossings, TwoTrianglesAreOnePair) {
    expect_same(count(two_triangles()), {.triangles = 1, .edges = 2});
}

TEST(Crossings, InterlockedTrianglesCountOneEdgeEach) {
    const Soup soup{{{0, -2, 0}, {0, 2, 0}, {3, 0, 0}, {-1, 0, 0.1f}, {1, 0, -2}, {1, 0, 2}}, {{0, 1, 2}, {3, 4, 5}}};
    const Crossings crossings = count(soup);
    EXPECT_EQ(crossings.triangles, 1u);
    expect_same(crossings, brute_force(soup));
}

TEST(Crossings, WindingAndOrderDoNotMatter) {
    for (const Triangle& first : {Triangle{0, 1, 2}, Triangle{0, 2, 1}, Triangle{2, 0, 1}}) {
        for (const Triangle& second : {Triangle{3, 4, 5}, Triangle{5, 4, 3}, Triangle{4, 5, 3}}) {
            Soup soup = two_triangles();
            soup.triangles = {first, second};
            expect_same(count(soup), {.triangles = 1, .edges = 2});
            std::swap(soup.triangles[0], soup.triangles[1]);
            expect_same(count(soup), {.triangles = 1, .edges = 2});
        }
    }
}

TEST(Crossings, ApartIsNone) {
    Soup soup = two_triangles();
    for (int i = 3; i < 6; ++i) soup.positions[i].z += 1.01f;
    expect_same(count(soup), {});
    expect_same(count({}), {});
}

TEST(Crossings, NeighborsNeverCount) {
    // Shared edge, folded flat onto each other and beyond; shared particle, with overlapping boxes.
    const Soup shared_edge{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2f, 0.9f, 1e-4f}}, {{0, 1, 2}, {1, 0, 3}}};
    expect_same(count(shared_edge), {});
    const Soup shared_particle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}, {1, 1, 2}}, {{0, 1, 2}, {0, 3, 4}}};
    expect_same(count(shared_particle), {});
}

TEST(Crossings, EdgeThroughATriangleAtTheFarSideOfASharedParticle) {
    // The triangles share particle 0, so they are no pair, but edge 3-4 shares nothing with the triangle it pierces.
    const Soup soup{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}}, {{0, 1, 2}, {0, 3, 4}}};
    expect_same(count(soup), {.triangles = 0, .edges = 1});
}

TEST(Crossings, SharedEdgeOfTwoTrianglesCountsOnce) {
    Soup soup = two_triangles();
    soup.positions.push_back({9, 9, 1});
    soup.triangles.push_back({4, 3, 6});  // edge 3-4 pierces the first triangle and now has two triangles
    expect_same(count(soup), brute_force(soup));
    EXPECT_EQ(count(soup).triangles, 2u);
    EXPECT_EQ(count(soup).edges, 3u);
}

TEST(Crossings, RandomSoupsMatchBruteForce) {
    std::uint64_t found = 0;
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Soup soup = random_soup(200, 0.1f + 0.04f * float(seed), seed);
        expect_same(count(soup), brute_force(soup));
        found += count(soup).triangles;
    }
    EXPECT_GT(found, 1000u);
}

TEST(Crossings, SoupsThatShareParticlesMatchBruteForce) {
    for (unsigned seed = 0; seed < 10; ++seed) {
        Soup soup = random_soup(150, 0.8f, 100 + seed, 90);
        std::erase_if(soup.triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[0] == t[2]; });
        expect_same(count(soup), brute_force(soup));
        EXPECT_GT(count(soup).edges, 100u);
    }
}

TEST(Crossings, FoldedGridThatPassesThroughItselfMatchesBruteForce) {
    Soup soup;
    add_grid(soup, 18, [](float u, float v) {
        const float angle = 5.1f * u;  // a strip rolled up past a full turn, its end slanting through its beginning
        return Vec3{std::cos(angle), std::sin(angle), v + 0.3f * u * u} * (1 + 0.3f * std::sin(9 * u + 4 * v));
    });
    add_grid(soup, 15, [](float u, float v) { return Vec3{2 * u - 1, 2 * v - 0.9f, 0.37f + 0.11f * u * v}; });
    expect_same(count(soup), brute_force(soup));
    EXPECT_GT(count(soup).triangles, 30u);
}

TEST(Crossings, FoldWithAGapIsNone) {
    Soup soup;
    add_grid(soup, 30, [](float u, float v) {
        const float angle = 3.14159265f * std::clamp((u - 0.4f) / 0.2f, 0.f, 1.f);
        const float along = u < 0.4f ? u : u > 0.6f ? 1 - u : 0.4f + 0.02f * std::sin(angle);
        return Vec3{along, 0.02f * (1 - std::cos(angle)), v};
    });
    expect_same(count(soup), {});
}

TEST(Crossings, SheetThroughASheetAtItsOwnParticles) {
    // Every crossing is exactly at a particle or an edge of the other sheet; a line of them must not vanish.
    Soup soup;
    add_grid(soup, 9, [](float u, float v) { return Vec3{u, 0, v}; });
    add_grid(soup, 9, [](float u, float v) { return Vec3{u, v - 0.5f, 0.5f}; });
    EXPECT_GE(count(soup).triangles, 8u);
    EXPECT_GE(count(soup).edges, 8u);
}

TEST(Crossings, EdgeThroughASharedEdgeMeetsExactlyOneTriangle) {
    // Edge 4-5 pierces a square exactly at its diagonal; the square's own border pierces the triangle 4-5-6 once.
    Soup soup{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5f, 0.5f, -1}, {0.5f, 0.5f, 1}, {3, 4, 1}}, {}};
    for (const Triangle& lower : {Triangle{0, 1, 2}, Triangle{1, 2, 0}}) {
        for (const Triangle& upper : {Triangle{0, 2, 3}, Triangle{3, 0, 2}}) {
            for (const Triangle& needle : {Triangle{4, 5, 6}, Triangle{5, 4, 6}, Triangle{6, 5, 4}}) {
                soup.triangles = {lower, upper, needle};
                EXPECT_EQ(count(soup).edges, 2u);
            }
        }
    }
}

TEST(Crossings, CoplanarOverlapIsNoCrossing) {
    Soup soup;
    add_grid(soup, 6, [](float u, float v) { return Vec3{u, 0.25f, v}; });
    add_grid(soup, 7, [](float u, float v) { return Vec3{v + 0.1f, 0.25f, u - 0.2f}; });
    expect_same(count(soup), {});
}

TEST(Crossings, DegenerateTrianglesCrossNothing) {
    const Soup whole = two_triangles();
    ASSERT_EQ(count(whole).triangles, 1u);
    Soup two_corners_in_one_place = whole;
    two_corners_in_one_place.positions[5] = whole.positions[4];
    expect_same(count(two_corners_in_one_place), {});
    Soup one_corner_twice = whole;
    one_corner_twice.triangles[1] = {3, 4, 4};
    expect_same(count(one_corner_twice), {});
    Soup corners_in_line = whole;
    for (int i = 3; i < 6; ++i) corners_in_line.positions[i] = {1, 1, -1 + 1.5f * float(i - 3)};
    expect_same(count(corners_in_line), {});
}

TEST(Crossings, NonFinitePositionsCrossNothing) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    for (float bad : {nan, infinity, -infinity}) {
        Soup soup = two_triangles();
        soup.positions.insert(soup.positions.end(), {{0, 0, 0.5f}, {4, 0, 0.5f}, {0, 4, 0.5f}});
        soup.triangles.push_back({6, 7, 8});
        EXPECT_EQ(count(soup).triangles, 2u);
        soup.positions[7].y = bad;
        EXPECT_EQ(count(soup).triangles, 1u) << bad;
    }
}

TEST(Crossings, FarFromTheOriginStillRight) {
    Soup soup = two_triangles();
    soup.positions[4].x = 1.25f;  // all coordinates multiples of 1/16, so that moving them is exact
    soup.positions[5].y = 1.25f;
    const Crossings here = count(soup);
    for (Vec3& p : soup.positions) p += Vec3{65536, -32768, 131072};
    expect_same(count(soup), here);
    EXPECT_EQ(here.triangles, 1u);
}

// A hundred times the usual time, so that sanitizers and busy machines pass; testing all pairs would take minutes.
TEST(Crossings, CrumpledClothOf70000TrianglesIsFast) {
    Soup soup;
    add_grid(soup, 188, [](float u, float v) {
        const float fold = std::abs(std::fmod(12 * u, 2.f) - 1) / 12 + 0.004f * std::sin(40 * v);
        return Vec3{fold, 0.02f * u + 0.003f * std::sin(90 * u + 31 * v), v + 0.01f * std::sin(70 * u)};
    });
    ASSERT_GT(soup.triangles.size(), 69000u);
    const auto start = std::chrono::steady_clock::now();
    const Crossings crossings = count(soup);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    EXPECT_GT(crossings.triangles, 1000u);
    EXPECT_LT(time.count(), 10.0);
    RecordProperty("milliseconds", static_cast<int>(1000 * time.count()));
    RecordProperty("triangles", static_cast<int>(crossings.triangles));
}

}  // namespace
}  // namespace weft
