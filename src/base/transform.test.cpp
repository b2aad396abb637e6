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
    // The rotation about x maps y to z, the one about y maps z to x, and the one about z maps x to y.
    EXPECT_EQ(rotation_from_degrees({90, 90, 90}) * (Vec3{0, 1, 0}), (Vec3{0, 1, 0}));
    EXPECT_EQ(rotation_from_degrees({90, 90, 0}) * (Vec3{0, 1, 0}), (Vec3{1, 0, 0}));
    EXPECT_EQ(rotation_from_degrees({0, 90, 90}) * (Vec3{0, 0, 1}), (Vec3{0, 1, 0}));
}

TEST(Rotation, a_quaternion_turns_as_its_matrix) {
    for (const Vec3 degrees : {Vec3{0, 0, 0}, {20, -35, 70}, {180, 0, 0}, {0, 180, 0}, {0, 0, 180}, {170, 40, -160}}) {
        const Mat3 rotation = rotation_from_degrees(degrees);
        const Vec4 q = quaternion_from(rotation);
        EXPECT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1, 1e-6f);
        const Vec3 v{0.3f, -0.7f, 0.9f}, axis = q.xyz();
        const Vec3 turned = v + 2 * cross(axis, cross(axis, v) + q.w * v);
        EXPECT_LT(length(turned - rotation * v), 1e-6f) << degrees.x << ' ' << degrees.y << ' ' << degrees.z;
    }
}

TEST(Pose, local_and_world_are_inverse) {
    const Pose pose{rotation_from_degrees({20, -35, 70}), {1, 2, 3}};
    const Vec3 p{0.3f, -0.7f, 0.9f};
    EXPECT_LT(length(to_local(pose, to_world(pose, p)) - p), 1e-6f);
    EXPECT_NEAR(length(pose.rotation * p), length(p), 1e-6f);
}

TEST(Bounds, do_not_grow_by_an_empty_box) {
    const Bounds box{{1, 2, 3}, {4, 5, 6}};
    Bounds grown = box;
    grown.include(Bounds{});
    EXPECT_EQ(grown, box);
    grown.include(Bounds{{1, 9, 3}, {4, 8, 6}});  // empty along one axis, as the common part of two boxes can be
    EXPECT_EQ(grown, box);
    grown = {};
    grown.include(Bounds{});
    EXPECT_TRUE(grown.empty());
    grown.include(box);
    EXPECT_EQ(grown, box);
    EXPECT_TRUE(to_world(Pose{rotation_from_degrees({10, 20, 30}), {1, 2, 3}}, Bounds{}).empty());
}

TEST(Transform, goes_from_pose_to_pose_by_the_shortest_turn) {
    const Pose from{rotation_from_degrees({10, 20, 30}), {1, 2, 3}};
    for (const Vec3 turn : {Vec3{0, 0, 0}, Vec3{40, -70, 20}, Vec3{170, 0, 0}, Vec3{0, 179, 0}, Vec3{-90, 0, 120}}) {
        const Pose to{rotation_from_degrees(turn) * from.rotation, {3, 0, 3}};
        EXPECT_EQ(between(from, to, 0), from);
        EXPECT_EQ(between(from, to, 1), to);
        const Pose half = between(from, to, 0.5f);
        EXPECT_EQ(half.position, (Vec3{2, 1, 3}));
        // Applying half the rotation twice gives the full rotation.
        const Mat3 first = half.rotation * transposed(from.rotation);
        const Mat3 there = first * half.rotation;
        EXPECT_LT(length(there.x - to.rotation.x) + length(there.y - to.rotation.y), 2e-4f) << turn.x << ' ' << turn.y;
        EXPECT_NEAR(length(half.rotation.z), 1, 1e-5f);
    }
}

}  // namespace
}  // namespace weft
