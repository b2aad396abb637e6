#include "editor/tools/camera_moves.h"

#include "editor/tools/random_views.test.h"
#include "look/view_limits.h"

#include <gtest/gtest.h>

#include <vector>

namespace weft::editor {
namespace {

constexpr Camera eye_ahead{.position = {0, 1, 2}, .target = {0, 1, 0}, .fov = 60};
constexpr Vec2 small_view{800, 600};

float target_distance(const Camera& camera) {
    return length(camera.position - camera.target);
}

/// Elevation of the view direction in degrees.
float pitch_of(const Camera& camera) {
    return std::asin((camera.target - camera.position).y / target_distance(camera)) * 57.29578f;
}

FlyInput flying(FlyKeys map, char key, float seconds) {
    FlyInput input{.map = map, .held = {}, .seconds = seconds};
    input.held.set(static_cast<std::size_t>(key));
    return input;
}

TEST(CameraMoves, orbit_turns_the_scene_with_the_pointer) {
    expect_close(orbited_by(eye_ahead, {300, 0}, small_view).position, {-2, 1, 0}, 1e-5f);
    EXPECT_NEAR(orbited_by(eye_ahead, {0, 100}, small_view).position.y, 2, 1e-5f);
    EXPECT_EQ(orbited_by(eye_ahead, {12, 34}, small_view).target, eye_ahead.target);
}

TEST(CameraMoves, looking_around_ends_at_straight_up_and_down) {
    expect_close(looked_by(eye_ahead, {300, 0}, small_view).target, {2, 1, 2}, 1e-5f);
    EXPECT_NEAR(pitch_of(looked_by(eye_ahead, {0, 100}, small_view)), -30, 1e-3f);
    for (const float down : {1e4f, -1e4f}) {
        Camera camera = looked_by(eye_ahead, {0, down}, small_view);
        EXPECT_EQ(camera.position, eye_ahead.position);
        EXPECT_NEAR(pitch_of(camera), down > 0 ? -90 : 90, 0.2f);
        camera = looked_by(camera, {0, -down / std::abs(down) * 300}, small_view);
        EXPECT_NEAR(pitch_of(camera), 0, 0.2f);
        expect_close(camera.target, eye_ahead.target, 0.01f);
    }
}

TEST(CameraMoves, the_horizon_never_flips) {
    Dice dice(5);
    for (int run = 0; run < 20; ++run) {
        Camera camera = dice.camera();
        Projection before(camera, small_view);
        for (int i = 0; i < 200; ++i) {
            const Vec2 by{dice.between(-20, 20), dice.between(-60, 60)};
            camera = i % 2 ? orbited_by(camera, by, small_view) : looked_by(camera, by, small_view);
            const Projection view(camera, small_view);
            ASSERT_TRUE(view.valid());
            EXPECT_NEAR(view.right().y, 0, 1e-5f) << "the image is level";
            EXPECT_LE(view.down().y, 0) << "up is up";
            // 20 pixels are 6° about the vertical; that is how far the direction to the right turns.
            EXPECT_GT(dot(view.right(), before.right()), std::cos(6.1f / 57.29578f)) << i;
            before = view;
        }
    }
}

TEST(CameraMoves, panning_keeps_a_point_under_the_pointer) {
    Dice dice(6);
    for (int i = 0; i < 200; ++i) {
        const Camera camera = dice.camera();
        const Projection view(camera, small_view);
        const Vec2 from = dice.pixel(small_view), by{dice.between(-300, 300), dice.between(-300, 300)};
        const double depth = static_cast<double>(dice.between(0.5f, 5));
        const Vec3 point = view.at(from, depth);
        const Camera to = panned_by(camera, by, small_view, depth);
        const auto seen = Projection(to, small_view).project(point);
        ASSERT_TRUE(seen);
        EXPECT_NEAR(seen->pixel.x, from.x + by.x, 0.02f);
        EXPECT_NEAR(seen->pixel.y, from.y + by.y, 0.02f);
        EXPECT_NEAR(target_distance(to), target_distance(camera), 1e-5f);
    }
    const float high = 2 * 2 * std::tan(30.0f / 57.29578f);
    expect_close(panned_by(eye_ahead, {0, -600}, small_view).target, {0, 1 - high, 0}, 1e-5f);
}

TEST(CameraMoves, the_wheel_goes_toward_the_pointer) {
    Dice dice(7);
    for (int i = 0; i < 200; ++i) {
        const Camera camera = dice.camera();
        const Vec2 pointer = dice.pixel(small_view);
        const float notches = dice.between(-5, 5);
        const Vec3 point = Projection(camera, small_view).at(pointer, static_cast<double>(dice.between(0.5f, 4)));
        const Camera to = dollied(camera, notches, pointer, small_view, point);
        const Projection view(to, small_view);
        const auto seen = view.project(point);
        ASSERT_TRUE(seen);
        EXPECT_NEAR(seen->pixel.x, pointer.x, 0.02f);
        EXPECT_NEAR(seen->pixel.y, pointer.y, 0.02f);
        const float factor = std::pow(0.9f, notches);
        EXPECT_NEAR(length(point - to.position), factor * length(point - camera.position), 1e-4f);
        EXPECT_NEAR(target_distance(to), factor * target_distance(camera), 1e-4f);
        expect_close(view.ahead(), Projection(camera, small_view).ahead(), 1e-5f);
    }
    expect_close(dollied(eye_ahead, 1, {400, 300}, small_view).position, {0, 1, 1.8f}, 1e-5f);
}

TEST(CameraMoves, the_wheel_never_goes_through_the_target) {
    const Camera near = dollied(eye_ahead, 1000, {400, 300}, small_view);
    EXPECT_NEAR(target_distance(near), 0.01f, 1e-5f);
    EXPECT_NEAR(pitch_of(near), 0, 0.1f);
    const Camera far = dollied(eye_ahead, -1000, {400, 300}, small_view);
    EXPECT_NEAR(target_distance(far), 1e5f, 1);
}

TEST(CameraMoves, both_key_maps_go_along_the_axes_of_the_image) {
    const float way = 2 * 0.05f;
    const std::pair<char, Vec3> usual[] = {{'W', {0, 0, -way}}, {'S', {0, 0, way}}, {'A', {-way, 0, 0}},
                                           {'D', {way, 0, 0}},  {'E', {0, way, 0}}, {'Q', {0, -way, 0}}};
    const std::pair<char, Vec3> source[] = {{'W', {0, way, 0}}, {'S', {0, -way, 0}}, {'A', {-way, 0, 0}},
                                            {'D', {way, 0, 0}}, {'E', {0, 0, -way}}, {'Q', {0, 0, way}}};
    for (const auto& [key, by] : usual) {
        const Camera to = flown(eye_ahead, flying(FlyKeys::usual, key, 0.05f));
        expect_close(to.position, eye_ahead.position + by, 1e-5f);
        expect_close(to.target, eye_ahead.target + by, 1e-5f);
    }
    for (const auto& [key, by] : source)
        expect_close(flown(eye_ahead, flying(FlyKeys::source, key, 0.05f)).position, eye_ahead.position + by, 1e-5f);
    EXPECT_TRUE(flies(flying(FlyKeys::usual, 'W', 0)));
    EXPECT_FALSE(flies(flying(FlyKeys::usual, 'R', 0)));
}

TEST(CameraMoves, the_way_flown_does_not_depend_on_the_frame_rate) {
    for (const bool fast : {false, true}) {
        for (const int frames : {8, 60, 500}) {
            Camera camera = eye_ahead;
            FlyInput input = flying(FlyKeys::usual, 'D', 1.0f / static_cast<float>(frames));
            input.fast = fast;
            for (int i = 0; i < frames; ++i) camera = flown(camera, input);
            EXPECT_NEAR(camera.position.x, fast ? 8 : 2, 1e-3f) << frames;
        }
    }
    FlyInput input = flying(FlyKeys::usual, 'D', 0.1f);
    input.scene_radius = 100;
    EXPECT_NEAR(flown(eye_ahead, input).position.x, 2.5f, 1e-4f) << "a quarter of the scene per second";
    input.seconds = 60;
    EXPECT_LE(flown(eye_ahead, input).position.x, 0.26f * 25) << "a window that was held up";
}

TEST(CameraMoves, framing_shows_the_box_and_fills_the_narrow_side) {
    Dice dice(8);
    for (int i = 0; i < 100; ++i) {
        const Camera camera = dice.camera();
        Bounds box;
        box.include(dice.point(3));
        box.include(dice.point(3));
        const Vec2 size{i % 2 ? 1280.0f : 400.0f, 720};
        const Camera to = framed(camera, box, size);
        const Projection view(to, size);
        float widest = 0;
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 p{corner & 1 ? box.min.x : box.max.x, corner & 2 ? box.min.y : box.max.y,
                         corner & 4 ? box.min.z : box.max.z};
            const auto seen = view.project(p);
            ASSERT_TRUE(seen);
            EXPECT_TRUE(seen->pixel.x > -0.1f && seen->pixel.x < size.x + 0.1f);
            EXPECT_TRUE(seen->pixel.y > -0.1f && seen->pixel.y < size.y + 0.1f);
            widest = std::max(widest, std::max(std::abs(seen->pixel.x - size.x / 2) / (size.x / 2),
                                               std::abs(seen->pixel.y - size.y / 2) / (size.y / 2)));
        }
        EXPECT_GT(widest, 0.25f);
        expect_close(view.ahead(), Projection(camera, size).ahead(), 1e-4f);
    }
    EXPECT_EQ(framed(eye_ahead, {}, small_view), eye_ahead) << "an empty box";
    const Bounds point{{1, 2, 3}, {1, 2, 3}};
    EXPECT_EQ(framed(eye_ahead, point, small_view).target, (Vec3{1, 2, 3}));
    EXPECT_TRUE(Projection(framed(eye_ahead, point, small_view), small_view).valid());
    EXPECT_EQ(framed(eye_ahead, {{0, 0, 0}, {infinite, 1, 1}}, small_view), eye_ahead);
}

TEST(CameraMoves, views_along_axes) {
    const std::pair<ViewFrom, Vec3> sides[] = {{ViewFrom::right, {1, 0, 0}}, {ViewFrom::left, {-1, 0, 0}},
                                               {ViewFrom::top, {0, 1, 0}},   {ViewFrom::bottom, {0, -1, 0}},
                                               {ViewFrom::front, {0, 0, 1}}, {ViewFrom::back, {0, 0, -1}}};
    for (const auto& [side, from] : sides) {
        const Camera camera = seen_from(eye_ahead, side);
        EXPECT_EQ(camera.target, eye_ahead.target);
        expect_close(camera.position, eye_ahead.target + from * 2, 1e-6f);
        const Projection view(camera, small_view);
        expect_close(view.ahead(), -from, 1e-6f);
        // A small drag tilts it, and turns the image by no more than the drag.
        const Projection dragged(orbited_by(camera, {3, side == ViewFrom::bottom ? -3.0f : 3.0f}, small_view),
                                 small_view);
        EXPECT_GT(dot(dragged.right(), view.right()), 0.999f);
        EXPECT_GT(dot(dragged.down(), view.down()), 0.999f);
    }
}

TEST(CameraMoves, transitions_are_smooth_and_exact_at_both_ends) {
    Dice dice(9);
    for (int run = 0; run < 100; ++run) {
        Camera from = dice.camera(), to = dice.camera();
        if (run % 4 == 1) to = seen_from(from, ViewFrom::top);
        if (run % 4 == 2) from = seen_from(to, ViewFrom::bottom);
        const CameraTransition way{from, to};
        EXPECT_EQ(way.at(0), from);
        EXPECT_EQ(way.at(0.25f), to);
        EXPECT_EQ(way.at(9), to);
        EXPECT_FALSE(way.done(0.24f));
        EXPECT_TRUE(way.done(0.25f));
        Projection before(from, small_view);
        const float size = length(from.position - to.position) + length(from.target - to.target) +
                           target_distance(from) + target_distance(to);
        for (int i = 1; i <= 250; ++i) {
            const Camera now = way.at(0.001f * static_cast<float>(i));
            const Projection view(now, small_view);
            ASSERT_TRUE(view.valid());
            EXPECT_GT(dot(view.right(), before.right()), 0.999f) << run << ", " << i << ": it turns by at most 1.5 %";
            EXPECT_LT(length(now.position - before.camera().position), 0.03f * size);
            before = view;
        }
    }
    EXPECT_EQ(camera_between(eye_ahead, eye_ahead, nan_value), eye_ahead);
}

TEST(CameraMoves, malformed_input_changes_nothing) {
    const Vec2 bad{nan_value, 1};
    EXPECT_EQ(orbited_by(eye_ahead, bad, small_view), eye_ahead);
    EXPECT_EQ(looked_by(eye_ahead, {1, infinite}, small_view), eye_ahead);
    EXPECT_EQ(panned_by(eye_ahead, bad, small_view), eye_ahead);
    EXPECT_EQ(panned_by(eye_ahead, {1, 1}, {0, 0}), eye_ahead);
    EXPECT_EQ(panned_by(eye_ahead, {1, 1}, small_view, -1.0), eye_ahead);
    EXPECT_EQ(dollied(eye_ahead, nan_value, {1, 1}, small_view), eye_ahead);
    EXPECT_EQ(dollied(eye_ahead, 1, bad, small_view), eye_ahead);
    EXPECT_EQ(dollied(eye_ahead, 1, {1, 1}, small_view, Vec3{nan_value, 0, 0}), eye_ahead);
    EXPECT_EQ(flown(eye_ahead, flying(FlyKeys::usual, 'W', nan_value)), eye_ahead);
    const Camera inside{.position = {1, 1, 1}, .target = {1, 1, 1}, .fov = 40};
    for (const Camera& camera : {orbited_by(inside, {9, 9}, small_view), looked_by(inside, {9, 9}, small_view),
                                 panned_by(inside, {9, 9}, small_view), dollied(inside, 3, {1, 1}, small_view),
                                 flown(inside, flying(FlyKeys::usual, 'W', 0.1f)), seen_from(inside, ViewFrom::top)})
        EXPECT_TRUE(finite(camera.position) && finite(camera.target));
}

}  // namespace
}  // namespace weft::editor
