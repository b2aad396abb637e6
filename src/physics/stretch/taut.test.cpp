#include "physics/testing.h"

#include <algorithm>
#include <numbers>
#include <vector>

namespace weft {
namespace {

using namespace testing_kernels;
using reference::StretchRow;
using reference::TautSum;

// At rest lambda of a constraint is -T h².
TEST(TautMass, is_in_proportion_to_the_tension_times_the_square_of_the_time_over_the_length) {
    Random random(1);
    for (int i = 0; i < 100; ++i) {
        const double rest = random.number(0.01, 1), compliance = random.number(1e-5, 1e-2),
                     h = random.number(1e-4, 1e-2), w = random.number(0, 100);
        const StretchRow row{rest, compliance, 1, WEFT_NEVER_STRAIGHT};
        vec3 a(0, 0, 0), b(0, rest * random.number(1.001, 2), 0);
        double lambda = 0;
        reference::project_stretch(a, b, w, w, lambda, row, make_step(h));
        const double tension = (norm(a - b) - rest) / compliance;
        EXPECT_NEAR(reference::taut_mass(row, lambda) / (tension * h * h / rest), 1.5, 1e-6);
    }
}

TEST(TautMass, is_none_of_an_edge_that_does_not_pull) {
    EXPECT_EQ(reference::taut_mass({1, 1e-4, 1e-4, WEFT_NEVER_STRAIGHT}, 0), 0);     // at rest
    EXPECT_EQ(reference::taut_mass({1, 1e-4, 1e-4, WEFT_NEVER_STRAIGHT}, 1e-3), 0);  // pushes
    EXPECT_EQ(reference::taut_mass({0, 1e-4, 1e-4, WEFT_NEVER_STRAIGHT}, -1), 0);    // padding
    EXPECT_GT(reference::taut_mass({1, 1e-4, 1e-4, WEFT_NEVER_STRAIGHT}, -1e-3), 0);
}

TEST(TautMass, adds_at_most_256_times_the_mass_of_a_particle) {
    vec3 x(0, 0, 1);
    double w = 2;
    reference::take_taut_mass(x, w, vec3(0, 0, 0), TautSum{vec3(0, 0, 0), 1e6});
    EXPECT_NEAR(w, 2 / 257.0, 1e-12);
    EXPECT_NEAR(x.z, 1 / 257.0, 1e-12);
}

TEST(TautMass, of_slack_edges_changes_no_bit) {
    Random random(2);
    for (int i = 0; i < 100; ++i) {
        const vec3 before = random.vector(1), start = random.vector(1);
        vec3 x = before;
        double w = i % 2 * random.number(0, 10);
        const double w_before = w;
        reference::take_taut_mass(x, w, start, TautSum{vec3(0, 0, 0), 0});
        EXPECT_EQ(norm(x - before), 0);
        EXPECT_EQ(w, w_before);
    }
}

// The particle and its three neighbors move alike, so what is added does too.
TEST(TautMass, does_not_hold_back_what_moves_together) {
    Random random(3);
    for (int i = 0; i < 100; ++i) {
        const vec3 start = random.vector(1), way = random.vector(1);
        TautSum sum{vec3(0, 0, 0), 0};
        for (int k = 0; k < 3; ++k) {
            const double mass = random.number(0, 10);
            sum.moved = sum.moved + way * mass, sum.mass += mass;
        }
        vec3 x = start + way;
        double w = random.number(0.1, 10);
        const double heavier = 1 + w * sum.mass, free = w;
        reference::take_taut_mass(x, w, start, sum);
        EXPECT_LT(norm(x - start - way), 1e-12);
        EXPECT_NEAR(reference::mass_ratio(w, free), heavier, 1e-12 * heavier);
    }
}

// The step of a Jacobi iteration from the predicted ways: (M + L) u = M ũ for its own row.
TEST(TautMass, takes_a_jacobi_step_of_the_geometric_stiffness) {
    Random random(4);
    for (int i = 0; i < 100; ++i) {
        const double mass = random.number(0.1, 1), tau[2] = {random.number(0, 5), random.number(0, 5)};
        const vec3 start = random.vector(1), way = random.vector(1), beside[2] = {random.vector(1), random.vector(1)};
        vec3 x = start + way;
        double w = 1 / mass;
        reference::take_taut_mass(x, w, start, TautSum{beside[0] * tau[0] + beside[1] * tau[1], tau[0] + tau[1]});
        const vec3 u = x - start;
        EXPECT_LT(norm((u - way) * mass + (u - beside[0]) * tau[0] + (u - beside[1]) * tau[1]), 1e-10);
    }
}

TEST(TautMass, moves_with_the_middles_of_the_edges) {
    Random random(5);
    TautSum sum{vec3(0, 0, 0), 0};
    vec3 moved(0, 0, 0);
    double mass = 0;
    for (int k = 0; k < 4; ++k) {
        const double tau = random.number(0, 5);
        const vec3 a = random.vector(1), b = random.vector(1);
        sum = reference::add_taut_edge(sum, tau, a, b);
        moved = moved + (a + b) * (0.5 * tau), mass += tau;
    }
    EXPECT_LT(norm(sum.moved - moved), 1e-12);
    EXPECT_NEAR(sum.mass, mass, 1e-12);
}

// A standing wave in an endless string of particles of 1 kg, to which its edges add almost the most that they can. The
// factor by which a substep multiplies its amplitude, the mean of 20.
double decay_of_wave(int particles_per_wave) {
    const double tension = 85;  // T h²/rest, kg
    const int count = particles_per_wave, substeps = 20;
    const auto at = [&](const std::vector<double>& y, int i) { return y[(i + count) % count]; };
    std::vector<double> before(count), now(count), predicted(count);
    std::vector<double> w(count, 1);
    for (int i = 0; i < count; ++i) before[i] = now[i] = std::cos(2 * std::numbers::pi * i / count);
    double size = 0;
    for (int substep = 0; substep < substeps; ++substep) {
        for (int i = 0; i < count; ++i) {
            const auto way = [&](int k) { return vec3(0, at(now, k) - at(before, k), 0); };
            const double mass = reference::taut_mass({1, 0, 0, WEFT_NEVER_STRAIGHT}, -tension);
            TautSum sum{vec3(0, 0, 0), 0};
            for (const int beside : {i - 1, i + 1}) sum = reference::add_taut_edge(sum, mass, way(i), way(beside));
            vec3 x = vec3(0, now[i], 0) + way(i);
            w[i] = 1;
            reference::take_taut_mass(x, w[i], vec3(0, now[i], 0), sum);
            predicted[i] = x.y;
        }
        before = now;
        // Both edges of a particle pull with the tension.
        for (int i = 0; i < count; ++i)
            now[i] = predicted[i] + (at(predicted, i - 1) + at(predicted, i + 1) - 2 * predicted[i]) * tension * w[i];
        size = 0;
        for (int i = 0; i < count; ++i) size = std::max({size, std::abs(now[i]), std::abs(before[i])});
    }
    return std::pow(size, 1.0 / substeps);
}

TEST(TautMass, lets_waves_of_every_length_decay) {
    EXPECT_LT(decay_of_wave(2), 0.5);
    EXPECT_LT(decay_of_wave(3), 0.7);
    for (const int particles_per_wave : {4, 5, 8, 16, 32}) EXPECT_LT(decay_of_wave(particles_per_wave), 1);
}

TEST(TautMass, of_pinned_particles_stays_infinite) {
    vec3 x(1, 2, 3);
    double w = 0;
    reference::take_taut_mass(x, w, vec3(0, 0, 0), TautSum{vec3(5, 5, 5), 7});
    EXPECT_EQ(w, 0);
    EXPECT_EQ(norm(x - vec3(1, 2, 3)), 0);
    EXPECT_EQ(reference::mass_ratio(0, 0), 1);
}

}  // namespace
}  // namespace weft
