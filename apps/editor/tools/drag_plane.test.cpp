#include "editor/tools/drag_plane.h"

#include "editor/tools/random_views.test.h"

#include <gtest/gtest.h>

namespace weft::editor {
namespace {

TEST(DragPlane, the_point_stays_under_the_pointer_and_in_its_plane) {
    Dice dice(3);
    for (int i = 0; i < 300; ++i) {
        const Projection view(dice.camera(), usual_size);
        const Vec3 point = dice.point(0.4f);
        const auto seen = view.project(point);
        if (!seen) continue;
        const Vec2 pointer{seen->pixel.x + 3, seen->pixel.y - 2};  // a few pixels beside the point
        const auto plane = grab(view, point, pointer);
        ASSERT_TRUE(plane);
        const auto unmoved = pulled_to(*plane, view, pointer);
        ASSERT_TRUE(unmoved);
        expect_close(*unmoved, point, 3e-6f);
        const Vec2 to = dice.pixel();
        const auto pulled = pulled_to(*plane, view, to);
        ASSERT_TRUE(pulled);
        const auto shown = view.project(*pulled);
        ASSERT_TRUE(shown);
        EXPECT_NEAR(shown->pixel.x, to.x - 3, 0.01f);
        EXPECT_NEAR(shown->pixel.y, to.y + 2, 0.01f);
        EXPECT_NEAR(shown->depth, seen->depth, 1e-5f);
    }
}

TEST(DragPlane, the_wheel_moves_it_by_a_tenth_and_never_through_the_eye) {
    const Projection view(Camera{.position = {0, 0, 2}, .target = {}, .fov = 60}, usual_size);
    const auto plane = grab(view, {0.3f, 0.1f, 0}, view.project({0.3f, 0.1f, 0})->pixel);
    ASSERT_TRUE(plane);
    EXPECT_NEAR(pushed(*plane, view, -1).depth, 1.8, 1e-6);
    EXPECT_NEAR(pushed(*plane, view, 1).depth, 2 / 0.9, 1e-6);
    EXPECT_NEAR(pushed(pushed(*plane, view, 2), view, -2).depth, 2, 1e-6);
    EXPECT_NEAR(pushed(*plane, view, -1000).depth, 2 * view.nearest_depth(), 1e-9);
    EXPECT_LE(pushed(*plane, view, 1000).depth, 1e5);
    EXPECT_EQ(pushed(*plane, view, nan_value).depth, plane->depth);
}

TEST(DragPlane, degenerate_pointers_and_points_grab_nothing) {
    const Projection view(Camera{.position = {0, 0, 2}, .target = {}, .fov = 60}, usual_size);
    EXPECT_FALSE(grab(view, {0, 0, 3}, {100, 100})) << "behind the eye";
    EXPECT_FALSE(grab(view, {nan_value, 0, 0}, {100, 100}));
    EXPECT_FALSE(grab(view, {}, {nan_value, 100}));
    EXPECT_FALSE(pulled_to(*grab(view, {}, {100, 100}), view, {100, infinite}));
    const Projection nothing(Camera{.position = {}, .target = {}, .fov = 60}, usual_size);
    EXPECT_FALSE(pulled_to(*grab(view, {}, {100, 100}), nothing, {100, 100}));
}

}  // namespace
}  // namespace weft::editor
