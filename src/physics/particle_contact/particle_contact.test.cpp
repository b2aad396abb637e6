#include "physics/testing.h"

namespace weft {
namespace {

using namespace testing_kernels;
using reference::SpherePush;

constexpr double diameter = 0.01, recovery = 1e-4;

SpherePush push(vec3 between, vec3 before, double resistance = 2, double friction = 0) {
    const vec3 at(0.3, -0.2, 5);
    return reference::push_spheres(at + between, at, at + before, at, diameter, diameter, recovery, resistance,
                                   friction, friction);
}

TEST(ParticleContactKernels, a_push_opens_new_overlap_at_once) {
    const SpherePush result = push({0, 0.006, 0}, {0, 0.012, 0});
    EXPECT_NEAR(result.depth, 0.004, 1e-12);
    EXPECT_LT(norm(result.push * 2.0 - vec3(0, 0.004, 0)), 1e-12) << "both together move by the depth";
}

TEST(ParticleContactKernels, a_push_opens_old_overlap_at_a_limited_speed) {
    EXPECT_NEAR(push({0, 0.006, 0}, {0, 0.006, 0}).depth, recovery, 1e-12);
    EXPECT_NEAR(push({0, 0.005, 0}, {0, 0.006, 0}).depth, 0.001 + recovery, 1e-12);
    EXPECT_EQ(push({0, 0.007, 0}, {0, 0.006, 0}).depth, 0) << "it opens by itself";
}

TEST(ParticleContactKernels, a_later_push_opens_deep_overlap_only) {
    const auto depth = [](double distance) {
        const vec3 one(0, distance, 0), two(0, 0, 0), before(0, 0.012, 0);
        return reference::push_spheres(one, two, before, two, diameter, 0.9 * diameter, recovery, 2, 0, 0).depth;
    };
    EXPECT_NEAR(depth(0.0089), 0.0011, 1e-12) << "to the diameter";
    EXPECT_EQ(depth(0.0091), 0);
}

TEST(ParticleContactKernels, particles_at_one_place_are_pushed_along_some_unit_vector) {
    const SpherePush result = push({0, 0, 0}, {0, 0, 0}, 1);
    EXPECT_NEAR(norm(result.push), recovery, 1e-12);
}

TEST(ParticleContactKernels, pushes_of_a_pair_are_opposite) {
    Random random(4);
    for (int i = 0; i < 500; ++i) {
        const vec3 x0 = random.vector(0.005), x1 = random.vector(0.005), s0 = random.vector(0.005),
                   s1 = random.vector(0.005);
        const auto one = reference::push_spheres(x0, x1, s0, s1, diameter, diameter, recovery, 3, 0.5, 0.4);
        const auto other = reference::push_spheres(x1, x0, s1, s0, diameter, diameter, recovery, 3, 0.5, 0.4);
        EXPECT_LT(norm(one.push + other.push), 1e-15);
    }
}

TEST(ParticleContactKernels, friction_takes_back_slip_up_to_the_coulomb_limit) {
    const SpherePush held = push({0.0005, 0.008, 0}, {0, 0.0105, 0}, 1, 0.5);
    const SpherePush slides = push({0.005, 0.008, 0}, {0, 0.0105, 0}, 1, 0.5);
    const SpherePush smooth = push({0.005, 0.008, 0}, {0, 0.0105, 0}, 1, 0);
    EXPECT_LT(held.push.x, 0) << "against the motion along x";
    EXPECT_NEAR(norm(slides.push - smooth.push), 0.5 * slides.depth, 1e-9);
}

TEST(ParticleContactKernels, holding_takes_what_a_push_has_opened_and_no_more) {
    const auto hold = [](double from, double to, double depth) {
        return reference::hold_spheres({0, to, 0}, {0, 0, 0}, {0, from, 0}, {0, 0, 0}, depth, 1).y;
    };
    EXPECT_NEAR(hold(0.006, 0.0061, 0.0005), 0.0001, 1e-12);
    EXPECT_NEAR(hold(0.006, 0.009, 0.0005), 0.0005, 1e-12) << "the rest is the motion of the cloth";
    EXPECT_EQ(hold(0.006, 0.005, 0.0005), 0) << "it still approaches";
}

TEST(ParticleContactKernels, neighbors_keep_a_part_of_their_distance_at_rest) {
    EXPECT_EQ(reference::diameter_of_pair(diameter, 0.004, 0.5, 0.003), 0.002);
    EXPECT_NEAR(reference::diameter_of_pair(diameter, 0.01, 0.5, 0.003), 0.007, 1e-15) << "the distance less a length";
    EXPECT_EQ(reference::diameter_of_pair(diameter, 1, 0.5, 0.003), diameter);
}

TEST(ParticleContactKernels, pairs_without_mass_to_move_do_not_overlap) {
    const scalar::vec3 a(0.0f), b(0.001f, 0, 0);
    EXPECT_TRUE(scalar::spheres_overlap(a, b, 1, 0, 0.01f));
    EXPECT_FALSE(scalar::spheres_overlap(a, b, 0, 0, 0.01f));
    EXPECT_FALSE(scalar::spheres_overlap(a, b, 1, 1, 0.001f)) << "they touch";
}

TEST(ParticleContactKernels, mass_is_split_among_many_pushes_only) {
    EXPECT_EQ(reference::sphere_resistance(2, 1, 0.35), 2);
    EXPECT_EQ(reference::sphere_resistance(2, 10, 0.35), 7);
    EXPECT_EQ(reference::sphere_resistance(2, 10, 1), 20);
}

}  // namespace
}  // namespace weft
