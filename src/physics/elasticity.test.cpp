#include "physics/elasticity.h"

#include "mesh/procedural.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace weft {
namespace {

// Per N/m: 1 and 2 parts in a thousand along the threads, a hundred between them.
constexpr Elasticity cloth{.warp = 1e-3, .weft = 2e-3, .shear = 0.1, .tension = 5};

TEST(Elasticity, of_a_fabric_is_that_of_its_threads_and_its_shear) {
    EXPECT_DOUBLE_EQ(cloth.along(1), 1e-3);
    EXPECT_DOUBLE_EQ(cloth.along(0), 2e-3);
    EXPECT_DOUBLE_EQ(cloth.along(0.5), 0.25 * (1e-3 + 2e-3 + 0.1));
    const auto topology = build_topology(make_grid({3, 4}, {3, 3}, GridDiagonal::uniform));
    const Elasticity cotton = elasticity_of({.stretch = {4000, 2000}, .shear = 40}, 0.2f, extent_of(*topology));
    EXPECT_NEAR(cotton.along(1), 1 / 4000.0, 1e-9);
    EXPECT_NEAR(cotton.along(0), 1 / 2000.0, 1e-9);
    EXPECT_NEAR(cotton.shear, 1 / 40.0, 1e-9);
    EXPECT_NEAR(cotton.tension, 3 * 0.2 * 9.81 * 5, 1e-5);
    EXPECT_NEAR(cotton.reserve(), cotton.tension / 2000, 1e-9);
    const Elasticity rigid = elasticity_of({.inextensible = true}, 0.2f, extent_of(*topology));
    EXPECT_EQ(rigid.along(0.5), 0);
    EXPECT_EQ(rigid.reserve(), 0);
}

TEST(Limit, gives_way_most_along_the_bias) {
    const Limit warp = limit_along(cloth, 2, 2, 0), bias = limit_along(cloth, 2, std::sqrt(2), std::sqrt(2));
    EXPECT_NEAR(warp.length, 2 * 1.005, 1e-12);
    EXPECT_NEAR(warp.compliance, 2e-3, 1e-12);
    EXPECT_NEAR(bias.length, 2 * (1 + 5 * cloth.along(0.5)), 1e-12);
    EXPECT_NEAR(bias.compliance, 2 * cloth.along(0.5), 1e-12);
    EXPECT_NEAR(limit_any_way(cloth, 2).length, bias.length, 1e-12);
}

// No shear stiffness, but stiff threads.
TEST(Limit, is_no_farther_than_along_one_thread_and_then_the_other) {
    Elasticity net = cloth;
    for (const double shear : {10.0, std::numeric_limits<double>::infinity()}) {
        net.shear = shear;
        const Limit limit = limit_along(net, 5, 3, 4);
        EXPECT_NEAR(limit.length, 7 * 1.01, 1e-12);
        EXPECT_NEAR(limit.compliance, 7 * 2e-3, 1e-12);
        EXPECT_NEAR(limit_any_way(net, 5).length, 5 * std::numbers::sqrt2 * 1.01, 1e-12);
    }
}

TEST(Limit, of_rigid_cloth_is_its_length) {
    for (const Limit limit : {limit_along({}, 5, 3, 4), limit_along({}, 5, 0, 0), limit_any_way({}, 5)}) {
        EXPECT_EQ(limit.length, 5);
        EXPECT_EQ(limit.compliance, 0);
    }
    EXPECT_FALSE(limit_along({.warp = std::numeric_limits<double>::infinity(), .tension = 1}, 5, 0, 5).length < 5);
}

}  // namespace
}  // namespace weft
