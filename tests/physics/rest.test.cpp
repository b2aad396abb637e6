// Sheets at rest: hanging and lying.

#include "sheet.h"

#include "collide/convex_hull.h"
#include "collide/distance_field.h"

namespace weft::physical {
namespace {

// A sheet hung by its whole upper edge. Strain at a depth is the weight below over the tensile stiffness; the tip sinks
// by ρ_A g L²/(2K).
// Labels: slow no-asan
TEST(HangingSheet, stretches_under_its_own_weight_as_its_stiffness_says) {
    constexpr float density = 0.2f, stiffness = 60, side = 1;
    constexpr std::uint32_t n = 17;
    Fabric fabric;
    fabric.body = {.density = density, .damping = 10};
    fabric.stretch = {.stretch = {stiffness, stiffness}, .compression = {stiffness, stiffness}, .shear = 0};
    fabric.bend = {.bend = {0, 0, 0}};
    World world =
        make_world({.solver = {.substeps = 40, .iterations = 4}}, {.size = {side, side},
                                                                   .resolution = {n, n},
                                                                   .rotation_degrees = {90, 0, 0},
                                                                   .position = {},
                                                                   .fabric = fabric,
                                                                   .pinned = [](Vec3 p) { return p.z < -0.49f; }});
    run(world, 12);
    const ClothFrame& cloth = world.frame().cloths[0];
    const double g = 9.81, s = side / (n - 1);
    const auto y = [&](std::uint32_t row) { return static_cast<double>(cloth.positions[row * n + n / 2].y); };
    const double tip = -y(n - 1) - 0.5;  // rotated by 90°, z = +0.5 hangs at y = -0.5
    // The pinned row carries no weight of its own and the lowest row carries half a cell less than the continuum: the
    // discrete tip is the continuum's to second order.
    EXPECT_NEAR(tip, density * g * side * side / (2 * stiffness), 0.01 * tip);
    const double top_strain = (y(0) - y(1)) / s - 1;
    EXPECT_NEAR(top_strain, density * g * (side - s / 2) / stiffness, 0.01 * top_strain);
    EXPECT_LT(max_speed(world.frame()), 5e-3);
    EXPECT_LT(world.stretch_residual().mean, 1e-3);
}

// A slab of 3 m whose upper side is the plane y = 0 before it is tilted by `degrees`.
Collider slab(const std::string& shape, float degrees, std::array<float, 2> friction) {
    const Mat3 turn = rotation_from_degrees({0, 0, -degrees});
    const TriangleMesh mesh = make_box({3, 0.2f, 0.6f}, {2, 2, 2});
    ColliderDesc desc{.name = shape, .shape = PlaneDesc{}, .friction = friction};
    desc.transform.rotation_degrees = {0, 0, -degrees};
    if (shape == "plane") return make_collider(desc);
    desc.transform.position = turn * Vec3{1, -0.1f, 0};
    if (shape == "box") {
        desc.shape = BoxDesc{{1.5f, 0.1f, 0.3f}};
        return make_collider(desc);
    }
    if (shape == "convex") {
        desc.shape = ConvexDesc{};
        return make_collider(desc, std::make_shared<ShapeData>(make_convex_data(*convex_hull(mesh.positions))));
    }
    desc.shape = SolidMeshDesc{};
    auto field = build_distance_field(mesh.positions, mesh.triangles, {.cells = 96, .threads = 1});
    return make_collider(desc, std::make_shared<ShapeData>(std::move(field->data)));
}

// Sheets on a tilted plane. They stay while μ ≥ tan θ, exactly: friction is part of the position, so nothing creeps.
class Incline : public testing::TestWithParam<std::uint32_t> {};

double slide(double degrees, float static_friction, float kinetic_friction, std::uint32_t iterations, double seconds,
             double* speed = nullptr, const std::string& shape = "plane") {
    const float tilt = static_cast<float>(degrees);
    Fabric fabric;
    fabric.contact = {.thickness = 0.002f, .friction = {static_friction, kinetic_friction}};
    const Mat3 turn = rotation_from_degrees({0, 0, -tilt});
    const Vec3 up = turn * Vec3{0, 1, 0}, down_hill = turn * Vec3{1, 0, 0};
    World world = make_world({.solver = {.substeps = 20, .iterations = iterations}}, {.size = {0.2f, 0.2f},
                                                                                      .resolution = {7, 7},
                                                                                      .rotation_degrees = {0, 0, -tilt},
                                                                                      .position = up * 0.001f,
                                                                                      .fabric = fabric});
    world.add(slab(shape, tilt, {static_friction, kinetic_friction}));
    const Vec3 from = center_of_mass(world.frame().cloths[0]);
    run(world, seconds);
    if (speed) *speed = max_speed(world.frame());
    return dot(center_of_mass(world.frame().cloths[0]) - from, down_hill);
}

TEST_P(Incline, a_sheet_stays_while_friction_holds) {
    const double holding = std::atan(0.5) * 180 / 3.14159265358979;  // 26.565°
    double speed = 1;
    EXPECT_LT(std::abs(slide(holding - 0.5, 0.5f, 0.5f, GetParam(), 2, &speed)), 1e-5);
    EXPECT_LT(speed, 1e-4) << "not even in its velocities";
    EXPECT_GT(slide(holding + 0.5, 0.5f, 0.5f, GetParam(), 2), 0.01);
}

TEST_P(Incline, beyond_it_slides_as_coulomb_says) {
    struct Case {
        double degrees;
        float friction;
        double acceleration;  // g (sin θ - μ cos θ), m/s²
    };
    for (const Case& c : {Case{20, 0.3f, 0.5897}, Case{30, 0.3f, 2.3563}, Case{30, 0.5f, 0.6571}}) {
        constexpr double seconds = 1;
        const double expected = 0.5 * c.acceleration * seconds * (seconds + 1.0 / 1200);
        EXPECT_NEAR(slide(c.degrees, c.friction, c.friction, GetParam(), seconds), expected, 0.01 * expected)
            << c.degrees << "° at " << c.friction;
    }
}

TEST_P(Incline, kinetic_friction_rules_once_it_slides) {
    const double expected = 0.5 * 9.81 * (std::sin(M_PI / 6) - 0.2 * std::cos(M_PI / 6)) * (1 + 1.0 / 1200);
    EXPECT_NEAR(slide(30, 0.5f, 0.2f, GetParam(), 1), expected, 0.01 * expected);
}

INSTANTIATE_TEST_SUITE_P(Iterations, Incline, testing::Values(1u, 4u));

class InclineOf : public testing::TestWithParam<std::string> {};

TEST_P(InclineOf, holds_and_slides_as_coulomb_says) {
    const double holding = std::atan(0.5) * 180 / 3.14159265358979;
    double speed = 1;
    EXPECT_LT(std::abs(slide(holding - 0.5, 0.5f, 0.5f, 1, 2, &speed, GetParam())), 1e-5);
    EXPECT_LT(speed, 1e-4);
    EXPECT_GT(slide(holding + 0.5, 0.5f, 0.5f, 1, 2, nullptr, GetParam()), 0.01);
    const double expected = 0.5 * 2.3563 * (1 + 1.0 / 1200);
    EXPECT_NEAR(slide(30, 0.3f, 0.3f, 1, 1, nullptr, GetParam()), expected, 0.01 * expected);
}

INSTANTIATE_TEST_SUITE_P(Shapes, InclineOf, testing::Values("box", "convex", "mesh"),
                         [](const testing::TestParamInfo<std::string>& of) { return of.param; });

// A strip over half a cylinder, longer on one side. It slips if the tension on that side exceeds what the tension on
// the other and the strip's weight hold: dT/dφ = μ (T + ρ g R sin φ) + ρ g R cos φ, without weight on the cylinder
// e^{μφ}.
class Capstan : public testing::TestWithParam<std::string> {};

constexpr double radius_of_cylinder = 0.1, hanging = 0.25;  // m, the shorter side

Collider cylinder(const std::string& shape, float friction) {
    const auto radius = static_cast<float>(radius_of_cylinder);
    ColliderDesc desc{.name = shape, .shape = CapsuleDesc{radius, 0.3f}, .friction = {friction, friction}};
    desc.transform.rotation_degrees = {90, 0, 0};
    if (shape == "capsule") return make_collider(desc);
    std::vector<Vec3> points;
    for (int i = 0; i < 96; ++i) {
        const auto angle = static_cast<float>(i * 2 * M_PI / 96);
        for (const float y : {-0.2f, 0.2f}) points.push_back({radius * std::cos(angle), y, radius * std::sin(angle)});
    }
    auto convex = std::make_shared<ShapeData>(make_convex_data(*convex_hull(points)));
    if (shape == "convex") {
        desc.shape = ConvexDesc{};
        return make_collider(desc, convex);
    }
    desc.shape = SolidMeshDesc{};
    auto field =
        build_distance_field(convex->surface.positions, convex->surface.triangles, {.cells = 96, .threads = 1});
    return make_collider(desc, std::make_shared<ShapeData>(std::move(field->data)));
}

// m: the longer side that friction just holds.
double longest_that_holds(double friction, double radius) {
    double tension = hanging;  // over ρ g
    constexpr int steps = 20000;
    for (int i = 0; i < steps; ++i) {
        const double angle = (i + 0.5) * M_PI / steps;
        tension += (friction * (tension + radius * std::sin(angle)) + radius * std::cos(angle)) * M_PI / steps;
    }
    return tension;
}

// m: how far the longer side has sunk after a second.
double sinks(const std::string& shape, double longer, float friction) {
    const double radius = radius_of_cylinder + 0.001, arc = M_PI * radius, all = hanging + arc + longer;
    const auto columns = static_cast<std::uint32_t>(std::lround(all / 0.01)) + 1;
    Fabric fabric;
    fabric.contact = {.thickness = 0.002f, .friction = {friction, friction}};
    SheetDesc strip{.size = {static_cast<float>(all), 0.05f}, .resolution = {columns, 6}, .fabric = fabric};
    strip.shape = [&](Vec3 p) {
        const double s = double{p.x} + all / 2 - hanging, angle = std::clamp(s / radius, 0.0, M_PI);
        const double below = s < 0 ? -s : std::max(s - arc, 0.0);
        return Vec3{static_cast<float>(-radius * std::cos(angle)), static_cast<float>(radius * std::sin(angle) - below),
                    p.z};
    };
    World world = make_world({.solver = {.substeps = 80}}, strip);
    world.add(cylinder(shape, friction));
    const auto lowest = [&] {
        float y = 0;
        for (const Vec4& x : world.frame().cloths[0].positions) y = x.x > 0 ? std::min(y, x.y) : y;
        return double{y};
    };
    run(world, 0.25);  // it settles
    const double before = lowest();
    run(world, 1);
    return before - lowest();
}

// Labels: slow no-asan
TEST_P(Capstan, holds_as_much_as_it_should) {
    const double longest = longest_that_holds(0.3, radius_of_cylinder + 0.001);
    EXPECT_LT(sinks(GetParam(), 0.88 * longest, 0.3f), 0.003);
    EXPECT_GT(sinks(GetParam(), 1.03 * longest, 0.3f), 0.02);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Capstan, testing::Values("capsule", "convex", "mesh"),
                         [](const testing::TestParamInfo<std::string>& of) { return of.param; });

// Dropped onto a ball: it lies still, does not sink in, does not slide off.
// Labels: slow no-asan
TEST(Drape, on_a_sphere_comes_to_rest_outside_of_it) {
    World world =
        make_world({.solver = {.substeps = 20}}, {.size = {1, 1}, .resolution = {33, 33}, .position = {0, 0.45f, 0}});
    world.add(make_collider({.name = "ball", .shape = SphereDesc{0.3f}, .transform = {.position = {0, 0.1f, 0}}}));
    world.add(make_collider({.name = "ground", .shape = PlaneDesc{}, .transform = {.position = {0, -0.5f, 0}}}));
    run(world, 4);
    const Penetration penetration = measure_penetration(world.frame(), world.colliders());
    EXPECT_LT(penetration.max, 0.002) << "a chord between particles dips below the ball by s²/(8R), no particle does";
    for (const Vec4& p : world.frame().cloths[0].positions) {
        EXPECT_GT(signed_distance(world.colliders()[0], p.xyz()), 0.001 - 1e-5);
    }
    EXPECT_GT(center_of_mass(world.frame().cloths[0]).y, 0.0f) << "it is still up there";
    EXPECT_LT(measure_strain(world.frame()).stretch.mean, 0.01);
}

}  // namespace
}  // namespace weft::physical
