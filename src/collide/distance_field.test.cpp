// The field as the kernel reads it, against the mesh itself.
#include "collide/distance_field.h"

#include "base/hash.h"
#include "collide/closest_point.h"
#include "collide/field_reading.test.h"
#include "collide/winding_number.h"
#include "mesh/procedural.h"
#include "mesh/testing.h"
#include "physics/testing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

namespace weft {
namespace {

void append_mesh(TriangleMesh& to, const TriangleMesh& from, Vec3 offset) {
    const auto first = static_cast<std::uint32_t>(to.positions.size());
    for (const Vec3 p : from.positions) to.positions.push_back(p + offset);
    for (const auto& [a, b, c] : from.triangles) to.triangles.push_back({a + first, b + first, c + first});
}

TriangleMesh inside_out(TriangleMesh mesh) {
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

// A sphere without the triangles above `height`.
TriangleMesh bowl(float height) {
    TriangleMesh mesh = make_sphere(1, 4);
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        return mesh.positions[t[0]].y + mesh.positions[t[1]].y + mesh.positions[t[2]].y > 3 * height;
    });
    return mesh;
}

std::string error_of(const TriangleMesh& mesh, const DistanceFieldOptions& options = {}) {
    const auto field = build_distance_field(mesh.positions, mesh.triangles, options);
    return field.ok() ? "" : field.error().message();
}

// Up to `reach` from the surface.
Vec3 point_near_surface(const TriangleMesh& mesh, FieldRandom& random, double reach) {
    const Triangle& t = mesh.triangles[random.index(static_cast<std::uint32_t>(mesh.triangles.size()))];
    auto u = static_cast<float>(random.number(0, 1)), v = static_cast<float>(random.number(0, 1));
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
    return a + (b - a) * u + (c - a) * v + random_direction(random) * static_cast<float>(random.number(0, reach));
}

struct FieldErrors {
    double mean = 0, largest = 0;
    void add(double error, int of) { mean += error / of, largest = std::max(largest, error); }
};

constexpr int compared_points = 4000;

double true_distance(const SurfaceSearch& search, const TriangleMesh& mesh, const WindingNumber& winding, Vec3 p) {
    const double distance = search.closest(p).distance;
    return std::abs(winding.at(p)) > 0.5 ? -distance : distance;
}

// In cells, at points within one cell of the surface.
FieldErrors errors_of(const DistanceField& field, const TriangleMesh& mesh) {
    const SurfaceSearch search(mesh.positions, mesh.triangles);
    const WindingNumber winding(mesh.positions, mesh.triangles);
    FieldRandom random(11);
    FieldErrors errors;
    for (int i = 0; i < compared_points; ++i) {
        const Vec3 p = point_near_surface(mesh, random, double{field.cell});
        const double expected = true_distance(search, mesh, winding, p);
        errors.add(std::abs(double{read(field, p).distance} - expected) / double{field.cell}, compared_points);
    }
    return errors;
}

// The alternative: a grid that stores for each cell the vector from its center to the closest point of the surface.
// Errors are in units of `unit`, at the same points as above.
struct VectorErrors {
    FieldErrors stored;  ///< if the vector of the cell is taken as that of the point
    FieldErrors plane;   ///< if the distance is that to the plane through the closest point, across the vector
};
VectorErrors errors_of_grid_of_vectors(const TriangleMesh& mesh, Vec3 origin, double cell, double unit) {
    const SurfaceSearch search(mesh.positions, mesh.triangles);
    const WindingNumber winding(mesh.positions, mesh.triangles);
    FieldRandom random(11);
    VectorErrors errors;
    for (int i = 0; i < compared_points; ++i) {
        const Vec3 p = point_near_surface(mesh, random, unit);
        const auto center = [&](float x, float from) {
            return static_cast<float>(from + (std::floor((x - from) / cell) + 0.5) * cell);
        };
        const Vec3 c{center(p.x, origin.x), center(p.y, origin.y), center(p.z, origin.z)};
        const SurfacePoint closest = search.closest(c);
        Vec3 on{};
        for (std::size_t k = 0; k < 3; ++k) {
            on += mesh.positions[mesh.triangles[closest.triangle][k]] * static_cast<float>(closest.weights[k]);
        }
        const double sign = std::abs(winding.at(c)) > 0.5 ? -1 : 1;
        const double expected = true_distance(search, mesh, winding, p);
        errors.stored.add(std::abs(sign * closest.distance - expected) / unit, compared_points);
        const double along = double{dot(p - on, normalized(c - on))};
        errors.plane.add(std::abs(sign * along - expected) / unit, compared_points);
    }
    return errors;
}

// Labels: slow no-asan
TEST(DistanceField, is_close_to_the_distance_to_the_mesh) {
    struct Case {
        const char* name;
        TriangleMesh mesh;
        std::uint32_t cells;
    };
    std::vector<Case> cases{{"sphere", make_sphere(0.5f, 5), 48}, {"box", make_box({0.6f, 0.4f, 0.5f}, {7, 5, 6}), 48}};
    if (std::ifstream(bunny_file)) cases.push_back({"bunny", read_bunny(), 96});
    for (const auto& [name, mesh, cells] : cases) {
        const DistanceField field = field_of(mesh, cells, 2);
        const FieldErrors errors = errors_of(field, mesh);
        EXPECT_LT(errors.mean, 0.05) << name;
        EXPECT_LT(errors.largest, 0.8) << name;  // at a sharp corner
        EXPECT_TRUE(field.closed && field.has_inside) << name;

        // Grids of vectors of the same memory: a dense one, and one with bricks as here.
        const double unit = double{field.cell}, volume = 512.0 * field.places[0] * field.places[1] * field.places[2];
        const double dense = std::cbrt(volume * 12 / double(field.bytes())), bricks = std::sqrt(12.0 / 16);
        const Vec3 origin = field.data.bounds.min;
        const VectorErrors of_dense = errors_of_grid_of_vectors(mesh, origin, dense * unit, unit);
        const VectorErrors of_bricks = errors_of_grid_of_vectors(mesh, origin, bricks * unit, unit);
        EXPECT_LT(errors.mean, of_dense.stored.mean) << name;
        EXPECT_LT(errors.largest, of_dense.plane.largest) << name;
        std::printf("%s, %u cells, %.2f MB: mean and largest error in cells\n", name, cells,
                    double(field.bytes()) / 1e6);
        std::printf("    distances               %.4f %.3f\n", errors.mean, errors.largest);
        const auto print = [](const char* what, double size, const VectorErrors& e) {
            std::printf("    %s, cells %.2f times as large: vectors as stored %.4f %.3f, planes %.4f %.3f\n", what,
                        size, e.stored.mean, e.stored.largest, e.plane.mean, e.plane.largest);
        };
        print("dense grid of vectors", dense, of_dense);
        print("bricks of vectors", bricks, of_bricks);
    }
}

TEST(DistanceField, has_the_right_size_and_sign_everywhere) {
    const DistanceField field = field_of(make_sphere(1, 4), 96);
    ASSERT_LT(field.bricks, field.places[0] * field.places[1] * field.places[2]);
    int wrong = 0;
    FieldRandom random(3);
    for (int i = 0; i < 5000; ++i) {
        const double radius = random.number(0, 4), expected = radius - 1;
        const auto [distance, normal] = read(field, random_direction(random) * static_cast<float>(radius));
        // Deep inside, cells are a sixth of the radius in size; far outside the distance is a lower bound.
        const double tolerance = radius < 0.75 ? 0.15 : radius < 1.05 ? 0.01 : 0.35 * expected + 0.01;
        const bool right = std::abs(double{distance} - expected) <= tolerance &&
                           double{distance} - expected <= (radius < 0.75 ? tolerance : 0.01) &&
                           (std::abs(expected) < 0.01 || (distance < 0) == (expected < 0)) &&
                           std::abs(length(normal) - 1) < 1e-5f;
        if (!right && ++wrong < 5) ADD_FAILURE() << distance << " instead of " << expected;
    }
    EXPECT_EQ(wrong, 0);
    const auto at_center = read(field, {0, 0, 0});
    EXPECT_NEAR(at_center.distance, -1, 0.15);
    EXPECT_NEAR(length(at_center.normal), 1, 1e-5);
}

// Interpolation alone leaves 99 of 100 points of the bunny at most 0.09 cells outside.
// Labels: slow no-asan
TEST(DistanceField, covers_its_mesh) {
    if (!std::ifstream(bunny_file)) GTEST_SKIP() << bunny_file << " is missing";
    const TriangleMesh mesh = read_bunny();
    const DistanceField field = field_of(mesh, 96);
    FieldRandom random(3);
    std::vector<double> outside;
    for (int i = 0; i < 20000; ++i)
        outside.push_back(double{read(field, point_near_surface(mesh, random, 0)).distance} / double{field.cell});
    std::sort(outside.begin(), outside.end());
    EXPECT_LT(outside[19800], 0.03) << "99 of 100";
    EXPECT_LT(outside.back(), 0.25);
}

// Fields are kept on disk by their mesh and distance_field_version.
TEST(DistanceField, has_a_new_version_when_it_changes) {
    TriangleMesh mesh = make_sphere(0.3f, 3);
    append_mesh(mesh, make_box({0.3f, 0.5f, 0.4f}, {3, 5, 4}), {0.9f, 0.1f, 0});
    const DistanceField field = field_of(mesh, 40);
    StateHash hash;
    for (const float word : field.data.words) hash.add(word);
    hash.add(field.data.steepness);
    EXPECT_EQ(distance_field_version, 3u);
    EXPECT_EQ(hash.text(), "882ae4deca4e1a8e") << "raise distance_field_version, then write both numbers here";
}

TEST(DistanceField, is_finite_beyond_the_grid) {
    const DistanceField field = field_of(make_box({1, 1, 1}, {2, 2, 2}), 16);
    for (const float x : {-1e6f, -3.0f, 0.0f, 2.0f, 1e6f}) {
        for (const float y : {-1e6f, 0.1f, 5.0f}) {
            for (const float z : {-40.0f, 0.2f, 1e6f}) {
                const auto [distance, normal] = read(field, {x, y, z});
                EXPECT_TRUE(std::isfinite(distance));
                EXPECT_NEAR(length(normal), 1, 1e-5);
            }
        }
    }
    // The corners of the grid itself.
    const float side = 8 * field.cell;
    for (int k = 0; k < 8; ++k) {
        const Vec3 low{field.data.words[0], field.data.words[1], field.data.words[2]};
        const Vec3 corner = low + Vec3{k & 1 ? side * static_cast<float>(field.places[0]) : 0,
                                       k & 2 ? side * static_cast<float>(field.places[1]) : 0,
                                       k & 4 ? side * static_cast<float>(field.places[2]) : 0};
        EXPECT_GT(read(field, corner).distance, 0);
        EXPECT_NEAR(read(field, corner).distance, read(field, corner * 1.0001f).distance, 0.01);
    }
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(read(field, {nan, 0, 0}).distance < 0);  // reads valid memory and makes no contact
}

// The normal is the gradient of the value, in cells, places without cells and beyond the grid.
TEST(DistanceField, normals_are_gradients) {
    const DistanceField field = field_of(make_sphere(1, 3), 96);
    const reference::ShapeNumbers numbers{0, 0, 0, 0, field.data.blocks()};
    FieldRandom random(5);
    int compared = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto p = random.vector(1.6);
        reference::vec3 normal, unused;
        reference::distance_mesh(p, numbers, normal);
        const double step = 1e-7;
        const auto slope = [&](reference::vec3 d) {
            return (reference::distance_mesh(p + d * step, numbers, unused) -
                    reference::distance_mesh(p - d * step, numbers, unused)) /
                   (2 * step);
        };
        const reference::vec3 gradient(slope({1, 0, 0}), slope({0, 1, 0}), slope({0, 0, 1}));
        const double size = testing_kernels::norm(gradient);
        if (size < 0.1 || size > 2) continue;  // a jump between places, or the center
        ++compared;
        EXPECT_LT(testing_kernels::norm(gradient * (1 / size) - normal), 1e-4) << i;
    }
    EXPECT_GT(compared, 1900);
}

// Labels: slow no-asan
TEST(DistanceField, does_not_depend_on_the_number_of_threads) {
    TriangleMesh mesh = bowl(0.8f);
    append_mesh(mesh, make_box({1.5f, 0.02f, 0.5f}, {3, 2, 2}), {0.2f, -0.9f, 0.3f});
    const DistanceField one = field_of(mesh, 40, 1);
    for (const unsigned threads : {2u, 3u, 7u}) {
        const DistanceField more = field_of(mesh, 40, threads);
        ASSERT_EQ(one.data.words.size(), more.data.words.size());
        EXPECT_EQ(std::memcmp(one.data.words.data(), more.data.words.data(), one.bytes()), 0);
        EXPECT_EQ(one.thin.thin, more.thin.thin);
        EXPECT_EQ(one.thin.place, more.thin.place);
    }
}

TEST(DistanceField, takes_overlapping_parts_as_one_solid) {
    TriangleMesh mesh;
    append_mesh(mesh, make_sphere(1, 4), {-0.6f, 0, 0});
    append_mesh(mesh, make_sphere(1, 4), {0.6f, 0, 0});
    const DistanceField field = field_of(mesh, 64);
    for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{0.35f, 0, 0}, Vec3{-1.4f, 0, 0}, Vec3{0, 0.7f, 0}, Vec3{1.5f, 0, 0}}) {
        EXPECT_LT(read(field, p).distance, 0) << p.x;
    }
    for (const Vec3 p : {Vec3{0, 0.9f, 0}, Vec3{-1.7f, 0, 0}}) EXPECT_GT(read(field, p).distance, 0) << p.x;
}

TEST(DistanceField, does_not_depend_on_which_way_triangles_face) {
    const TriangleMesh sphere = make_sphere(1, 3);
    const DistanceField plain = field_of(sphere);
    TriangleMesh mixed = sphere;
    for (std::size_t t = 0; t < mixed.triangles.size(); t += 3) std::swap(mixed.triangles[t][1], mixed.triangles[t][2]);
    const DistanceField turned = field_of(inside_out(sphere)), repaired = field_of(mixed);
    EXPECT_EQ(plain.flipped, 0u);
    EXPECT_EQ(turned.flipped, 0u);
    EXPECT_EQ(repaired.flipped, (sphere.triangles.size() + 2) / 3);
    EXPECT_TRUE(repaired.closed);
    EXPECT_EQ(std::memcmp(plain.data.words.data(), turned.data.words.data(), plain.bytes()), 0);
    EXPECT_EQ(std::memcmp(plain.data.words.data(), repaired.data.words.data(), plain.bytes()), 0);

    // Parts that face opposite ways, apart: both are solid.
    TriangleMesh two;
    append_mesh(two, sphere, {-1.5f, 0, 0});
    append_mesh(two, inside_out(sphere), {1.5f, 0, 0});
    const DistanceField both = field_of(two);
    EXPECT_LT(read(both, {-1.5f, 0, 0}).distance, -0.8f);
    EXPECT_LT(read(both, {1.5f, 0, 0}).distance, -0.8f);

    // One inside the other: a cavity.
    TriangleMesh hollow = sphere, inner = inside_out(make_sphere(0.5f, 4));
    append_mesh(hollow, inner, {});
    const DistanceField shell = field_of(hollow);
    EXPECT_GT(read(shell, {0, 0, 0}).distance, 0.1f);
    EXPECT_LT(read(shell, {0, 0.75f, 0}).distance, -0.2f);
}

TEST(DistanceField, closes_holes) {
    const TriangleMesh mesh = bowl(0.95f);  // the hole is 0.6 m wide
    const DistanceField field = field_of(mesh, 64);
    EXPECT_FALSE(field.closed);
    EXPECT_TRUE(field.has_inside);
    for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{0, 0.85f, 0}, Vec3{0.9f, 0, 0}})
        EXPECT_LT(read(field, p).distance, 0) << p.y;
    for (const Vec3 p : {Vec3{0, 1.15f, 0}, Vec3{0, 3, 0}}) EXPECT_GT(read(field, p).distance, 0) << p.y;
}

// Across a hole 16 cells wide, the value passes through zero as it does at the surface.
TEST(DistanceField, is_continuous_across_holes) {
    const DistanceField field = field_of(bowl(0.87f), 64);
    for (const float x : {0.0f, 0.15f, -0.3f}) {
        const float step = 0.1f * field.cell;
        float before = read(field, {x, 0.3f, 0.1f}).distance;
        int crossings = 0;
        for (float y = 0.3f + step; y < 1.3f; y += step) {
            const auto [distance, normal] = read(field, {x, y, 0.1f});
            EXPECT_LT(std::abs(distance - before), 3 * step) << y;
            if (distance > 0 && before <= 0) {
                ++crossings;
                EXPECT_GT(normal.y, 0.7f);
            }
            before = distance;
        }
        EXPECT_EQ(crossings, 1);
    }
}

// Half a shell is solid up to the surface of winding number one half, which is near the plane of the opening.
TEST(DistanceField, fills_half_a_shell) {
    const DistanceField field = field_of(bowl(0), 64);
    for (const Vec3 p : {Vec3{0, -0.2f, 0}, Vec3{0, -0.9f, 0}, Vec3{0.6f, -0.3f, 0}}) {
        EXPECT_LT(read(field, p).distance, 0) << p.y;
    }
    for (const Vec3 p : {Vec3{0, 0.2f, 0}, Vec3{0, -1.1f, 0}, Vec3{0, 0.9f, 0}, Vec3{1.2f, 0, 0}}) {
        EXPECT_GT(read(field, p).distance, 0) << p.y;
    }
}

// Above, beside and behind a bumpy sheet of 1 m that faces up: the nearest point of the surface lies straight below or
// above, about.
TEST(DistanceField, of_a_sheet_is_solid_behind_it) {
    TriangleMesh sheet = make_grid({1, 1}, {33, 33}, GridDiagonal::alternating);
    const auto height = [](float x, float z) { return 0.03f * std::sin(9 * x) * std::cos(7 * z); };
    for (Vec3& p : sheet.positions) p.y = height(p.x, p.z);
    for (const std::uint32_t cells : {24u, 64u}) {
        const DistanceField field = field_of(sheet, cells);
        EXPECT_TRUE(field.is_sheet && field.has_inside && !field.closed);
        const float thickness = 2 * field.cell;
        std::mt19937 random(1);
        std::uniform_real_distribution<float> place(-0.35f, 0.35f), above(-3 * field.cell, 2 * field.cell);
        for (int i = 0; i < 2000; ++i) {
            const float x = place(random), z = place(random), y = above(random);
            const double distance = read(field, {x, height(x, z) + y, z}).distance;
            const float expected = y > 0 ? y : y > -thickness ? -std::min(-y, thickness + y) : -thickness - y;
            // Trilinear values are not as deep as the middle of the solid, one cell below the surface.
            const double tolerance = 0.2 * double{std::abs(expected)} + (y > 0 ? 0.25 : 0.6) * double{field.cell};
            EXPECT_NEAR(distance, double{expected}, tolerance) << y;
            if (std::abs(expected) > 0.2f * field.cell) {
                EXPECT_EQ(distance < 0, expected < 0) << y;
            }
        }
        for (int i = 0; i < 500; ++i) {  // beside it there is nothing
            const Vec3 beside{0.5f + 1.5f * field.cell + std::abs(place(random)), 2 * place(random), place(random)};
            EXPECT_GT(read(field, beside).distance, 0);
        }
    }
    TriangleMesh turned = sheet;
    for (Triangle& t : turned.triangles) std::swap(t[1], t[2]);
    const DistanceField field = field_of(turned, 24);
    EXPECT_LT(read(field, {0, 0.5f * field.cell, 0}).distance, 0) << "solid on the other side";
    EXPECT_GT(read(field, {0, -0.5f * field.cell, 0}).distance, 0);
    TriangleMesh triangle;
    testing_meshes::add_triangle(triangle, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    EXPECT_TRUE(field_of(triangle, DistanceFieldOptions::fewest_cells).is_sheet);
}

// Ground with stones on it, which are closed: both are solid.
TEST(DistanceField, of_a_sheet_and_closed_parts_has_both) {
    TriangleMesh ground = make_grid({2, 2}, {17, 17}, GridDiagonal::alternating);
    append_mesh(ground, make_sphere(0.3f, 3), {0.2f, 0.1f, 0});
    const DistanceField field = field_of(ground, 48);
    EXPECT_TRUE(field.is_sheet);
    for (const Vec3 p : {Vec3{-0.5f, -0.04f, 0.3f}, Vec3{0.2f, 0.36f, 0}, Vec3{0.45f, 0.15f, 0}})
        EXPECT_LT(read(field, p).distance, 0) << p.x;
    for (const Vec3 p : {Vec3{-0.5f, 0.04f, 0.3f}, Vec3{0.2f, 0.44f, 0}, Vec3{0.6f, 0.15f, 0}})
        EXPECT_GT(read(field, p).distance, 0) << p.x;
}

TEST(DistanceField, names_parts_that_are_too_thin) {
    const DistanceField ball = field_of(make_sphere(1, 4));
    EXPECT_GT(ball.thin.samples, 1000u);
    EXPECT_EQ(ball.thin.thin, 0u);
    EXPECT_EQ(field_of(make_box({1, 1, 1}, {3, 3, 3})).thin.thin, 0u) << "sharp edges are not thin";

    // Plates around the limit of two cells, which are 1/48 m.
    EXPECT_EQ(field_of(make_box({1, 2.1f / 48, 1}, {9, 2, 9})).thin.thin, 0u);
    const DistanceField plate = field_of(make_box({1, 1.7f / 48, 1}, {9, 2, 9}));
    EXPECT_GT(plate.thin.thin, plate.thin.samples * 9 / 10);
    EXPECT_NEAR(plate.thin.least_thickness, 1.7 / 48, 1e-3);

    // A fin on a ball, which overlap; and a gap between two boxes, which is not solid.
    TriangleMesh fin = make_sphere(0.5f, 4);
    append_mesh(fin, make_box({0.2f, 0.6f, 0.01f}, {3, 7, 2}), {0, 0.6f, 0});
    const DistanceField finned = field_of(fin);
    EXPECT_GT(finned.thin.thin, 50u);
    EXPECT_GT(finned.thin.place.y, 0.45f);
    EXPECT_NEAR(finned.thin.least_thickness, 0.01, 1e-4);
    TriangleMesh gap = make_box({1, 0.3f, 1}, {3, 3, 3});
    append_mesh(gap, make_box({1, 0.3f, 1}, {3, 3, 3}), {0, 0.32f, 0});
    EXPECT_EQ(field_of(gap).thin.thin, 0u);
}

TEST(DistanceField, refuses_malformed_meshes) {
    EXPECT_EQ(error_of({}), "the mesh has no triangles");
    TriangleMesh mesh = make_box({1, 1, 1}, {2, 2, 2});
    mesh.positions[5].y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(error_of(mesh), "vertex 5: the position is not finite");
    mesh.positions[5].y = std::numeric_limits<float>::infinity();
    EXPECT_EQ(error_of(mesh), "vertex 5: the position is not finite");
    mesh = make_box({1, 1, 1}, {2, 2, 2});
    mesh.triangles[3][1] = 99;
    EXPECT_EQ(error_of(mesh), "triangle 3: has vertex 99, but there are 8 vertices");
    mesh = make_box({1, 1, 1}, {2, 2, 2});
    for (Vec3& p : mesh.positions) p = {1, 2, 3};
    EXPECT_EQ(error_of(mesh), "no triangle of the mesh has an area");
    mesh = make_box({1, 1, 1}, {2, 2, 2});
    EXPECT_EQ(error_of(mesh, {.cells = 3}), "cells must be from 4 to 1024, got 3");
    EXPECT_EQ(error_of(mesh, {.cells = 1025}), "cells must be from 4 to 1024, got 1025");
    for (Vec3& p : mesh.positions) p = p * 1e-8f;
    EXPECT_EQ(error_of(mesh), "the mesh is 1e-08 m long; it must be from 1e-06 m to 1e+06 m");
    for (Vec3& p : mesh.positions) p = p * 1e38f;
    EXPECT_EQ(error_of(mesh), "the mesh is 1e+30 m long; it must be from 1e-06 m to 1e+06 m");
    mesh = make_box({1, 1, 1}, {2, 2, 2});
    for (Vec3& p : mesh.positions) p += Vec3{1e5f, 0, 0};
    EXPECT_NE(error_of(mesh).find("too far for floats"), std::string::npos) << error_of(mesh);
}

TEST(DistanceField, refuses_fields_that_are_too_large) {
    const TriangleMesh mesh = make_box({1, 1, 1}, {2, 2, 2});
    EXPECT_EQ(error_of(mesh, {.cells = 1024}).substr(0, 45), "the distance field of 1024 cells needs 809 Mi");
    EXPECT_NE(error_of(mesh, {.cells = 1024}).find("256 MiB are allowed; use at most about"), std::string::npos);
    const std::string less = error_of(mesh, {.cells = 96, .largest_bytes = 1 << 20});
    EXPECT_NE(less.find("or allow more memory"), std::string::npos) << less;
}

TEST(DistanceField, leaves_out_triangles_without_an_area) {
    TriangleMesh mesh = make_sphere(1, 3);
    const DistanceField plain = field_of(mesh);
    mesh.triangles.push_back({0, 0, 0});
    mesh.triangles.push_back({5, 7, 5});
    testing_meshes::add_triangle(mesh, {4, 0, 0}, {5, 0, 0}, {6, 0, 0});  // far away: not part of the bounds
    const DistanceField field = field_of(mesh);
    EXPECT_EQ(field.zero_area, 3u);
    EXPECT_EQ(field.data.bounds, plain.data.bounds);
    EXPECT_EQ(field.bricks, plain.bricks);
}

TEST(DistanceField, survives_degenerate_meshes) {
    for (const TriangleMesh& mesh :
         {testing_meshes::fan(2000), testing_meshes::book(9, 5), testing_meshes::pieces(40)}) {
        const DistanceField field = field_of(mesh, 32);
        FieldRandom random(2);
        for (int i = 0; i < 200; ++i) {
            const auto p = random.vector(2);
            const Vec3 at{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
            EXPECT_TRUE(std::isfinite(read(field, at).distance));
        }
    }
}

}  // namespace
}  // namespace weft
