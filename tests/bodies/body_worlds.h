// Worlds with rigid bodies.
#pragma once

#include "../physics/sheet.h"

#include <array>
#include <cmath>

namespace weft::physical {

inline BodyMass ball_mass(float mass, float radius) {
    const float moment = 0.4f * mass * radius * radius, inverse = 1 / moment;
    return {.mass = mass,
            .center = {},
            .inertia = {moment, moment, moment, 0, 0, 0},
            .inverse_inertia = {inverse, inverse, inverse, 0, 0, 0}};
}

inline Collider make_ball(float radius, float mass, Vec3 position, const BodyDesc& desc = {}) {
    Collider ball = make_collider({.name = "ball", .shape = SphereDesc{.radius = radius}});
    ball.pose.position = position;
    ball.features.points = {{{}, radius}};
    ball.body = Body{.mass = ball_mass(mass, radius), .state = {}, .desc = desc};
    return ball;
}

inline Collider make_box(Vec3 half, float mass, Vec3 position, const BodyDesc& desc = {}) {
    Collider box = make_collider({.name = "box", .shape = BoxDesc{.half_extents = half}});
    box.pose.position = position;
    const auto moment = [&](float a, float b) { return mass * (a * a + b * b) / 3; };
    const std::array<float, 3> moments{moment(half.y, half.z), moment(half.z, half.x), moment(half.x, half.y)};
    box.body = Body{.mass = {.mass = mass,
                             .center = {},
                             .inertia = {moments[0], moments[1], moments[2], 0, 0, 0},
                             .inverse_inertia = {1 / moments[0], 1 / moments[1], 1 / moments[2], 0, 0, 0}},
                    .state = {},
                    .desc = desc};
    return box;
}

inline Collider make_floor(float friction = 0.5f) {
    return make_collider({.name = "floor", .shape = PlaneDesc{}, .friction = {friction, friction}});
}

struct Momentum {
    std::array<double, 3> linear{}, angular{};  ///< kg·m/s and kg·m²/s, about the origin
    double energy = 0;                          ///< J, kinetic

    void add(double m, const std::array<double, 3>& x, const std::array<double, 3>& v) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
            linear[i] += m * v[i];
            angular[i] += m * (x[j] * v[k] - x[k] * v[j]);
            energy += 0.5 * m * v[i] * v[i];
        }
    }
};

/// Of all cloths and bodies. Pinned particles count as if they were free.
inline Momentum momentum_of(const World& world) {
    const auto of = [](Vec3 v) { return std::array<double, 3>{v.x, v.y, v.z}; };
    Momentum all;
    for (const ClothFrame& cloth : world.frame().cloths)
        for (std::uint32_t p = 0; p < cloth.model->particle_count; ++p)
            all.add(double{cloth.model->mass[p]}, of(cloth.positions[p].xyz()), of(cloth.velocities[p].xyz()));
    for (const Collider& collider : world.colliders()) {
        if (!collider.body) continue;
        const BodyMass& mass = collider.body->mass;
        const BodyState& state = collider.body->state;
        all.add(double{mass.mass}, of(state.place.xyz()), of(state.velocity.xyz()));
        const std::array<double, 3> spin = of(state.spin.xyz());
        for (std::size_t i = 0; i < 3; ++i) all.angular[i] += spin[i];
        Momentum still;
        still.add(double{mass.mass}, {}, of(state.velocity.xyz()));
        all.energy += kinetic_energy(state, mass) - still.energy;
    }
    return all;
}

inline double distance_between(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
inline double size_of(const std::array<double, 3>& a) {
    return std::hypot(a[0], a[1], a[2]);
}

inline float speed_of(const Body& body) {
    return length(body.state.velocity.xyz());
}

}  // namespace weft::physical
