#include "editor/tools/projection.h"

#include "editor/tools/random_views.test.h"
#include "look/view_limits.h"
#include "render/frame_data.h"

#include <gtest/gtest.h>

namespace weft::editor {
namespace {

constexpr Camera straight_ahead{.position = {0, 1, 2}, .target = {0, 1, 0}, .fov = 60};

TEST(Projection, maps_the_corners_of_the_image) {
    const Projection view(straight_ahead, {800, 600});
    const float high = 2 * std::tan(30 * 3.14159265f / 180), wide = high * 800 / 600;
    const auto expect_pixel = [&](Vec3 world, Vec2 pixel) {
        const auto seen = view.project(world);
        ASSERT_TRUE(seen);
        EXPECT_NEAR(seen->pixel.x, pixel.x, 1e-3f);
        EXPECT_NEAR(seen->pixel.y, pixel.y, 1e-3f);
        EXPECT_NEAR(seen->depth, 2, 1e-6f);
    };
    expect_pixel({0, 1, 0}, {400, 300});
    expect_pixel({0, 1 + high, 0}, {400, 0});
    expect_pixel({-wide, 1 - high, 0}, {0, 600});
    expect_pixel({wide, 1, 0}, {800, 300});
    EXPECT_NEAR(view.pixels_per_meter(2), 300 / high, 1e-3);
    expect_close(view.right(), {1, 0, 0}, 1e-6f);
    expect_close(view.down(), {0, -1, 0}, 1e-6f);
    expect_close(view.ahead(), {0, 0, -1}, 1e-6f);
}

TEST(Projection, a_ray_meets_the_point_of_its_pixel) {
    Dice dice(1);
    for (int i = 0; i < 500; ++i) {
        const Projection view(dice.camera(), usual_size);
        const Vec3 point = dice.point(0.6f);
        const auto seen = view.project(point);
        if (!seen) continue;
        const auto ray = view.ray(seen->pixel);
        ASSERT_TRUE(ray);
        const Vec3 off = point - ray->origin;
        EXPECT_LT(length(off - ray->direction * dot(off, ray->direction)), 2e-6f);
        expect_close(view.at(seen->pixel, static_cast<double>(seen->depth)), point, 2e-6f);
    }
}

TEST(Projection, is_that_of_the_renderer) {
    Dice dice(2);
    for (int i = 0; i < 300; ++i) {
        Camera camera = dice.camera();
        if (i % 3 == 1) camera.position = camera.target + Vec3{0, i % 2 ? 2.0f : -2.0f, 0};
        if (i % 3 == 2) camera.position = camera.target + Vec3{0.003f, 2, 0.004f};  // 0.14° from straight down
        render::Drawing drawing;
        drawing.camera = camera;
        const auto data = render::frame_data(drawing, {}, {.width = 1280, .height = 720});
        const Projection view(camera, usual_size);
        const Vec3 point = dice.point(0.7f);
        const auto clip = data.to_clip * shading::vec4(point.x, point.y, point.z, 1);
        const auto seen = view.project(point);
        ASSERT_EQ(seen.has_value(), clip.z >= 0) << i;
        if (!seen) continue;
        // A camera close to the vertical has a direction to the right of rounded floats.
        const float tolerance = i % 3 == 2 ? 1.0f : 0.05f;
        EXPECT_NEAR(seen->pixel.x, (clip.x / clip.w + 1) * usual_size.x / 2, tolerance) << i;
        EXPECT_NEAR(seen->pixel.y, (clip.y / clip.w + 1) * usual_size.y / 2, tolerance) << i;
    }
}

TEST(Projection, image_does_not_turn_where_a_camera_becomes_vertical) {
    for (const float above : {1.0f, -1.0f}) {
        Camera camera{.position = {0, above, 0}, .target = {}, .fov = 40};
        const Projection vertical(camera, usual_size);
        camera.position.z = 0.0017f;  // the steepest tilt that user input reaches, looking along -z
        const Projection tilted(camera, usual_size);
        expect_close(vertical.right(), {1, 0, 0}, 1e-6f);
        expect_close(tilted.right(), {1, 0, 0}, 1e-6f);
        expect_close(tilted.down(), vertical.down(), 0.002f);
        EXPECT_NEAR(vertical.down().z, above, 1e-6f);
    }
}

TEST(Projection, nothing_is_behind_the_near_plane) {
    const Projection view(straight_ahead, {800, 600});
    EXPECT_FLOAT_EQ(static_cast<float>(view.nearest_depth()), 0.01f);
    EXPECT_TRUE(view.project({0, 1, 1.98f}));
    EXPECT_FALSE(view.project({0, 1, 1.995f}));
    EXPECT_FALSE(view.project({0, 1, 3}));
}

TEST(Projection, degenerate_cameras_see_nothing) {
    const Camera inside{.position = {1, 1, 1}, .target = {1, 1, 1}, .fov = 40};
    const Camera nowhere{.position = {nan_value, 0, 0}, .target = {}, .fov = 40};
    const Camera far_off{.position = {0, 0, infinite}, .target = {}, .fov = 40};
    const Camera flat{.position = {0, 0, 1}, .target = {}, .fov = 0};
    const Camera unknown{.position = {0, 0, 1}, .target = {}, .fov = nan_value};
    for (const Camera& camera : {inside, nowhere, far_off, flat, unknown}) {
        const Projection view(camera, usual_size);
        EXPECT_FALSE(view.valid());
        EXPECT_FALSE(view.ray({10, 10}));
        EXPECT_FALSE(view.project({}));
    }
    for (const Vec2 size : {Vec2{0, 720}, Vec2{1280, -1}, Vec2{nan_value, 720}, Vec2{infinite, 720}})
        EXPECT_FALSE(Projection(straight_ahead, size).valid());
    const Projection view(straight_ahead, usual_size);
    EXPECT_FALSE(view.ray({nan_value, 3}));
    EXPECT_FALSE(view.ray({3, infinite}));
    EXPECT_FALSE(view.project({0, nan_value, 0}));
}

}  // namespace
}  // namespace weft::editor
