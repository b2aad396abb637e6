#include "collide/solid_surface.h"

#include "collide/closest_point.h"
#include "mesh/procedural.h"
#include "mesh/testing.h"
#include "physics/testing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace weft {
namespace {

Vec3 in_floats(reference::vec3 v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// A sphere with a hole, every third triangle of which faces inward.
TriangleMesh open_sphere_with_flips() {
    TriangleMesh mesh = make_sphere(10, 4);
    std::erase_if(mesh.triangles, [&](const Triangle& t) { return mesh.positions[t[0]].y > 8; });
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
    return mesh;
}

TEST(OrientTriangles, turns_the_smaller_area_of_each_part) {
    TriangleMesh mesh = make_box({1, 1, 1}, {4, 4, 4});
    EXPECT_EQ(orient_triangles(mesh.positions, mesh.triangles).flipped, 0u);
    const auto original = mesh.triangles;
    std::swap(mesh.triangles[7][1], mesh.triangles[7][2]);
    const OrientedTriangles repaired = orient_triangles(mesh.positions, mesh.triangles);
    EXPECT_EQ(repaired.flipped, 1u);
    EXPECT_TRUE(repaired.boundary.empty());
    EXPECT_EQ(exact_winding_number({0, 0, 0}, mesh.positions, original),
              exact_winding_number({0, 0, 0}, mesh.positions, repaired.triangles));
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);  // all but one now face inward
    EXPECT_EQ(orient_triangles(mesh.positions, mesh.triangles).flipped, 1u);
}

TEST(OrientTriangles, joins_vertices_at_the_same_place_and_finds_the_edges_of_holes) {
    const TriangleMesh box = make_box({1, 1, 1}, {2, 2, 2});
    TriangleMesh soup;
    for (const auto& [a, b, c] : box.triangles) {
        testing_meshes::add_triangle(soup, box.positions[a], box.positions[b], box.positions[c]);
    }
    EXPECT_TRUE(orient_triangles(soup.positions, soup.triangles).boundary.empty());
    soup.triangles.pop_back();
    EXPECT_EQ(orient_triangles(soup.positions, soup.triangles).boundary.size(), 3u);
    const TriangleMesh book = testing_meshes::book(3, 4);
    EXPECT_FALSE(orient_triangles(book.positions, book.triangles).boundary.empty());
}

// A strip with half a twist cannot be oriented; it must not hang or fail.
TEST(OrientTriangles, takes_a_moebius_strip) {
    TriangleMesh mesh;
    constexpr std::uint32_t parts = 40;
    for (std::uint32_t i = 0; i < parts; ++i) {
        const double along = 2 * std::numbers::pi * i / parts, twist = along / 2;
        for (const double side : {-0.3, 0.3}) {
            const double r = 1 + side * std::cos(twist);
            mesh.positions.push_back(in_floats({r * std::cos(along), side * std::sin(twist), r * std::sin(along)}));
        }
    }
    for (std::uint32_t i = 0; i < parts; ++i) {
        const bool last = i + 1 == parts;
        const std::uint32_t a = 2 * i, b = 2 * i + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {b, d, c}});
    }
    const OrientedTriangles oriented = orient_triangles(mesh.positions, mesh.triangles);
    EXPECT_EQ(oriented.triangles.size(), 2 * parts);
    EXPECT_GE(oriented.boundary.size(), 2 * parts);
}

TEST(SolidSurface, finds_the_nearest_distance_from_any_guess) {
    TriangleMesh mesh = open_sphere_with_flips();
    testing_meshes::add_triangle(mesh, {12, 0, 0}, {13, 0, 0}, {12.5f, 2e-5f, 0});  // a sliver
    const SurfaceSearch search(mesh.positions, mesh.triangles);
    WorkerTeam team;
    const SolidSurface surface(mesh.positions, orient_triangles(mesh.positions, mesh.triangles), team);
    testing_kernels::Random random(4);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 p = in_floats(random.vector(15));
        const auto guess = i % 3 ? random.index(static_cast<std::uint32_t>(surface.triangles().size())) : none;
        const double expected = search.closest(p).distance;
        EXPECT_NEAR(std::sqrt(surface.nearest(p, guess).squared_distance), expected, 1e-9 * (1 + expected));
    }
}

// On an open surface too: where the walk keeps a winding number, a new one would give the same side.
TEST(SolidSurface, a_walk_gives_the_same_signs_as_winding_numbers) {
    const TriangleMesh mesh = open_sphere_with_flips();
    WorkerTeam team(1);
    const SolidSurface surface(mesh.positions, orient_triangles(mesh.positions, mesh.triangles), team);
    testing_kernels::Random random(9);
    int different = 0, inside = 0, bounded = 0;
    for (int i = 0; i < 200; ++i) {
        const Vec3 center = in_floats(random.vector(11));
        const double bound = surface.winding_gradient_bound(center, 5);
        bounded += std::isfinite(bound);
        SignedDistanceWalk walk(surface, bound);
        Vec3 at = center;
        for (int step = 0; step < 60; ++step) {
            const Vec3 next = at + in_floats(random.vector(0.8));
            if (length(next - center) < 5) at = next;
            // Twice the margin around the limit, within which the tree's error decides.
            const double winding = exact_winding_number(at, surface.positions(), surface.triangles());
            const double distance = walk.distance_at(at);
            if (std::abs(std::abs(winding) - 0.5 - SolidSurface::margin) < SolidSurface::margin) continue;
            different += (distance < 0) != surface.is_inside(winding);
            inside += distance < 0;
        }
    }
    EXPECT_EQ(different, 0);
    EXPECT_GT(inside, 1000);
    EXPECT_GT(bounded, 50);
}

// Inside is what lies behind a sheet, nearer than its thickness.
TEST(SolidSurface, a_walk_around_a_sheet_gives_the_signs_of_winding_numbers_and_distances) {
    TriangleMesh mesh = make_grid({20, 20}, {9, 9}, GridDiagonal::alternating);
    for (Vec3& p : mesh.positions) p.y = std::sin(0.7f * p.x) * std::cos(0.5f * p.z);
    WorkerTeam team(1);
    const SolidSurface surface(mesh.positions, orient_triangles(mesh.positions, mesh.triangles), team);
    ASSERT_TRUE(surface.is_sheet());
    testing_kernels::Random random(11);
    int different = 0, inside = 0;
    for (int i = 0; i < 200; ++i) {
        const Vec3 center = in_floats(random.vector(12));
        SignedDistanceWalk walk(surface, surface.winding_gradient_bound(center, 5));
        Vec3 at = center;
        for (int step = 0; step < 60; ++step) {
            const Vec3 next = at + in_floats(random.vector(0.8));
            if (length(next - center) < 5) at = next;
            const double winding = exact_winding_number(at, surface.positions(), surface.triangles()),
                         size = std::sqrt(surface.nearest(at, none).squared_distance), distance = walk.distance_at(at);
            EXPECT_LE(std::abs(distance), size);
            if (std::abs(winding) < 2 * SolidSurface::margin) continue;
            different += (distance < 0) != (winding > 0 && size < SolidSurface::sheet_thickness);
            inside += distance < 0;
        }
    }
    EXPECT_EQ(different, 0);
    EXPECT_GT(inside, 500);
}

// By how far the surface closes: a flat sheet, caps of a sphere, and a sphere with a small hole.
TEST(SolidSurface, tells_sheets_from_shells) {
    WorkerTeam team;
    const auto is_sheet = [&](const TriangleMesh& mesh) {
        return SolidSurface(mesh.positions, orient_triangles(mesh.positions, mesh.triangles), team).is_sheet();
    };
    const auto cap = [](float lowest) {
        TriangleMesh ball = make_sphere(10, 4);
        std::erase_if(ball.triangles, [&](const Triangle& t) { return ball.positions[t[0]].y < lowest; });
        return ball;
    };
    EXPECT_TRUE(is_sheet(make_grid({10, 10}, {5, 5}, GridDiagonal::uniform)));
    EXPECT_TRUE(is_sheet(cap(7)));
    EXPECT_FALSE(is_sheet(cap(0))) << "half a sphere";
    EXPECT_FALSE(is_sheet(cap(-8)));
    EXPECT_FALSE(is_sheet(make_sphere(10, 3)));
}

// A triangle that touches no triangle of the surface, and in whose neighborhood the winding number cannot reach its
// limit through a hole, is on one side.
TEST(SolidSurface, a_triangle_that_touches_nothing_is_on_one_side) {
    const TriangleMesh mesh = open_sphere_with_flips();
    WorkerTeam team(1);
    const SolidSurface surface(mesh.positions, orient_triangles(mesh.positions, mesh.triangles), team);
    testing_kernels::Random random(5);
    int mixed = 0, on_one_side = 0, across = 0;
    for (int i = 0; i < 2000; ++i) {
        const double size = std::pow(10.0, random.number(-1.0, 0.7));
        const reference::vec3 at = random.vector(11);
        const std::array<Vec3, 3> x{in_floats(at + random.vector(size)), in_floats(at + random.vector(size)),
                                    in_floats(at + random.vector(size))};
        const Vec3 middle = (x[0] + x[1] + x[2]) / 3.0f;
        const double radius = std::max({length(x[0] - middle), length(x[1] - middle), length(x[2] - middle)});
        SignedDistanceWalk walk(surface, surface.winding_gradient_bound(middle, radius));
        const bool inside = walk.distance_at(middle) < 0;
        const bool one_side = walk.keeps_side_within(radius) && !surface.may_touch(x);
        bool differs = false;
        for (int k = 0; k < 30; ++k) {
            const auto u = static_cast<float>(random.number(0, 1)),
                       v = static_cast<float>(random.number(0, 1)) * (1 - u);
            const Vec3 p = x[0] * u + x[1] * v + x[2] * (1 - u - v);
            differs = differs || surface.inside(p) != inside;
        }
        mixed += one_side && differs;
        on_one_side += one_side, across += differs;
    }
    EXPECT_EQ(mixed, 0);
    EXPECT_GT(on_one_side, 1000);
    EXPECT_GT(across, 200);
}

}  // namespace
}  // namespace weft
