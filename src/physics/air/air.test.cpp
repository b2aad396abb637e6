#include "physics/testing.h"

namespace weft {
namespace {

using namespace testing_kernels;
using reference::AirFabric;

constexpr double density = 1.2;

/// Of a triangle of 0.03 m² with the normal n.
vec3 change(vec3 v, vec3 n, double mass, const AirFabric& fabric, double h) {
    return reference::air_velocity_change(v, n * (0.06 / norm(n)), mass, fabric, h);
}

vec3 unit(vec3 v) {
    return v * (1 / norm(v));
}

TEST(Air, pushes_a_triangle_as_the_law_says) {
    // In a short step: drag ½ρC_D|v|²A cos(-v), lift ½ρC_L|v|²A cos((n×v)×v).
    Random random(1);
    const double area = 0.03, mass = 0.01, h = 1e-9;
    const AirFabric fabric{0.5 * density * 1.28, 0.5 * density * 0.6, 0};
    for (int i = 0; i < 300; ++i) {
        const vec3 v = random.vector(8), n = unit(random.vector(1)), along = unit(v);
        const double c = reference::dot(along, n);
        const vec3 facing = n * (c < 0 ? -1.0 : 1.0);
        const vec3 lift = reference::cross(reference::cross(facing, along), along);
        const double pressure = reference::dot(v, v) * area * std::abs(c);
        const vec3 force = along * (-fabric.drag * pressure) + lift * (fabric.lift * pressure);
        EXPECT_LT(norm(change(v, n, mass, fabric, h) * (mass / h) - force), 1e-5 * norm(force) + 1e-9) << i;
        // The orientation of the normal does not matter.
        EXPECT_LT(norm(change(v, -n, mass, fabric, h) - change(v, n, mass, fabric, h)), 1e-18);
    }
}

TEST(Air, lifts_with_the_sine_as_the_listing_has_it) {
    const AirFabric fabric{0, 0.5 * density * 0.6, 1};
    const double mass = 0.01, h = 1e-9, area = 0.03;
    const vec3 v(3, 0, 0);
    for (const double angle : {0.1, 0.7, 1.2, 1.5}) {  // between flow and normal
        const vec3 n(std::cos(angle), std::sin(angle), 0);
        const vec3 lift = reference::cross(reference::cross(n, v * (1.0 / 3)), v * (1.0 / 3));
        const vec3 force = lift * (fabric.lift * 9 * area * std::sin(angle));
        EXPECT_LT(norm(change(v, n, mass, fabric, h) * (mass / h) - force), 1e-5 * norm(force)) << angle;
    }
}

TEST(Air, never_pushes_back_and_never_makes_faster_however_long_the_step) {
    Random random(2);
    for (int i = 0; i < 2000; ++i) {
        const vec3 v = random.vector(std::pow(10.0, random.number(-6, 4))), n = random.vector(1);
        const AirFabric fabric{random.number(0, 1e4), random.number(0, 1e4), i % 2 ? 1.0 : 0.0};
        const double h = std::pow(10.0, random.number(-9, 6)), mass = std::pow(10.0, random.number(-9, 3));
        const vec3 after = v + change(v, n, mass, fabric, h);
        EXPECT_LE(norm(after), norm(v) * (1 + 1e-12));
        EXPECT_GE(reference::dot(after, v), -1e-12 * reference::dot(v, v));
    }
}

TEST(Air, slows_a_plate_to_what_integration_gives) {
    // dv/dt = -k v² has the solution v/(1 + k v t), which one step of any length takes.
    const AirFabric fabric{0.5 * density * 1.28, 0, 0};
    const double k = fabric.drag * 0.03 / 0.01;
    const vec3 once = vec3(0, -5, 0) + change({0, -5, 0}, {0, 1, 0}, 0.01, fabric, 0.2);
    EXPECT_NEAR(once.y, -5 / (1 + k * 5 * 0.2), 1e-12);
    vec3 often(0, -5, 0);
    for (int i = 0; i < 100; ++i) often = often + change(often, {0, 1, 0}, 0.01, fabric, 0.002);
    EXPECT_NEAR(often.y, once.y, 1e-9);
}

TEST(Air, leaves_alone_what_it_cannot_push) {
    using namespace scalar;
    const scalar::AirFabric fabric{1, 1, 0};
    const scalar::vec3 zero(0.0f), v(1, 2, 3), n(0.1f, 0, 0);
    for (const auto& dv : {air_velocity_change(zero, n, 1.0f, fabric, 0.1f),        // in still air
                           air_velocity_change(v, zero, 1.0f, fabric, 0.1f),        // no area
                           air_velocity_change(v, n, 0.0f, fabric, 0.1f),           // no mass
                           air_velocity_change(v, n * 1e-20f, 1.0f, fabric, 0.1f),  // hardly an area
                           air_velocity_change(v * 1e-15f, n, 1.0f, fabric, 0.1f)})
        EXPECT_EQ(dot(dv, dv), 0);
    // Edge-on there is neither drag nor, on a plate, lift.
    EXPECT_LT(norm(change({1, 0, 0}, {0, 1, 0}, 0.1, {1, 1, 0}, 0.1)), 1e-15);
    for (const float size : {1e-18f, 1e-6f, 1e6f, 1e15f}) {
        const scalar::vec3 dv = air_velocity_change(v * size, n * size, 1e-12f, fabric, 10.0f);
        EXPECT_TRUE(std::isfinite(dv.x) && std::isfinite(dv.y) && std::isfinite(dv.z)) << size;
    }
}

TEST(Air, pushes_particles_without_losing_small_impulses) {
    using namespace scalar;
    Motion m{scalar::vec3(100.0f, 0, 0), scalar::vec3(0.0f), scalar::vec3(0.0f)};
    for (int i = 0; i < 1000000; ++i) push_by_air(m, scalar::vec3(5e-7f, 0, 0), 2.0f);
    EXPECT_NEAR(m.v.x + m.v_dropped.x, 101, 1e-4);
    Motion pinned{scalar::vec3(0.0f), scalar::vec3(0.0f), scalar::vec3(0.0f)};
    push_by_air(pinned, scalar::vec3(1.0f), 0.0f);
    EXPECT_EQ(pinned.v.x, 0);
}

}  // namespace
}  // namespace weft
