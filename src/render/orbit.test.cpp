#include "render/orbit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft::render {
namespace {

constexpr Camera ahead{.position = {0, 1, 2}, .target = {0, 1, 0}, .fov = 60};

void expect_near(Vec3 a, Vec3 b, float tolerance = 1e-5f) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

float distance(const Camera& camera) {
    return length(camera.position - camera.target);
}

/// Elevation of the view direction in degrees.
float pitch(const Camera& camera) {
    return std::asin((camera.target - camera.position).y / distance(camera)) * 57.29578f;
}

WindowInput window() {
    WindowInput input;
    input.width = 800;
    input.height = 600;
    input.seconds = 0.05f;
    return input;
}

WindowInput holding(char key) {
    WindowInput input = window();
    input.held.set(static_cast<std::size_t>(key));
    return input;
}

TEST(Orbit, goes_around_the_target_at_the_same_distance) {
    expect_near(orbited(ahead, 90, 0).position, {2, 1, 0});
    expect_near(orbited(ahead, 0, 30).position, {0, 2, std::sqrt(3.0f)});
    EXPECT_EQ(orbited(ahead, 90, 20).target, ahead.target);
    EXPECT_NEAR(distance(orbited(ahead, 123, 45)), 2, 1e-5f);
}

TEST(Orbit, turns_the_eye_where_it_is) {
    expect_near(turned(ahead, 90, 0).target, {2, 1, 2});
    EXPECT_EQ(turned(ahead, 90, 20).position, ahead.position);
    EXPECT_NEAR(pitch(turned(ahead, 0, 30)), 30, 1e-3f);
}

TEST(Orbit, ends_at_straight_up_and_straight_down_without_losing_its_direction) {
    for (const float up : {1000.0f, -1000.0f}) {
        const Camera eye = turned(ahead, 0, up);
        EXPECT_NEAR(std::abs(pitch(eye)), 90, 0.2f);
        EXPECT_EQ(std::signbit(pitch(eye)), std::signbit(up));
        expect_near(turned(eye, 0, -pitch(eye)).target, ahead.target, 1e-3f);
        const Camera above = orbited(ahead, 0, up);
        EXPECT_NEAR(std::abs(pitch(above)), 90, 0.2f);
        expect_near(orbited(above, 0, pitch(above)).position, ahead.position, 1e-3f);
    }
}

TEST(Orbit, a_camera_that_looks_straight_down_can_be_moved) {
    const Camera down{.position = {0, 3, 0}, .target = {0, 0, 0}, .fov = 40};
    EXPECT_LT(pitch(orbited(down, 45, -30)), -50);
    EXPECT_EQ(moved(down, 1, 0, 0).position, (Vec3{1, 3, 0}));
    const Camera inside{.position = {1, 1, 1}, .target = {1, 1, 1}, .fov = 40};
    for (const Camera& camera :
         {orbited(inside, 10, 10), turned(inside, 10, 10), moved(inside, 1, 1, 1), zoomed(inside, 3)})
        EXPECT_TRUE(finite(camera.position) && finite(camera.target));
}

TEST(Orbit, keys_go_along_the_axes_of_the_picture) {
    const float step = 2 * 0.05f;  // distance to the target per second
    const std::pair<char, Vec3> keys[] = {{'W', {0, step, 0}},  {'S', {0, -step, 0}}, {'D', {step, 0, 0}},
                                          {'A', {-step, 0, 0}}, {'E', {0, 0, -step}}, {'Q', {0, 0, step}}};
    for (const auto& [key, by] : keys) {
        const Camera to = steered(ahead, holding(key));
        expect_near(to.position, ahead.position + by);
        expect_near(to.target, ahead.target + by);
    }
    const Camera aside = orbited(ahead, 90, 0);  // looks along -x
    expect_near(steered(aside, holding('E')).position, {2 - step, 1, 0});
}

TEST(Orbit, a_window_that_was_held_up_does_not_throw_the_camera) {
    WindowInput input = holding('W');
    input.seconds = 60;
    EXPECT_NEAR(steered(ahead, input).position.y, 1.2f, 1e-5f);
}

TEST(Orbit, hands_that_do_nothing_change_no_bit) {
    const Camera odd{.position = {0.1f, 3.7f, -0.3f}, .target = {-1e-3f, 0.123f, 7}, .fov = 33};
    const Camera same = steered(odd, window());
    EXPECT_EQ(same.position, odd.position);
    EXPECT_EQ(same.target, odd.target);
}

TEST(Orbit, the_left_button_takes_the_scene_along) {
    WindowInput input = window();
    input.left = {300, 0};  // half the height is a quarter of a turn
    expect_near(steered(ahead, input).position, {-2, 1, 0});
    input.left = {0, 100};
    EXPECT_NEAR(steered(ahead, input).position.y, 2, 1e-5f);
}

TEST(Orbit, the_right_button_looks_around) {
    WindowInput input = window();
    input.right = {300, 0};
    expect_near(steered(ahead, input).target, {2, 1, 2});
    input.right = {0, 100};
    EXPECT_NEAR(pitch(steered(ahead, input)), -30, 1e-3f);
}

TEST(Orbit, what_is_under_the_pointer_goes_along_with_the_middle_button_and_with_shift) {
    WindowInput input = window();
    input.middle = {0, -600};  // the height of the image at the target
    const float high = 2 * 2 * std::tan(30.0f / 57.29578f);
    expect_near(steered(ahead, input).position, {0, 1 - high, 2});
    expect_near(steered(ahead, input).target, {0, 1 - high, 0});
    WindowInput other = window();
    other.left = input.middle;
    other.shift = true;
    EXPECT_EQ(steered(ahead, other).position, steered(ahead, input).position);
}

TEST(Orbit, the_wheel_goes_to_the_target_and_never_through_it) {
    WindowInput input = window();
    input.scroll = 1;
    expect_near(steered(ahead, input).position, {0, 1, 1.8f});
    input.scroll = -1;
    EXPECT_NEAR(distance(steered(ahead, input)), 2 / 0.9f, 1e-5f);
    input.scroll = 1000;
    EXPECT_GT(distance(steered(ahead, input)), 0.001f);
    input.scroll = -1000;
    EXPECT_TRUE(finite(steered(ahead, input).position));
    EXPECT_LT(distance(steered(ahead, input)), 1e6f);
}

}  // namespace
}  // namespace weft::render
