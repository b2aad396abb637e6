#include "base/transform.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(Rotation, quarter_turns_are_exact) {
    EXPECT_EQ(rotation_from_degrees({90, 0, 0}) * (Vec3{0, 1, 0}), (Vec3{0, 0, 1}));
    EXPECT_EQ(rotation_from_degrees({0, 90, 0}) * (Vec3{0, 0, 1}), (Vec3{1, 0, 0}));
    EXPECT_EQ(rotation_from_degrees({0, 0, 90}) * (Vec3{1, 0, 0}), (Vec3{0, 1, 0}));
    EXPECT_EQ(rotation_from_degrees({0, 0, 180}) * (Vec3{1, 0, 0}), (Vec3{-1, 0, 0}));
    EXPECT_EQ(rotation_from_degrees({360, -720, 0}), Mat3{});
}

TEST(Rotation, turns_about_x_first_then_y_then_z) {
    // y goes to z about x, then z to x about y, then x to y about z.
    EXPECT_EQ(rotation_from_degrees({90, 90, 90}) * (Vec3{0, 1, 0}), (Vec3{0, 1, 0}));
    EXPECT_EQ(rotation_from_degrees({90, 90, 0}) * (Vec3{0, 1, 0}), (Vec3{1, 0, 0}));
    EXPECT_EQ(rotation_from_degrees({0, 90, 90}) * (Vec3{0, 0, 1}), (Vec3{0, 1, 0}));
}

TEST(Pose, local_and_world_are_inverse) {
    const Pose pose{rotation_from_degrees({20, -35, 70}), {1, 2, 3}};
    const Vec3 p{0.3f, -0.7f, 0.9f};
    EXPECT_LT(length(to_local(pose, to_world(pose, p)) - p), 1e-6f);
    EXPECT_NEAR(length(pose.rotation * p), length(p), 1e-6f);
}

}  // namespace
}  // namespace weft
