#include "editor/tools/euler.h"

#include "editor/tools/random_views.test.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace weft::editor {
namespace {

Mat3 rotation_around(Vec3 axis, double degrees) {
    const auto angle = static_cast<float>(std::remainder(degrees, 360.0) * 3.14159265358979 / 180);
    const auto column = [&](Vec3 v) {
        return v * std::cos(angle) + cross(axis, v) * std::sin(angle) + axis * (dot(axis, v) * (1 - std::cos(angle)));
    };
    return {column({1, 0, 0}), column({0, 1, 0}), column({0, 0, 1})};
}

float largest_part(Vec3 v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

void expect_same_rotation(const Mat3& a, const Mat3& b, float tolerance = 2e-5f) {
    expect_close(a.x, b.x, tolerance);
    expect_close(a.y, b.y, tolerance);
    expect_close(a.z, b.z, tolerance);
}

Vec3 axis_of(Dice& dice, int i) {
    if (i % 4 == 0) return {1, 0, 0};
    if (i % 4 == 1) return {0, 1, 0};
    if (i % 4 == 2) return {0, 0, -1};
    return dice.direction();
}

TEST(Euler, finds_the_angles_nearest_to_given_ones) {
    Dice dice(40);
    for (int i = 0; i < 500; ++i) {
        const Vec3 degrees = i % 5 ? dice.point(170) : Vec3{dice.between(-170, 170), i % 2 ? 90.0f : -90.0f, 20};
        const Mat3 rotation = rotation_from_degrees(degrees);
        const Vec3 near = degrees + Vec3{720, -360, 1080};
        const Vec3 found = angles_near(rotation, near);
        // Floats of the matrix hide angles close to gimbal lock.
        if (std::abs(std::cos(degrees.y / 57.29578f)) > 0.05f) expect_close(found, near, 0.02f);
        expect_same_rotation(rotation_from_degrees(found), rotation);
    }
}

TEST(Euler, angles_are_those_of_the_turned_rotation) {
    Dice dice(41);
    for (int i = 0; i < 400; ++i) {
        const Vec3 start = i % 7 == 0 ? Vec3{10, 90, 30} : dice.point(200);
        const Vec3 axis = axis_of(dice, i);
        const double degrees = static_cast<double>(dice.between(-900, 900));
        const Mat3 expected = rotation_around(axis, degrees) * rotation_from_degrees(start);
        expect_same_rotation(rotation_from_degrees(turned_angles(start, axis, degrees)), expected);
    }
}

TEST(Euler, no_turn_gives_back_the_start_to_the_bit) {
    Dice dice(42);
    for (int i = 0; i < 50; ++i) {
        const Vec3 start = dice.point(500);
        EXPECT_EQ(turned_angles(start, dice.direction(), 0), start);
    }
}

TEST(Euler, turns_about_axes_of_the_angles_add_up_beyond_a_full_turn) {
    for (const double degrees : {-1000.0, -360.0, 45.0, 360.0, 725.5}) {
        const auto by = static_cast<float>(degrees);
        expect_close(turned_angles({10, 20, 30}, {0, 0, 1}, degrees), {10, 20, 30 + by}, 1e-3f);
        expect_close(turned_angles({10, 20, 30}, {0, 0, -1}, degrees), {10, 20, 30 - by}, 1e-3f);
        const Vec3 own_x = rotation_from_degrees({10, 20, 30}).x;
        expect_close(turned_angles({10, 20, 30}, own_x, degrees), {10 + by, 20, 30}, 1e-3f);
        expect_close(turned_angles({10, 20, 30}, -own_x, degrees), {10 - by, 20, 30}, 1e-3f);
        const Vec3 between = rotation_from_degrees({0, 0, 30}).y;
        expect_close(turned_angles({10, 20, 30}, between, degrees), {10, 20 + by, 30}, 0.01f);
        expect_close(turned_angles({}, {0, 1, 0}, degrees), {0, by, 0}, 1e-3f);  // through gimbal lock
    }
}

TEST(Euler, angles_are_continuous_along_a_turn) {
    Dice dice(43);
    constexpr double step = 0.3;
    for (int i = 0; i < 12; ++i) {
        const Vec3 start = dice.point(180), axis = axis_of(dice, i);
        Vec3 before = start;
        for (int k = 1; k * step < 250; ++k) {
            const Vec3 now = turned_angles(start, axis, i % 2 ? k * step : -k * step);
            // The angles change by at most the turn over the cosine of y.
            const float cosine =
                std::min(std::abs(std::cos(now.y / 57.29578f)), std::abs(std::cos(before.y / 57.29578f)));
            if (cosine > 0.05f) {
                EXPECT_LT(largest_part(now - before), 1.2f * static_cast<float>(step) / cosine + 0.01f)
                    << i << ", " << k;
            }
            EXPECT_LT(largest_part(now - before), 181) << "whatever happens at gimbal lock";
            before = now;
        }
    }
}

TEST(Euler, a_turn_out_of_gimbal_lock_jumps_by_a_quarter_turn_at_most) {
    Dice dice(44);
    for (int i = 0; i < 200; ++i) {
        const Vec3 start{dice.between(-180, 180), i % 2 ? 90.0f : -450.0f, dice.between(-180, 180)};
        const Vec3 axis = dice.direction();
        const Vec3 now = turned_angles(start, axis, 0.01);
        EXPECT_LT(largest_part(now - start), 90.1f);
        expect_same_rotation(rotation_from_degrees(now), rotation_around(axis, 0.01) * rotation_from_degrees(start));
    }
}

TEST(Euler, malformed_turns_give_back_the_start) {
    const Vec3 start{1, 2, 3};
    EXPECT_EQ(turned_angles(start, {}, 10), start);
    EXPECT_EQ(turned_angles(start, {nan_value, 0, 0}, 10), start);
    EXPECT_EQ(turned_angles(start, {0, 1, 0}, static_cast<double>(nan_value)), start);
}

}  // namespace
}  // namespace weft::editor
