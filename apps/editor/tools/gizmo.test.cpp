#include "editor/tools/gizmo.h"

#include "editor/tools/random_views.test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace weft::editor {
namespace {

const GizmoPlace at_origin{};

Camera corner_camera(float distance) {
    return {.position = Vec3{0.5f, 0.6f, 0.7f} * distance, .target = {}, .fov = 40};
}

Vec2 middle_of(const GizmoShape& shape) {
    Double2 sum;
    for (const Vec2 p : shape.points) sum = sum + exact(p);
    return rounded(sum * (1.0 / static_cast<double>(shape.points.size())));
}

TEST(Gizmo, has_a_constant_size_on_the_screen) {
    for (const float distance : {0.2f, 2.0f, 200.0f}) {
        for (const float fov : {15.0f, 40.0f, 90.0f}) {
            Camera camera{.position = {0, 0, distance}, .target = {}, .fov = fov};
            const Gizmo gizmo(Projection(camera, usual_size), at_origin, GizmoKind::move, GizmoAxes::world);
            float right = 0, up = 1e9f;
            for (const GizmoShape& shape : gizmo.shapes(GizmoHandle::none)) {
                for (const Vec2 p : shape.points) right = std::max(right, p.x), up = std::min(up, p.y);
            }
            EXPECT_NEAR(right, 640 + 90, 0.1f) << distance << " m";
            EXPECT_NEAR(up, 360 - 90, 0.1f) << distance << " m";
        }
    }
}

TEST(Gizmo, every_handle_is_picked_where_it_is_drawn) {
    for (const GizmoKind kind : {GizmoKind::move, GizmoKind::turn, GizmoKind::scale}) {
        const Gizmo gizmo(Projection(corner_camera(3), usual_size), at_origin, kind, GizmoAxes::world);
        std::map<GizmoHandle, int> found;
        for (const GizmoShape& shape : gizmo.shapes(GizmoHandle::none)) {
            if (shape.faint) continue;
            const Vec2 at = shape.filled ? middle_of(shape) : shape.points[shape.points.size() / 3];
            EXPECT_EQ(gizmo.handle_at(at), shape.handle) << static_cast<int>(shape.handle);
            ++found[shape.handle];
        }
        EXPECT_EQ(found.size(), kind == GizmoKind::move ? 7u : 4u);
        EXPECT_EQ(gizmo.handle_at({100, 100}), GizmoHandle::none);
        EXPECT_EQ(gizmo.handle_at({nan_value, 100}), GizmoHandle::none);
    }
}

TEST(Gizmo, handles_are_picked_up_to_eight_pixels_beside_them) {
    const Camera camera{.position = {0, 0, 3}, .target = {}, .fov = 40};
    const Gizmo gizmo(Projection(camera, usual_size), at_origin, GizmoKind::move, GizmoAxes::world);
    EXPECT_EQ(gizmo.handle_at({640 + 60, 360 + 7.9f}), GizmoHandle::move_x);
    EXPECT_EQ(gizmo.handle_at({640 + 60, 360 + 8.1f}), GizmoHandle::none);
    EXPECT_EQ(gizmo.handle_at({640 - 7.9f, 360 - 60}), GizmoHandle::move_y);
    EXPECT_EQ(gizmo.handle_at({640 + 35, 360 - 35}), GizmoHandle::move_xy);
    EXPECT_EQ(gizmo.handle_at({640 + 3, 360}), GizmoHandle::move_view) << "the axis toward the eye is not in the way";
}

TEST(Gizmo, local_axes_turn_with_the_object) {
    const Camera camera{.position = {0, 0, 3}, .target = {}, .fov = 40};
    const GizmoPlace turned{{}, {0, 0, 90}};
    const Projection view(camera, usual_size);
    const Vec2 up{640, 360 - 60};
    EXPECT_EQ(Gizmo(view, turned, GizmoKind::move, GizmoAxes::world).handle_at(up), GizmoHandle::move_y);
    EXPECT_EQ(Gizmo(view, turned, GizmoKind::move, GizmoAxes::local).handle_at(up), GizmoHandle::move_x);
    EXPECT_EQ(Gizmo(view, turned, GizmoKind::scale, GizmoAxes::world).handle_at(up), GizmoHandle::scale_x);
}

TEST(Gizmo, what_is_far_comes_first_and_the_handle_is_highlighted) {
    Dice dice(50);
    for (int i = 0; i < 60; ++i) {
        const GizmoPlace place{dice.point(0.3f), dice.point(180)};
        const auto kind = static_cast<GizmoKind>(i % 3);
        const Gizmo gizmo(Projection(dice.camera(), usual_size), place, kind, GizmoAxes::local);
        const GizmoHandle handle = kind == GizmoKind::turn ? GizmoHandle::turn_y : GizmoHandle::none;
        const auto shapes = gizmo.shapes(handle);
        EXPECT_FALSE(shapes.empty());
        for (std::size_t k = 0; k < shapes.size(); ++k) {
            if (k > 0) {
                EXPECT_GE(shapes[k - 1].depth, shapes[k].depth);
            }
            EXPECT_EQ(shapes[k].highlighted, handle != GizmoHandle::none && shapes[k].handle == handle);
            for (const Vec2 p : shapes[k].points) EXPECT_TRUE(finite(p));
            EXPECT_GE(shapes[k].points.size(), 2u);
        }
    }
}

TEST(Gizmo, only_the_half_of_a_ring_that_faces_the_eye_is_picked) {
    const Camera camera{.position = {0, 1, 3}, .target = {}, .fov = 40};
    const Projection view(camera, usual_size);
    const Gizmo gizmo(view, at_origin, GizmoKind::turn, GizmoAxes::world);
    const auto radius = static_cast<float>(90 / view.pixels_per_meter(static_cast<double>(std::sqrt(10.0f))));
    const Vec3 direction = normalized(Vec3{0.3f, 0, 1});
    EXPECT_EQ(gizmo.handle_at(view.project(direction * radius)->pixel), GizmoHandle::turn_y);
    EXPECT_NE(gizmo.handle_at(view.project(direction * -radius)->pixel), GizmoHandle::turn_y);
}

TEST(Gizmo, is_invisible_behind_the_camera_and_where_nothing_is_finite) {
    const Projection view(Camera{.position = {0, 0, 3}, .target = {}, .fov = 40}, usual_size);
    const GizmoPlace places[] = {{{0, 0, 4}, {}}, {{nan_value, 0, 0}, {}}, {{}, {nan_value, 0, 0}}};
    for (const GizmoPlace& place : places) {
        const Gizmo gizmo(view, place, GizmoKind::turn, GizmoAxes::local);
        EXPECT_FALSE(gizmo.visible());
        EXPECT_TRUE(gizmo.shapes(GizmoHandle::turn_x).empty());
        EXPECT_FALSE(gizmo.start_drag(GizmoHandle::turn_x, {640, 360}));
    }
    const Gizmo gizmo(view, at_origin, GizmoKind::move, GizmoAxes::world);
    EXPECT_FALSE(gizmo.start_drag(GizmoHandle::none, {640, 360}));
    EXPECT_FALSE(gizmo.start_drag(GizmoHandle::move_x, {nan_value, 360}));
    const Camera wide{.position = {0, 0, 3}, .target = {}, .fov = 150};
    for (const GizmoShape& shape :
         Gizmo(Projection(wide, {200, 40}), at_origin, GizmoKind::turn, GizmoAxes::world).shapes(GizmoHandle::none))
        for (const Vec2 p : shape.points) EXPECT_LT(length(exact(p) - Double2{100, 20}), 100);
}

}  // namespace
}  // namespace weft::editor
