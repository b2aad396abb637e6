#include "collide/body_mass.h"

#include "base/transform.h"
#include "collide/convex_hull.h"
#include "collide/distance_field.h"
#include "mesh/procedural.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace weft {
namespace {

constexpr double pi = std::numbers::pi;

BodyMass mass_of(const BodyDesc& body, const ColliderShape& shape, const ShapeData* data = nullptr) {
    const auto made = body_mass_of(body, shape, data);
    EXPECT_TRUE(made.ok()) << (made ? "" : made.error().message());
    return made ? *made : BodyMass{};
}

std::string mass_error(const BodyDesc& body, const ColliderShape& shape, const ShapeData* data = nullptr) {
    const auto made = body_mass_of(body, shape, data);
    return made ? "none" : made.error().message();
}

// Of a closed mesh, without its distance field: mass does not read it.
ShapeData data_of(TriangleMesh mesh) {
    ShapeData data;
    data.bounds = bounds_of(mesh.positions);
    data.surface = std::move(mesh);
    return data;
}

BodyMass mesh_mass(const BodyDesc& body, TriangleMesh mesh) {
    const ShapeData data = data_of(std::move(mesh));
    return mass_of(body, SolidMeshDesc{}, &data);
}

ShapeData hull_data(std::span<const Vec3> points) {
    const auto hull = convex_hull(points);
    EXPECT_TRUE(hull.ok());
    return hull ? make_convex_data(*hull) : ShapeData{};
}

void expect_same(const BodyMass& got, const BodyMass& expected, double tolerance) {
    const double size = *std::max_element(expected.inertia.begin(), expected.inertia.begin() + 3);
    const double length_scale = std::sqrt(size / expected.mass);
    EXPECT_NEAR(got.mass, expected.mass, tolerance * expected.mass);
    EXPECT_NEAR(got.center.x, expected.center.x, tolerance * length_scale);
    EXPECT_NEAR(got.center.y, expected.center.y, tolerance * length_scale);
    EXPECT_NEAR(got.center.z, expected.center.z, tolerance * length_scale);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(got.inertia[i], expected.inertia[i], tolerance * size) << i;
}

// The inverse times the tensor is 1.
void expect_inverse(const BodyMass& mass) {
    const auto matrix = [](const std::array<float, 6>& m) {
        return std::array<std::array<double, 3>, 3>{{{m[0], m[5], m[4]}, {m[5], m[1], m[3]}, {m[4], m[3], m[2]}}};
    };
    const auto a = matrix(mass.inertia), b = matrix(mass.inverse_inertia);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            double sum = 0;
            for (std::size_t k = 0; k < 3; ++k) sum += a[i][k] * b[k][j];
            EXPECT_NEAR(sum, i == j ? 1 : 0, 1e-5);
        }
}

TriangleMesh moved(TriangleMesh mesh, const Pose& pose) {
    for (Vec3& p : mesh.positions) p = to_world(pose, p);
    return mesh;
}

TriangleMesh together(TriangleMesh a, const TriangleMesh& b) {
    const auto first = static_cast<std::uint32_t>(a.positions.size());
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    for (const auto& [i, j, k] : b.triangles) a.triangles.push_back({first + i, first + j, first + k});
    a.normals.clear();
    return a;
}

TriangleMesh with_faces_in(TriangleMesh mesh) {
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

// Around y, closed; `radius_at` is zero at both ends.
template <class Radius>
TriangleMesh revolved(double from, double to, Radius&& radius_at, std::uint32_t steps, std::uint32_t sides) {
    TriangleMesh mesh;
    const auto point = [&](double y, double r, double angle) {
        mesh.positions.push_back(
            {static_cast<float>(r * std::cos(angle)), static_cast<float>(y), static_cast<float>(-r * std::sin(angle))});
    };
    point(from, 0, 0), point(to, 0, 0);
    for (std::uint32_t i = 1; i < steps; ++i) {
        // Close together at the ends, where the radius changes fastest.
        const double y = from + (to - from) * 0.5 * (1 - std::cos(pi * i / steps));
        for (std::uint32_t k = 0; k < sides; ++k) point(y, radius_at(y), 2 * pi * k / sides);
    }
    const auto vertex = [&](std::uint32_t ring, std::uint32_t k) { return 2 + (ring - 1) * sides + k % sides; };
    for (std::uint32_t k = 0; k < sides; ++k) {
        mesh.triangles.push_back({0, vertex(1, k + 1), vertex(1, k)});
        mesh.triangles.push_back({1, vertex(steps - 1, k), vertex(steps - 1, k + 1)});
        for (std::uint32_t ring = 1; ring + 1 < steps; ++ring) {
            mesh.triangles.push_back({vertex(ring, k), vertex(ring, k + 1), vertex(ring + 1, k)});
            mesh.triangles.push_back({vertex(ring, k + 1), vertex(ring + 1, k + 1), vertex(ring + 1, k)});
        }
    }
    return mesh;
}

TEST(BodyMass, of_a_ball) {
    const BodyMass ball = mass_of({.density = 500}, SphereDesc{.radius = 0.2f});
    EXPECT_NEAR(ball.mass, 500 * 4 * pi / 3 * 0.008, 1e-5);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(ball.inertia[i], 0.4 * ball.mass * 0.04, 1e-6);
    for (std::size_t i = 3; i < 6; ++i) EXPECT_EQ(ball.inertia[i], 0);
    EXPECT_EQ(ball.center, Vec3{});
    expect_inverse(ball);
}

TEST(BodyMass, of_a_box) {
    const BodyMass box = mass_of({.mass = 3}, BoxDesc{.half_extents = {0.5f, 0.1f, 0.2f}});
    EXPECT_EQ(box.mass, 3);
    EXPECT_NEAR(box.inertia[0], 0.01 + 0.04, 1e-7);
    EXPECT_NEAR(box.inertia[1], 0.25 + 0.04, 1e-7);
    EXPECT_NEAR(box.inertia[2], 0.25 + 0.01, 1e-7);
    EXPECT_NEAR(mass_of({}, BoxDesc{.half_extents = {0.5f, 0.1f, 0.2f}}).mass, 80, 1e-4);
    expect_inverse(box);
}

// A cylinder and two halves of a ball, whose centers are 3/8 of the radius above the cylinder.
TEST(BodyMass, of_a_capsule) {
    const double r = 0.1, h = 0.3;
    const double cylinder = 1000 * pi * r * r * 2 * h, ball = 1000 * 4 * pi / 3 * r * r * r;
    const BodyMass capsule = mass_of({}, CapsuleDesc{.radius = 0.1f, .half_height = 0.3f});
    EXPECT_NEAR(capsule.mass, cylinder + ball, 1e-4);
    EXPECT_NEAR(capsule.inertia[1], cylinder * r * r / 2 + ball * 0.4 * r * r, 1e-6);
    const double across = cylinder * (r * r / 4 + h * h / 3) + ball * (0.4 * r * r + h * h + 0.75 * h * r);
    EXPECT_NEAR(capsule.inertia[0], across, 1e-5);
    EXPECT_NEAR(capsule.inertia[2], across, 1e-5);
    EXPECT_NEAR(capsule.center.y, 0, 1e-7);
    expect_inverse(capsule);
}

TEST(BodyMass, of_a_capsule_without_length_is_that_of_a_ball) {
    expect_same(mass_of({}, CapsuleDesc{.radius = 0.1f, .half_height = 0}), mass_of({}, SphereDesc{.radius = 0.1f}),
                1e-6);
}

TEST(BodyMass, of_a_tapered_capsule_is_that_of_its_triangles) {
    for (const TaperedCapsuleDesc& shape :
         {TaperedCapsuleDesc{.radius = {0.3f, 0.1f}, .half_height = 0.4f}, TaperedCapsuleDesc{{0.1f, 0.3f}, 0.12f},
          TaperedCapsuleDesc{{0.2f, 0.2f}, 0.5f}, TaperedCapsuleDesc{{0.2f, 0.01f}, 0.1f}}) {
        const double low = shape.radius[0], high = shape.radius[1], h = shape.half_height;
        const double slope = (low - high) / (2 * h), shrink = std::sqrt(1 - slope * slope);
        const auto radius_at = [&](double y) {
            if (y < -h + low * slope) return std::sqrt(std::max(0.0, low * low - (y + h) * (y + h)));
            if (y > h + high * slope) return std::sqrt(std::max(0.0, high * high - (y - h) * (y - h)));
            const double part = (y + h - low * slope) / (2 * h + (high - low) * slope);
            return shrink * (low + (high - low) * part);
        };
        expect_same(mass_of({}, shape), mesh_mass({}, revolved(-h - low, h + high, radius_at, 150, 150)), 1e-3);
        expect_inverse(mass_of({}, shape));
    }
}

TEST(BodyMass, of_a_tapered_capsule_whose_one_ball_holds_the_other_is_that_of_the_ball) {
    const BodyMass ball = mass_of({}, SphereDesc{.radius = 0.3f});
    for (const bool low : {true, false}) {
        const TaperedCapsuleDesc shape{.radius = {low ? 0.3f : 0.1f, low ? 0.1f : 0.3f}, .half_height = 0.1f};
        BodyMass expected = ball;
        expected.center = {0, low ? -0.1f : 0.1f, 0};
        expect_same(mass_of({}, shape), expected, 1e-6);
    }
}

TEST(BodyMass, of_meshes_is_that_of_their_shapes) {
    expect_same(mesh_mass({}, make_sphere(0.2f, 6)), mass_of({}, SphereDesc{.radius = 0.2f}), 2e-3);
    expect_same(mesh_mass({}, make_box({1, 0.2f, 0.4f}, {3, 4, 2})),
                mass_of({}, BoxDesc{.half_extents = {0.5f, 0.1f, 0.2f}}), 1e-6);
}

// A tetrahedron with a corner at the origin and others on the axes: products of inertia are not zero.
TEST(BodyMass, has_products_of_inertia) {
    const TriangleMesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}},
                            .triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
    const BodyMass mass = mesh_mass({.density = 1}, mesh);
    EXPECT_NEAR(mass.mass, 1, 1e-6);
    EXPECT_NEAR(mass.center.x, 0.25, 1e-6);
    EXPECT_NEAR(mass.center.y, 0.5, 1e-6);
    EXPECT_NEAR(mass.center.z, 0.75, 1e-6);
    // Mean of x²: a² / 10, of x y: a b / 20; about the center less 1/16 of either.
    EXPECT_NEAR(mass.inertia[0], (4 + 9) * (0.1 - 1 / 16.0), 1e-6);
    EXPECT_NEAR(mass.inertia[3], -(2 * 3) * (0.05 - 1 / 16.0), 1e-6);
    EXPECT_NEAR(mass.inertia[4], -(3 * 1) * (0.05 - 1 / 16.0), 1e-6);
    EXPECT_NEAR(mass.inertia[5], -(1 * 2) * (0.05 - 1 / 16.0), 1e-6);
    expect_inverse(mass);
    const ShapeData hull = hull_data(mesh.positions);
    expect_same(mass_of({.density = 1}, ConvexDesc{}, &hull), mass, 1e-6);
}

TEST(BodyMass, goes_with_a_mesh_that_is_moved_and_turned) {
    std::mt19937 engine(7);
    const auto number = [&](double low, double high) {
        return static_cast<float>(low + (high - low) * (engine() / 4294967296.0));
    };
    TriangleMesh mesh = make_box({1, 0.3f, 0.6f}, {2, 3, 2});
    for (Vec3& p : mesh.positions) p = {p.x + 0.4f * p.y, p.y + 0.5f * p.x * p.x, p.z * (1.2f + p.x)};
    const BodyMass at_rest = mesh_mass({}, mesh);
    for (int i = 0; i < 20; ++i) {
        const Mat3 turn = rotation_from_degrees({number(0, 360), number(0, 360), number(0, 360)});
        const Pose pose{turn, {number(-3, 3), number(-3, 3), number(-3, 3)}};
        BodyMass expected = at_rest;
        expected.center = to_world(pose, at_rest.center);
        const auto& m = at_rest.inertia;
        const Mat3 tensor{{m[0], m[5], m[4]}, {m[5], m[1], m[3]}, {m[4], m[3], m[2]}};
        const Mat3 turned = turn * tensor * transposed(turn);
        expected.inertia = {turned.x.x, turned.y.y, turned.z.z, turned.y.z, turned.z.x, turned.x.y};
        expect_same(mesh_mass({}, moved(mesh, pose)), expected, 1e-5);
        const ShapeData hull = hull_data(moved(mesh, pose).positions);
        const ShapeData hull_at_rest = hull_data(mesh.positions);
        const ConvexDesc rounded{.radius = 0.1f};
        const BodyMass hull_mass = mass_of({}, rounded, &hull), hull_before = mass_of({}, rounded, &hull_at_rest);
        EXPECT_NEAR(hull_mass.mass, hull_before.mass, 1e-5 * hull_before.mass);
        EXPECT_NEAR(length(hull_mass.center - to_world(pose, hull_before.center)), 0, 2e-6);
        expect_inverse(hull_mass);
    }
}

// Steiner's formula: volume, area, mean width and a ball.
TEST(BodyMass, of_a_rounded_hull_counts_the_rounding) {
    const ShapeData cube = hull_data(make_box({1, 1, 1}, {2, 2, 2}).positions);
    for (const float r : {0.0f, 0.01f, 0.5f, 5.0f}) {
        const double expected = 1 + 6.0 * r + 3 * pi * r * r + 4 * pi / 3 * r * r * r;
        EXPECT_NEAR(mass_of({.density = 1}, ConvexDesc{.radius = r}, &cube).mass, expected, 1e-6 * expected);
    }
}

// A rounded rod is nearly a capsule, a rounded small cube nearly a ball, in inertia too.
TEST(BodyMass, of_a_rounded_hull_tends_to_that_of_round_shapes) {
    const ShapeData rod = hull_data(make_box({1e-4f, 0.6f, 1e-4f}, {2, 2, 2}).positions);
    expect_same(mass_of({}, ConvexDesc{.radius = 0.1f}, &rod),
                mass_of({}, CapsuleDesc{.radius = 0.1f, .half_height = 0.3f}), 2e-3);
    TriangleMesh speck = make_box({1e-4f, 1e-4f, 1e-4f}, {2, 2, 2});
    for (Vec3& p : speck.positions) p = p + Vec3{0.5f, -1, 2};
    const ShapeData ball = hull_data(speck.positions);
    BodyMass expected = mass_of({}, SphereDesc{.radius = 0.1f});
    expected.center = {0.5f, -1, 2};
    expect_same(mass_of({}, ConvexDesc{.radius = 0.1f}, &ball), expected, 5e-3);
}

// The surface of the rounded hull as triangles: a point of the fine sphere for each direction, moved to the corner that
// is farthest in that direction.
TEST(BodyMass, of_a_rounded_hull_is_that_of_its_triangles) {
    const std::vector<Vec3> points{
        {0, 0, 0}, {0.4f, 0, 0.05f}, {0.1f, 0.3f, 0}, {0.05f, 0.1f, 0.5f}, {0.3f, 0.3f, 0.3f}};
    const ShapeData data = hull_data(points);
    TriangleMesh rounded = make_sphere(0.15f, 5);
    for (std::size_t v = 0; v < rounded.positions.size(); ++v) {
        const Vec3 direction = rounded.positions[v];
        const Vec3 corner = *std::ranges::max_element(points, {}, [&](Vec3 p) { return dot(p, direction); });
        rounded.positions[v] = direction + corner;
    }
    expect_same(mass_of({}, ConvexDesc{.radius = 0.15f}, &data), mesh_mass({}, rounded), 3e-3);
}

TEST(BodyMass, of_a_mesh_that_is_partly_or_wholly_inside_out) {
    const TriangleMesh box = make_box({1, 0.2f, 0.4f}, {3, 4, 2});
    const BodyMass expected = mesh_mass({}, box);
    expect_same(mesh_mass({}, with_faces_in(box)), expected, 1e-6);
    TriangleMesh mixed = box;
    for (std::size_t t = 0; t < mixed.triangles.size(); t += 5) std::swap(mixed.triangles[t][1], mixed.triangles[t][2]);
    expect_same(mesh_mass({}, mixed), expected, 1e-6);
}

TEST(BodyMass, of_a_mesh_in_parts) {
    const TriangleMesh large = make_box({1, 1, 1}, {2, 2, 2}), small = make_box({0.5f, 0.5f, 0.5f}, {2, 2, 2});
    EXPECT_NEAR(mesh_mass({.density = 1}, together(large, with_faces_in(small))).mass, 1 - 0.125, 1e-6) << "a cavity";
    EXPECT_NEAR(mesh_mass({.density = 1}, together(large, small)).mass, 1, 1e-6) << "solid within solid";
    EXPECT_NEAR(mesh_mass({.density = 1}, together(with_faces_in(large), small)).mass, 1 - 0.125, 1e-6);
    const TriangleMesh apart = moved(small, {{}, {3, 0, 0}});
    for (const TriangleMesh& other : {apart, with_faces_in(apart)}) {
        const BodyMass both = mesh_mass({.density = 1}, together(large, other));
        EXPECT_NEAR(both.mass, 1.125, 1e-6);
        EXPECT_NEAR(both.center.x, 0.125 * 3 / 1.125, 1e-6);
        EXPECT_NEAR(both.inertia[1], 1 / 6.0 + 0.125 * 0.25 / 6 + 9 * 0.125 / 1.125, 1e-5);
    }
}

TEST(BodyMass, of_an_open_mesh_is_that_of_a_shell) {
    TriangleMesh open = make_box({1, 1, 1}, {2, 2, 2});
    std::erase_if(open.triangles, [&](const Triangle& t) {
        return std::ranges::all_of(t, [&](std::uint32_t v) { return open.positions[v].y > 0.4f; });
    });
    ASSERT_EQ(open.triangles.size(), 10u);
    const ShapeData data = data_of(open);
    EXPECT_EQ(mass_error({}, SolidMeshDesc{}, &data), "/mass: must be given: the mesh has holes, so it has no volume");
    std::string note;
    const auto shell = body_mass_of({.mass = 5}, SolidMeshDesc{}, &data, &note);
    ASSERT_TRUE(shell.ok());
    EXPECT_EQ(note, "the mesh has holes, so its center and moments of inertia are those of a shell");
    EXPECT_NEAR(shell->center.y, -0.1, 1e-6);
    // Five plates of 1 kg. About y: the bottom 1/6, each side 1/12 + 1/4.
    EXPECT_NEAR(shell->inertia[1], 1 / 6.0 + 4 * (1 / 12.0 + 0.25), 1e-5);
    const auto given = body_mass_of({.mass = 5, .inertia = {1, 2, 2}}, SolidMeshDesc{}, &data, &note);
    ASSERT_TRUE(given.ok());
    EXPECT_EQ(note, "");
    EXPECT_EQ(given->inertia, (std::array<float, 6>{1, 2, 2, 0, 0, 0}));
}

TEST(BodyMass, of_a_flat_mesh_is_that_of_a_plate) {
    const TriangleMesh sheet = make_grid({2, 1}, {5, 3}, GridDiagonal::alternating);
    const ShapeData data = data_of(sheet), doubled = data_of(together(sheet, with_faces_in(sheet)));
    for (const ShapeData* flat : {&data, &doubled}) {
        EXPECT_NE(mass_error({}, SolidMeshDesc{}, flat), "none");
        const BodyMass plate = mass_of({.mass = 12}, SolidMeshDesc{}, flat);
        EXPECT_NEAR(plate.inertia[0], 1, 1e-5);
        EXPECT_NEAR(plate.inertia[1], 5, 1e-5);
        EXPECT_NEAR(plate.inertia[2], 4, 1e-5);
        expect_inverse(plate);
    }
    EXPECT_EQ(mass_error({}, SolidMeshDesc{}, &doubled),
              "/mass: must be given: the mesh encloses nothing, so it has no volume");
}

TEST(BodyMass, takes_given_values) {
    const BodyMass ball = mass_of({.mass = 2, .density = 1}, SphereDesc{.radius = 0.5f});
    EXPECT_EQ(ball.mass, 2);
    EXPECT_NEAR(ball.inertia[0], 0.4 * 2 * 0.25, 1e-6);
    const BodyMass moved_center = mass_of({.mass = 2, .center = {0, -0.3f, 0.1f}}, SphereDesc{.radius = 0.5f});
    EXPECT_EQ(moved_center.center, (Vec3{0, -0.3f, 0.1f}));
    EXPECT_EQ(moved_center.inertia, ball.inertia);
    const BodyMass given = mass_of({.mass = 2, .inertia = {1, 2, 3}}, SphereDesc{.radius = 0.5f});
    EXPECT_EQ(given.inertia, (std::array<float, 6>{1, 2, 3, 0, 0, 0}));
    EXPECT_EQ(given.inverse_inertia, (std::array<float, 6>{1, 0.5f, 1 / 3.0f, 0, 0, 0}));
}

TEST(BodyMass, names_what_is_wrong) {
    const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    const SphereDesc ball{};
    EXPECT_EQ(mass_error({}, PlaneDesc{}), "a plane has no volume, so it cannot be a body");
    EXPECT_EQ(mass_error({.mass = 1, .inertia = {1, 1, 1}}, PlaneDesc{}),
              "a plane has no volume, so it cannot be a body");
    EXPECT_EQ(mass_error({.mass = -1}, ball), "/mass: must be ≥ 0 kg, got -1");
    EXPECT_EQ(mass_error({.mass = nan}, ball), "/mass: must be ≥ 0 kg, got nan");
    EXPECT_EQ(mass_error({.mass = infinity}, ball), "/mass: must be ≥ 0 kg, got inf");
    EXPECT_EQ(mass_error({.density = 0}, ball), "/density: must be > 0 kg/m³, got 0");
    EXPECT_EQ(mass_error({.center = {0, nan, 0}}, ball), "/center: must be finite");
    EXPECT_EQ(
        mass_error({.inertia = {1, 1, 2.1f}}, ball),
        "/inertia: must hold moments that a body can have: each at most the sum of the other two, got [1, 1, 2.1]");
    EXPECT_EQ(mass_error({.inertia = {1, 1, 2}}, ball), "none") << "a plate";
    EXPECT_EQ(mass_error({.inertia = {1, 0, 1}}, ball),
              "/inertia: must hold three moments > 0 kg·m², or all 0, got [1, 0, 1]");
    EXPECT_EQ(mass_error({.inertia = {1, nan, 1}}, ball),
              "/inertia: must hold three moments > 0 kg·m², or all 0, got [1, nan, 1]");
}

TEST(BodyMass, names_what_floats_do_not_hold) {
    EXPECT_EQ(mass_error({}, SphereDesc{.radius = 1e-12f}),
              "the body is too small: its mass is 4.19e-33 kg; it must be from 1e-30 to 1e30");
    EXPECT_EQ(mass_error({}, SphereDesc{.radius = 1e-8f}),
              "the body is too small: its moment of inertia is 1.68e-37 kg·m²; it must be from 1e-30 to 1e30");
    EXPECT_EQ(mass_error({}, SphereDesc{.radius = 1e6f}),
              "the body is too large: its moment of inertia is 1.68e+33 kg·m²; it must be from 1e-30 to 1e30");
    EXPECT_EQ(mass_error({}, SphereDesc{.radius = 1e-6f}), "none");
    expect_inverse(mass_of({}, SphereDesc{.radius = 1e-6f}));
    EXPECT_NE(mass_error({.mass = 1}, SphereDesc{.radius = 1e-40f}), "none");
    expect_inverse(mass_of({}, BoxDesc{.half_extents = {1e-3f, 100, 1e-3f}}));
}

TEST(BodyMass, of_a_mesh_with_its_distance_field) {
    const TriangleMesh mesh = make_sphere(0.3f, 3);
    auto field = build_distance_field(mesh.positions, mesh.triangles, {.cells = 16});
    ASSERT_TRUE(field.ok());
    field->data.bounds = bounds_of(mesh.positions);
    field->data.surface = mesh;
    expect_same(mass_of({}, SolidMeshDesc{}, &field->data), mesh_mass({}, mesh), 0);
}

TEST(BodyMass, with_points_is_that_of_all_together) {
    const BodyMass ball = mass_of({.mass = 2}, SphereDesc{.radius = 0.5f});
    EXPECT_EQ(with_points(ball, {}), ball);
    const PointMass both[2] = {{{1, 0, 0}, 0.5f}, {{-1, 0, 0}, 0.5f}};
    const BodyMass longer = with_points(ball, both);
    EXPECT_FLOAT_EQ(longer.mass, 3);
    EXPECT_EQ(longer.center, Vec3{});
    EXPECT_FLOAT_EQ(longer.inertia[0], ball.inertia[0]);
    EXPECT_FLOAT_EQ(longer.inertia[1], ball.inertia[1] + 1);
    EXPECT_FLOAT_EQ(longer.inverse_inertia[2], 1 / (ball.inertia[2] + 1));
}

// One after another gives the same, wherever the center moves in between.
TEST(BodyMass, with_points_does_not_depend_on_their_grouping) {
    const BodyMass box = mass_of({.mass = 1, .center = {0.1f, 0, 0.2f}}, BoxDesc{.half_extents = {0.5f, 0.2f, 0.1f}});
    std::mt19937 bits(5);
    std::uniform_real_distribution<float> number(-1, 1);
    std::vector<PointMass> points;
    for (int i = 0; i < 20; ++i)
        points.push_back({{number(bits), number(bits), number(bits)}, 0.1f + number(bits) / 20});
    const BodyMass at_once = with_points(box, points);
    BodyMass grown = box;
    for (const PointMass& point : points) grown = with_points(grown, {&point, 1});
    EXPECT_NEAR(grown.mass, at_once.mass, 1e-5);
    EXPECT_LT(length(grown.center - at_once.center), 1e-5f);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(grown.inertia[i], at_once.inertia[i], 1e-4) << i;
}

}  // namespace
}  // namespace weft
