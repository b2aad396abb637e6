#include "editor/tools/gizmo_drag.h"

#include "base/transform.h"
#include "editor/tools/gizmo.h"
#include "editor/tools/random_views.test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace weft::editor {
namespace {

constexpr GizmoSnap no_steps{0, 0, 0};

Vec3 axis_number(const GizmoPlace& place, GizmoAxes axes, std::size_t i) {
    const Mat3 r = axes == GizmoAxes::local ? rotation_from_degrees(place.rotation_degrees) : Mat3{};
    return i == 0 ? r.x : i == 1 ? r.y : r.z;
}

/// Sine of the angle between an axis and the line of sight.
float steepness(const Projection& view, Vec3 at, Vec3 axis) {
    return length(cross(normalized(at - view.camera().position), axis));
}

Double2 pixel_of(const Projection& view, Vec3 point) {
    const auto seen = view.project(point);
    EXPECT_TRUE(seen);
    return seen ? exact(seen->pixel) : Double2{};
}

GizmoDrag drag_of(const Projection& view, const GizmoPlace& place, GizmoHandle handle, Vec2 from,
                  GizmoAxes axes = GizmoAxes::world) {
    const GizmoKind kind = handle >= GizmoHandle::scale_x  ? GizmoKind::scale
                           : handle >= GizmoHandle::turn_x ? GizmoKind::turn
                                                           : GizmoKind::move;
    auto drag = Gizmo(view, place, kind, axes).start_drag(handle, from);
    EXPECT_TRUE(drag);
    return *drag;
}

GizmoHandle handle_after(GizmoHandle first, std::size_t by) {
    return static_cast<GizmoHandle>(static_cast<std::size_t>(first) + by);
}

/// A point of a handle as it is drawn: the tip of an arrow, the middle of a square.
std::optional<Double2> point_of(const Projection& view, const GizmoPlace& place, GizmoHandle handle, GizmoAxes axes) {
    for (const GizmoShape& shape : Gizmo(view, place, GizmoKind::move, axes).shapes(GizmoHandle::none)) {
        if (shape.handle != handle || !shape.filled || shape.faint) continue;
        if (handle <= GizmoHandle::move_z) return exact(shape.points.front());
        Double2 middle;
        for (const Vec2 p : shape.points) middle = middle + exact(p) * 0.25;
        return middle;
    }
    return {};
}

/// The same point of the square's plane, with the perspective that its corners' mean ignores.
Double2 middle_of_square(const Projection& view, const GizmoPlace& place, std::size_t normal, GizmoAxes axes) {
    const auto depth = static_cast<double>(view.project(place.position)->depth);
    const double size = std::min(90 / view.pixels_per_meter(depth), 0.4 * depth);
    const Vec3 diagonal = axis_number(place, axes, (normal + 1) % 3) + axis_number(place, axes, (normal + 2) % 3);
    return pixel_of(view, place.position + diagonal * static_cast<float>(0.39 * size));
}

TEST(GizmoDrag, the_grabbed_point_of_an_arrow_stays_under_the_pointer) {
    Dice dice(60);
    int dragged = 0, limited = 0;
    double worst = 0, center_off = 0;
    for (int i = 0; i < 3000; ++i) {
        const Projection view(dice.camera(), usual_size);
        const GizmoPlace place{dice.point(0.4f), dice.point(180)};
        const auto axes = static_cast<GizmoAxes>(i % 2);
        const std::size_t number = static_cast<std::size_t>(i) % 3;
        const GizmoHandle handle = handle_after(GizmoHandle::move_x, number);
        const Vec3 axis = axis_number(place, axes, number);
        if (!view.project(place.position) || steepness(view, place.position, axis) < 0.16f) continue;
        const auto tip = point_of(view, place, handle, axes);
        ASSERT_TRUE(tip);
        // 200 pixels along the arrow as it is seen, and some beside it.
        const Double2 start = pixel_of(view, place.position);
        const Double2 ahead = pixel_of(view, place.position + axis * 0.01f) - start;
        const Double2 along = ahead * (1 / length(ahead)), beside{-along.y, along.x};
        const GizmoDrag drag = drag_of(view, place, handle, rounded(*tip), axes);
        for (const double way : {200.0, -200.0, 3.0, 77.0}) {
            const Vec2 pointer = rounded(*tip + along * way + beside * static_cast<double>(dice.between(-40, 40)));
            const GizmoChange change = drag.at(pointer, no_steps);
            const Vec3 moved = change.place.position - place.position;
            EXPECT_LT(length(cross(moved, axis)), 1e-4f * std::max(1.0f, length(moved))) << "it stays on the axis";
            EXPECT_EQ(change.place.rotation_degrees, place.rotation_degrees);
            const float depth = dot(change.place.position - view.camera().position, view.ahead());
            const float from = dot(place.position - view.camera().position, view.ahead());
            if (depth > 19.9f * from || depth < from / 19.9f) {
                ++limited;
                continue;
            }
            const auto now = point_of(view, change.place, handle, axes);
            if (!now) continue;  // seen end on there
            ++dragged;
            // After a long way into the depth, floats resolve the place only to some hundredths of a pixel.
            worst = std::max(worst, length(*now - (*tip + along * way)));
            center_off = std::max(center_off, length(pixel_of(view, change.place.position) - (start + along * way)));
        }
    }
    EXPECT_LT(worst, 2) << "pixels";
    EXPECT_LT(worst, 0.1) << "what rounding of floats leaves";
    EXPECT_GT(center_off, 5) << "the object itself gets larger or smaller on the image";
    EXPECT_GT(dragged, 8000);
    EXPECT_LT(limited, dragged / 20);
}

TEST(GizmoDrag, the_grabbed_point_of_a_square_stays_under_the_pointer) {
    Dice dice(61);
    int dragged = 0;
    double worst = 0;
    for (int i = 0; i < 2000; ++i) {
        const Projection view(dice.camera(), usual_size);
        const GizmoPlace place{dice.point(0.4f), dice.point(180)};
        const auto axes = static_cast<GizmoAxes>(i % 2);
        const std::size_t number = static_cast<std::size_t>(i) % 4;
        const GizmoHandle handle = handle_after(GizmoHandle::move_yz, number);
        if (!view.project(place.position)) continue;
        const Vec3 normal = number < 3 ? axis_number(place, axes, number) : view.ahead();
        if (std::abs(dot(normal, normalized(place.position - view.camera().position))) < 0.16f) continue;
        const auto square = [&](const GizmoPlace& at) {
            return number < 3 ? middle_of_square(view, at, number, axes) : pixel_of(view, at.position);
        };
        const Double2 grabbed = square(place);
        const GizmoDrag drag = drag_of(view, place, handle, rounded(grabbed), axes);
        const Double2 way{static_cast<double>(dice.between(-200, 200)), static_cast<double>(dice.between(-200, 200))};
        const GizmoChange change = drag.at(rounded(grabbed + way), no_steps);
        const Vec3 moved = change.place.position - place.position;
        EXPECT_LT(std::abs(dot(moved, normal)), 1e-4f * std::max(1.0f, length(moved)));
        const float depth = dot(change.place.position - view.camera().position, view.ahead());
        const float from = dot(place.position - view.camera().position, view.ahead());
        if (depth > 19.9f * from || depth < from / 19.9f) continue;
        ++dragged;
        worst = std::max(worst, length(square(change.place) - grabbed - way));
    }
    EXPECT_LT(worst, 0.1);
    EXPECT_GT(dragged, 1200);
}

TEST(GizmoDrag, a_drag_toward_a_vanishing_point_ends) {
    // The x axis leads away from the eye, to the right.
    const Camera camera{.position = {-3, 0.6f, 2}, .target = {}, .fov = 60};
    const Projection view(camera, usual_size);
    const GizmoPlace place{};
    for (const GizmoHandle handle : {GizmoHandle::move_x, GizmoHandle::move_zx}) {
        const GizmoDrag drag = drag_of(view, place, handle, {640, 360});
        float before = 0;
        for (int i = 0; i < 4000; i += 5) {
            const Vec3 now =
                drag.at({640 + static_cast<float>(i), 360 - static_cast<float>(i) / 2}, no_steps).place.position;
            EXPECT_TRUE(finite(now));
            const float depth = dot(now - camera.position, view.ahead());
            const float start = length(camera.position);
            EXPECT_LE(depth, 20.01f * start);
            EXPECT_GE(depth, start / 20.01f);
            EXPECT_GE(depth, before - 1e-3f * start) << "it never comes back";
            before = depth;
        }
        EXPECT_NEAR(before, 20 * length(camera.position), 0.1f);
    }
}

TEST(GizmoDrag, seen_end_on_an_object_moves_with_the_pointer_as_in_the_image) {
    Dice dice(62);
    for (int i = 0; i < 300; ++i) {
        // The z axis is seen within 5° of end on.
        const float tilt = i == 0 ? 0 : dice.between(0, 0.08f), turn = dice.between(0, 6.28f);
        const Camera camera{.position = {3 * tilt * std::cos(turn), 3 * tilt * std::sin(turn), i % 2 ? 3.0f : -3.0f},
                            .target = {},
                            .fov = 40};
        const Projection view(camera, usual_size);
        const GizmoDrag arrow = drag_of(view, {}, GizmoHandle::move_z, {640, 360});
        const GizmoDrag square = drag_of(view, {}, GizmoHandle::move_yz, {640, 360});
        const float meters =
            1 / static_cast<float>(view.pixels_per_meter(static_cast<double>(length(camera.position))));
        Vec3 arrow_before, square_before;
        for (int k = 1; k <= 200; ++k) {
            const Vec2 pointer{640 + static_cast<float>(k) * 0.6f, 360 - static_cast<float>(k) * 0.8f};
            const Vec3 a = arrow.at(pointer, no_steps).place.position, s = square.at(pointer, no_steps).place.position;
            EXPECT_EQ(a.x, 0);
            EXPECT_EQ(a.y, 0);
            EXPECT_LT(length(a - arrow_before), 1.01f * meters) << "no more than a pixel's way";
            EXPECT_NEAR(s.x, 0, 1e-6f);
            EXPECT_LT(length(s - square_before), 1.5f * meters);
            arrow_before = a, square_before = s;
        }
        if (i == 0) {
            EXPECT_NEAR(arrow_before.z, 160 * meters, 1e-4f) << "up is away from the eye";
        }
    }
}

TEST(GizmoDrag, a_ring_turns_as_far_as_the_pointer_goes_along_its_tangent) {
    const Camera camera{.position = {0, 0, 3}, .target = {}, .fov = 40};
    const Projection view(camera, usual_size);
    // Seen from the front: the ring about z has a radius of 90 pixels, and was grabbed at the right.
    const GizmoDrag right = drag_of(view, {}, GizmoHandle::turn_z, {640 + 90, 360});
    const auto angle = [&](float pixels) { return pixels / 90 * 180 / std::numbers::pi_v<float>; };
    EXPECT_NEAR(right.at({730, 350}).amount.x, angle(10), 1e-2f);
    EXPECT_NEAR(right.at({730, 360 + 1000}).place.rotation_degrees.z, -angle(1000), 0.5f) << "more than a turn";
    EXPECT_NEAR(right.at({900, 360}).amount.x, 0, 0.1f) << "across the ring";
    const GizmoDrag top = drag_of(view, {}, GizmoHandle::turn_z, {640, 360 - 90});
    EXPECT_NEAR(top.at({630, 270}).amount.x, angle(10), 1e-2f);
    // Seen end on, grabbed in the middle and at the end: the near side goes with the pointer.
    for (const float x : {640.0f, 640.0f + 89, 640.0f - 89}) {
        const GizmoDrag drag = drag_of(view, {}, GizmoHandle::turn_y, {x, 360});
        EXPECT_NEAR(drag.at({x + 45, 360}).amount.x, angle(45), 0.05f);
        EXPECT_NEAR(drag.at({x + 45, 400}).place.rotation_degrees.y, angle(45), 0.05f);
    }
    // The outer ring turns about the axis to the eye.
    const GizmoDrag outer = drag_of(view, {}, GizmoHandle::turn_view, {640 + 108, 360});
    EXPECT_NEAR(outer.at({748, 350}).place.rotation_degrees.z, angle(10) / 1.2f, 1e-2f);
}

TEST(GizmoDrag, the_angle_of_a_ring_is_continuous_through_end_on_views_and_full_turns) {
    Dice dice(63);
    for (int i = 0; i < 24; ++i) {
        // Every second ring is seen end on within 3°.
        GizmoPlace place{};
        if (i % 3 == 0) place.rotation_degrees = dice.point(180);
        Camera camera = dice.camera();
        if (i % 2)
            camera.position = camera.target + Vec3{3 * std::cos(dice.between(0, 6)), dice.between(-0.15f, 0.15f), 3};
        const Projection view(camera, usual_size);
        if (!view.project({})) continue;
        const GizmoHandle handle =
            i % 2 ? GizmoHandle::turn_y : handle_after(GizmoHandle::turn_x, static_cast<std::size_t>(i / 2) % 4);
        const auto center = view.project(place.position)->pixel;
        const float turn = dice.between(0, 6.28f);
        const Vec2 from{center.x + 90 * std::cos(turn), center.y + 90 * std::sin(turn)};
        const GizmoDrag drag = drag_of(view, place, handle, from, i % 3 ? GizmoAxes::world : GizmoAxes::local);
        const float way = dice.between(0, 6.28f);
        const Vec2 step{std::cos(way), std::sin(way)};  // one pixel
        float before = 0;
        for (int k = 1; k <= 700; ++k) {
            const auto far = static_cast<float>(k);
            const float now = drag.at({from.x + far * step.x, from.y + far * step.y}).amount.x;
            EXPECT_LT(std::abs(now - before), 0.66f) << "a pixel is 0.64° at most";
            before = now;
        }
        // Straight through the center: from one side of the ring to the other.
        before = 0;
        for (int k = 1; k <= 180; ++k) {
            const float part = 2 * static_cast<float>(k) / 180;
            const float now =
                drag.at({from.x + (center.x - from.x) * part, from.y + (center.y - from.y) * part}).amount.x;
            EXPECT_LT(std::abs(now - before), 0.66f);
            before = now;
        }
    }
}

TEST(GizmoDrag, a_ring_turns_the_grabbed_point_with_the_pointer) {
    Dice dice(64);
    int followed = 0;
    for (int i = 0; i < 500; ++i) {
        const Projection view(dice.camera(), usual_size);
        const GizmoPlace place{dice.point(0.3f), dice.point(180)};
        if (!view.project(place.position)) continue;
        const Vec3 axis = axis_number(place, GizmoAxes::local, static_cast<std::size_t>(i) % 3);
        const Vec3 to_eye = normalized(view.camera().position - place.position);
        if (std::abs(dot(axis, to_eye)) > 0.9f) continue;
        // A point of the near half.
        const Vec3 u = normalized(to_eye - axis * dot(axis, to_eye)), v = cross(axis, u);
        const float turn = dice.between(-0.8f, 0.8f);
        const auto depth = static_cast<double>(view.project(place.position)->depth);
        const Vec3 arm =
            (u * std::cos(turn) + v * std::sin(turn)) * static_cast<float>(90 / view.pixels_per_meter(depth));
        const Double2 grabbed = pixel_of(view, place.position + arm);
        const Vec3 tangent = cross(axis, arm) * 0.01f;
        const Double2 along = pixel_of(view, place.position + arm + tangent) - grabbed;
        const GizmoDrag drag = drag_of(view, place, handle_after(GizmoHandle::turn_x, static_cast<std::size_t>(i) % 3),
                                       rounded(grabbed), GizmoAxes::local);
        const GizmoChange change = drag.at(rounded(grabbed + along * (10 / length(along))));
        EXPECT_GT(change.amount.x, 0) << "in the direction of the pointer";
        const Mat3 by = rotation_from_degrees(change.place.rotation_degrees) *
                        transposed(rotation_from_degrees(place.rotation_degrees));
        expect_close(by * axis, axis, 1e-4f);
        EXPECT_GT(dot(by * arm, tangent), 0) << "the object turns that way";
        ++followed;
    }
    EXPECT_GT(followed, 250);
}

TEST(GizmoDrag, scale_handles_stay_under_the_pointer) {
    const Camera camera{.position = {0, 0, 3}, .target = {}, .fov = 40};
    const Projection view(camera, usual_size);
    const GizmoDrag x = drag_of(view, {}, GizmoHandle::scale_x, {730, 360});
    expect_close(x.at({775, 380}, no_steps).scale, {1.5f, 1, 1}, 1e-5f);
    expect_close(x.at({-5000, 360}, no_steps).scale, {0.01f, 1, 1}, 1e-6f);
    const GizmoDrag all = drag_of(view, {}, GizmoHandle::scale_all, {640, 360});
    expect_close(all.at({640 + 45, 360}, no_steps).scale, {1.5f, 1.5f, 1.5f}, 1e-5f);
    expect_close(all.at({640, 360 - 45}, no_steps).scale, {1.5f, 1.5f, 1.5f}, 1e-5f);
    expect_close(all.at({640, 5000}, no_steps).scale, {0.01f, 0.01f, 0.01f}, 1e-6f);
    const GizmoDrag end_on = drag_of(view, {}, GizmoHandle::scale_z, {640, 360});
    expect_close(end_on.at({640, 333}, no_steps).scale, {1, 1, 2}, 1e-5f);
}

TEST(GizmoDrag, snaps_to_steps_from_the_start) {
    const Camera camera{.position = {0, 0, 3}, .target = {}, .fov = 40};
    const Projection view(camera, usual_size);
    const auto meter = static_cast<float>(view.pixels_per_meter(3));
    const GizmoPlace place{{0.03f, 0, 0}, {0, 0, 7}};
    const GizmoSnap steps;
    const GizmoDrag x = drag_of(view, place, GizmoHandle::move_x, {640, 360});
    EXPECT_NEAR(x.at({640 + 0.26f * meter, 360}, steps).place.position.x, 0.33f, 1e-5f);
    EXPECT_NEAR(x.at({640 + 0.26f * meter, 360}, {0.25f, 15, 0.1f}).place.position.x, 0.28f, 1e-5f);
    const GizmoDrag xy = drag_of(view, place, GizmoHandle::move_xy, {640, 360});
    expect_close(xy.at({640 + 0.26f * meter, 360 - 0.11f * meter}, steps).place.position, {0.33f, 0.1f, 0}, 1e-5f);
    const GizmoDrag z = drag_of(view, place, GizmoHandle::turn_z, {730, 360});
    EXPECT_EQ(z.at({730, 330}, steps).amount.x, 15);
    EXPECT_NEAR(z.at({730, 330}, steps).place.rotation_degrees.z, 22, 1e-4f);
    const GizmoDrag s = drag_of(view, {}, GizmoHandle::scale_x, {730, 360});
    expect_close(s.at({730 + 90 * 0.26f, 360}, steps).scale, {1.3f, 1, 1}, 1e-6f);
}

TEST(GizmoDrag, depends_on_start_and_pointer_alone_and_gives_the_start_back) {
    Dice dice(65);
    for (int i = 0; i < 200; ++i) {
        const Projection view(dice.camera(), usual_size);
        const GizmoPlace place{dice.point(0.4f), dice.point(400)};
        if (!view.project(place.position)) continue;
        const auto handle = static_cast<GizmoHandle>(1 + i % 15);
        const Vec2 from = dice.pixel(), to = dice.pixel();
        const GizmoDrag drag = drag_of(view, place, handle, from, GizmoAxes::local);
        EXPECT_EQ(drag.start(), place);
        EXPECT_EQ(drag.at(from).place, place) << "to the bit";
        expect_close(drag.at(from).scale, {1, 1, 1}, 0);
        const GizmoChange direct = drag.at(to, no_steps);
        for (int k = 0; k < 20; ++k) drag.at(dice.pixel(), no_steps);
        EXPECT_EQ(drag.at(to, no_steps).place, direct.place);
        EXPECT_EQ(drag.at(to, no_steps).scale, direct.scale);
        EXPECT_EQ(drag.at({nan_value, 3}).place, place);
        EXPECT_EQ(drag.at({3, infinite}).place, place);
        EXPECT_TRUE(finite(direct.place.position) && finite(direct.place.rotation_degrees));
        const GizmoChange typed = drag.by(direct.amount);
        EXPECT_EQ(typed.place, direct.place) << "a typed number does what the drag shows";
        EXPECT_EQ(typed.scale, direct.scale);
    }
}

}  // namespace
}  // namespace weft::editor
