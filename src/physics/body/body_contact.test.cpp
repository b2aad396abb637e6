#include "physics/testing.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

using namespace testing_kernels;
using reference::MovedBody;

// With any symmetric positive tensor.
MovedBody random_body(Random& random) {
    MovedBody body;
    body.contacts = random.number(1, 9);
    body.inverse_mass = random.number(0.1, 5);
    body.center = random.vector(1);
    vec3 columns[3] = {vec3(0, 0, 0), vec3(0, 0, 0), vec3(0, 0, 0)};
    for (int i = 0; i < 3; ++i) {
        const vec3 axis = random.vector(3);
        columns[0] = columns[0] + axis * axis.x;
        columns[1] = columns[1] + axis * axis.y;
        columns[2] = columns[2] + axis * axis.z;
    }
    body.ix = columns[0], body.iy = columns[1], body.iz = columns[2];
    return body;
}

TEST(AttachedPoint, weighs_as_much_as_along_the_direction_in_which_the_body_gives_way_most) {
    Random random(1);
    for (int i = 0; i < 50; ++i) {
        const MovedBody body = random_body(random);
        const vec3 lever = random.vector(1);
        const double most = reference::most_weight_of(body, lever);
        double largest = 0;
        for (int k = 0; k < 3000; ++k) {
            const vec3 way = random.vector(1);
            const double weight = reference::weight_of(body, lever, way * (1 / norm(way)));
            EXPECT_LE(weight, most * (1 + 1e-12));
            largest = std::max(largest, weight);
        }
        EXPECT_GT(largest, 0.97 * most);
    }
}

TEST(AttachedPoint, at_the_center_has_the_mass_of_its_part_of_the_body) {
    Random random(2);
    const MovedBody body = random_body(random);
    EXPECT_EQ(reference::most_weight_of(body, vec3(0, 0, 0)), body.contacts * body.inverse_mass);
}

TEST(Support, holds_all_of_a_push_within_the_cone_of_friction) {
    for (const double friction : {0.0, 0.3, 1.0}) {
        const double limit = std::atan(friction);
        EXPECT_EQ(reference::yielding_on_support(1, friction), 0);
        EXPECT_EQ(reference::yielding_on_support(std::cos(0.9 * limit), friction), 0);
        EXPECT_GT(reference::yielding_on_support(std::cos(limit + 0.1), friction), 0);
        EXPECT_NEAR(reference::yielding_on_support(0, friction), 1, 1e-12);
    }
    // Without friction the particle slides along the support.
    EXPECT_NEAR(reference::yielding_on_support(std::cos(0.5), 0), std::pow(std::sin(0.5), 2), 1e-12);
}

TEST(Support, takes_friction_up_to_its_cone) {
    Random random(3);
    int limited = 0;
    for (int i = 0; i < 200; ++i) {
        reference::Support support = reference::no_support();
        support.normal = random.vector(1);
        support.normal = support.normal * (1 / norm(support.normal));
        support.friction = random.number(0.1, 0.9);
        vec3 along = random.vector(1);
        along = along * (1 / norm(along));
        const auto across = [&](vec3 v) { return v - support.normal * dot(v, support.normal); };
        reference::ContactSum back;
        back.push = random.number(0.1, 2);
        back.friction = across(random.vector(1));
        back.friction = back.friction * (random.number(0, 1) * support.friction * back.push / norm(back.friction));
        const double most = reference::most_on_support(back, support, along);
        ASSERT_GE(most, 0);
        // What is left of the cone when the friction of the body has grown by this.
        const auto left = [&](double by) {
            return support.friction * (back.push + by * dot(along, support.normal)) -
                   norm(back.friction + across(along) * by);
        };
        EXPECT_GE(left(0.999 * std::min(most, 10.0)), -1e-9) << i;
        if (most >= 10) continue;
        EXPECT_LE(left(1.001 * most + 1e-9), 1e-9) << i;
        ++limited;
    }
    EXPECT_GT(limited, 100);
}

}  // namespace
}  // namespace weft
