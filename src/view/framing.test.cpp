#include "view/framing.h"

#include "solver/world/collider_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace weft {
namespace {

constexpr float frame_seconds = 1.0f / 60;

Subject ball_at(Vec3 center, float radius) {
    return {{center, radius}, {center, radius}};
}

bool shows(const FollowingCamera& camera, const Ball& ball) {
    return length(ball.center - camera.shown().center) + ball.radius <= camera.shown().radius * 1.0001f;
}

TEST(Framing, has_the_whole_ball_in_view_and_fills_the_narrow_side) {
    const Ball ball{{1, 2, 3}, 0.5f};
    for (const float aspect : {16.0f / 9, 1.0f, 0.5f}) {
        const Camera camera = framing(ball, aspect);
        EXPECT_EQ(camera.target, ball.center);
        const float seen = std::asin(ball.radius / length(camera.position - camera.target));
        const float half = camera.fov / 2 * 3.14159265f / 180;
        EXPECT_NEAR(std::tan(seen), std::tan(half) * std::min(1.0f, aspect), 1e-5f);
    }
}

TEST(FollowingCamera, does_not_move_for_what_flutters) {
    FollowingCamera camera(ball_at({0, 1, 0}, 1), 1.5f);
    const Camera start = camera.camera();
    for (int i = 0; i < 300; ++i) {
        const float phase = 0.2f * static_cast<float>(i);
        camera.follow(ball_at({0.04f * std::sin(phase), 1, 0}, 1 + 0.05f * std::cos(phase)), frame_seconds);
        EXPECT_EQ(camera.camera().position, start.position);
        EXPECT_EQ(camera.camera().target, start.target);
    }
}

TEST(FollowingCamera, keeps_what_falls_and_lands_in_view_without_jumps) {
    for (const float rate : {30.0f, 60.0f, 240.0f}) {
        FollowingCamera camera(ball_at({}, 0.7f), 1.5f);
        Vec3 before, velocity_before;
        float farthest = 0, sharpest = 0;
        for (int i = 1; i < static_cast<int>(4 * rate); ++i) {
            const float time = std::min(static_cast<float>(i) / rate, 2.0f);  // 19.6 m, then it lies still
            const Subject subject = ball_at({0, -0.5f * 9.81f * time * time, 0}, 0.7f);
            camera.follow(subject, 1 / rate);
            EXPECT_TRUE(shows(camera, subject.cloths)) << "frame " << i;
            const Vec3 velocity = (camera.shown().center - before) * rate;
            farthest = std::max(farthest, camera.shown().radius);
            sharpest = std::max(sharpest, length(velocity - velocity_before) * rate);
            before = camera.shown().center, velocity_before = velocity;
        }
        // It lands at 19.6 m/s. The camera brakes with 2 ω v and overshoots by v / (e ω) = 0.9 m.
        EXPECT_LT(sharpest, 330) << "m/s²; landing itself is " << 19.6f * rate;
        EXPECT_LT(farthest, 0.7f + 0.9f);
        EXPECT_NEAR(camera.shown().center.y, -19.62f, 0.15f);
        EXPECT_NEAR(camera.shown().radius, 0.77f, 0.01f);
    }
}

TEST(FollowingCamera, has_no_lag_behind_what_goes_on_evenly) {
    FollowingCamera camera(ball_at({}, 1), 1.5f);
    Subject subject = ball_at({}, 1);
    for (int i = 1; i < 240; ++i) {
        subject = ball_at({0.05f * static_cast<float>(i), 0, 0}, 1);  // 3 m/s
        camera.follow(subject, frame_seconds);
    }
    EXPECT_NEAR(subject.all.center.x - camera.shown().center.x, 0.1f, 1e-3f) << "the margin, and no more";
    EXPECT_NEAR(camera.shown().radius, 1.1f, 1e-3f);
}

TEST(FollowingCamera, comes_nearer_to_what_shrinks_and_leaves_what_grows) {
    FollowingCamera camera(ball_at({}, 1), 1.5f);
    for (int i = 0; i < 240; ++i) camera.follow(ball_at({}, 0.2f), frame_seconds);
    EXPECT_NEAR(camera.shown().radius, 0.25f, 1e-3f);
    camera.follow(ball_at({}, 5), frame_seconds);
    EXPECT_GE(camera.shown().radius, 5) << "whatever was before, it is in view";
}

TEST(FollowingCamera, takes_a_steered_camera_along) {
    FollowingCamera camera(ball_at({}, 1), 1.5f);
    const Camera steered{.position = {3, 1, 0}, .target = {0.5f, 0, 0}, .fov = 50};
    camera.follow(ball_at({}, 1), 0);
    EXPECT_EQ(camera.moved_along(steered).position, steered.position) << "nothing has moved";
    camera.cut_to(ball_at({0, -10, 0}, 2));
    const Camera carried = camera.moved_along(steered);
    EXPECT_LT(length(carried.target - Vec3{1, -10, 0}), 1e-5f);
    EXPECT_LT(length(carried.position - Vec3{6, -8, 0}), 1e-5f);
    EXPECT_EQ(carried.fov, 50);
}

TEST(BoundsOfColliders, are_those_of_their_meshes) {
    for (const ColliderDesc& desc : {ColliderDesc{.shape = SphereDesc{0.3f}}, ColliderDesc{.shape = CapsuleDesc{}},
                                     ColliderDesc{.shape = BoxDesc{}}, ColliderDesc{.shape = TaperedCapsuleDesc{}},
                                     ColliderDesc{.shape = TaperedCapsuleDesc{{0.2f, 0.5f}, 0.4f}},
                                     ColliderDesc{.shape = TaperedCapsuleDesc{{0.2f, 0.5f}, 0.1f}},
                                     ColliderDesc{.shape = TaperedCapsuleDesc{{0.5f, 0.2f}, 0.1f}}}) {
        Collider collider = make_collider(desc);
        collider.pose = {rotation_from_degrees({20, 40, 70}), {1, 2, 3}};
        Bounds of_mesh;
        for (const Vec3 p : mesh_of(collider).positions) of_mesh.include(to_world(collider.pose, p));
        const Bounds bounds = bounds_of(collider);
        EXPECT_LT(length(bounds.min - of_mesh.min), 0.002f);  // round ones have corners
        EXPECT_LT(length(bounds.max - of_mesh.max), 0.002f);
    }
    EXPECT_TRUE(bounds_of(make_collider({.shape = PlaneDesc{}})).empty());
}

}  // namespace
}  // namespace weft
