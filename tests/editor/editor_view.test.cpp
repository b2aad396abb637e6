// Tools of the pointer in the editor's view.
#include "editor_fixture.h"

#include <cmath>

namespace weft::editor {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST_F(EditorWindow, arrows_move_an_object_along_their_axes_and_stay_under_the_pointer) {
    DrivenEditor& e = open(empty);
    pause();
    e.click("objects/add/box");
    e.key("3");
    const std::string object = "/colliders/1";
    for (const int axis : {0, 1, 2}) {
        const std::string handle = std::string("middle/view/gizmo/move_") + "xyz"[axis];
        SCOPED_TRACE(handle);
        const Position before = position_of(object);
        const Point center = e.place("middle/view/gizmo/center").at(0, 0), from = e.place(handle).at(0, 0);
        const Point direction = (from - center) * (1 / length(from - center));
        const Point start{std::floor(from.x), std::floor(from.y)};
        e.drag(start, start + direction * 200);
        const Position after = position_of(object);
        const double moved[] = {after.x - before.x, after.y - before.y, after.z - before.z};
        for (int other = 0; other < 3; ++other) {
            if (other == axis)
                EXPECT_GT(moved[other], 0.1);
            else
                EXPECT_EQ(moved[other], 0) << other;
        }
        const Point end{std::floor(start.x + direction.x * 200), std::floor(start.y + direction.y * 200)};
        const Point expected = end + (from - start), now = e.place(handle).at(0, 0);
        EXPECT_LE(length(now - expected), 2)
            << now.x << ", " << now.y << " and not " << expected.x << ", " << expected.y;
        e.key("ctrl+z");
        EXPECT_EQ(position_of(object).x, before.x) << "a drag is one step";
        EXPECT_EQ(position_of(object).y, before.y);
        EXPECT_EQ(position_of(object).z, before.z);
    }
    // Esc takes a drag back, and what follows of it does nothing.
    const Position before = position_of(object);
    const Point from = e.place("middle/view/gizmo/move_x").center();
    e.point_at(from);
    e.press();
    e.move(from + Point{60, 10});
    EXPECT_NE(position_of(object).x, before.x);
    e.key("Escape");
    EXPECT_EQ(position_of(object).x, before.x);
    e.move(from + Point{90, 10});
    e.release();
    EXPECT_EQ(position_of(object).x, before.x);
    EXPECT_TRUE(e.shows("properties/colliders/1/name")) << "Esc has taken the drag back and no more";
    undo_everything();
    expect_nothing_is_left();
}

TEST_F(EditorWindow, rings_turn_without_a_jump_and_scale_handles_scale) {
    DrivenEditor& e = open(empty);
    pause();
    e.click("objects/add/box");
    e.key("4");
    const std::string rotation = "properties/colliders/1/transform/rotation/";
    for (const char axis : {'x', 'y', 'z'}) {
        SCOPED_TRACE(axis);
        const std::size_t logged = e.actions("change").size();
        const Point center = e.place("middle/view/gizmo/center").center();
        const Point from = e.place(std::string("middle/view/gizmo/turn_") + axis).center();
        e.point_at(from);
        e.press();
        // Past the end of the ring that faces the eye, so through where it is seen edge-on.
        constexpr int moves = 24;
        const Point step = (center - from) * (2.0 / moves) + Point{1, 1};  // and the rounding to pixels
        e.move(from + (center - from) * 2.0, moves);
        e.release();
        const std::vector<Action> all = e.actions("change");
        ASSERT_GT(all.size(), logged + 8);
        double last = 0;
        for (std::size_t i = logged; i < all.size(); ++i) {
            const double now = value_of(all[i]).at(static_cast<std::size_t>(axis - 'x'));
            // A pixel along the ring is 0.64°.
            EXPECT_LT(std::abs(std::remainder(now - last, 360)), 0.7 * length(step)) << "move " << i - logged;
            last = now;
        }
        EXPECT_GT(std::abs(e.number(rotation + axis)), 1);
        e.key("ctrl+z");
        EXPECT_EQ(e.number(rotation + axis), 0);
    }
    e.key("5");
    e.click("properties/colliders/1/box");
    const std::string half = "properties/colliders/1/box/half_extents/";
    const double before = e.number(half + "x");
    const Point center = e.place("middle/view/gizmo/center").center(),
                from = e.place("middle/view/gizmo/scale_x").center();
    e.drag(from, from + (from - center) * 0.5);
    EXPECT_GT(e.number(half + "x"), before * 1.2);
    EXPECT_EQ(e.number(half + "y"), before);
    EXPECT_EQ(e.number(half + "z"), before);
    undo_everything();
    expect_nothing_is_left();
}

TEST_F(EditorWindow, a_ring_that_is_seen_edge_on_turns_with_the_pointer) {
    DrivenEditor& e = open(level);
    pause();
    e.click("objects/add/box");
    e.key("4");
    const Point from = e.place("middle/view/gizmo/turn_y").center();
    e.point_at(from);
    e.press();
    double last = 0;
    for (int i = 1; i <= 30; ++i) {
        e.move(from + Point{10.0 * i, i % 2 ? 6.0 : -6.0}, 1);
        const double now = e.number("properties/colliders/1/transform/rotation/y");
        EXPECT_NEAR(std::remainder(now - last, 360), 6.4, 0.4) << i;
        last = now;
    }
    e.release();
    undo_everything();
    expect_nothing_is_left();
}

TEST_F(EditorWindow, amounts_are_typed_during_a_drag_and_after_a_handle_was_chosen) {
    DrivenEditor& e = open(empty);
    pause();
    e.click("objects/add/box");
    e.key("3");
    const std::string object = "/colliders/1", amount = "middle/view/gizmo/amount";
    const Position before = position_of(object);
    // A handle that was clicked waits for a number.
    e.click("middle/view/gizmo/move_x");
    EXPECT_TRUE(e.shows(amount));
    EXPECT_EQ(position_of(object).x, before.x);
    e.type("0.25");
    EXPECT_THAT(e.value(amount), HasSubstr("0.25"));
    EXPECT_NEAR(position_of(object).x, before.x + 0.25, 1e-6) << "shown before Enter";
    e.key("BackSpace");
    EXPECT_NEAR(position_of(object).x, before.x + 0.2, 1e-6);
    e.type("5 m");
    e.key("BackSpace");
    e.type("cm");
    EXPECT_NEAR(position_of(object).x, before.x + 0.0025, 1e-6) << "0.25 cm";
    e.key("Escape");
    EXPECT_FALSE(e.shows(amount));
    EXPECT_EQ(position_of(object).x, before.x) << "Esc takes it back";
    EXPECT_TRUE(e.shows("properties/colliders/1/name")) << "and does no more";

    // By keys alone, along another axis; digits choose no tool meanwhile.
    const std::size_t steps = e.played().history().done().size();
    e.key("g");
    e.key("z");
    e.key("minus");
    e.type("1.5");
    e.key("Return");
    EXPECT_FALSE(e.shows(amount));
    EXPECT_NEAR(position_of(object).z, before.z - 1.5, 1e-6);
    EXPECT_EQ(position_of(object).x, before.x);
    EXPECT_EQ(e.value("toolbar/move"), "on");
    EXPECT_EQ(e.played().history().done().size(), steps + 1) << "one step";
    e.key("ctrl+z");
    EXPECT_EQ(position_of(object).z, before.z);

    // During a drag: the number replaces what the pointer does.
    const Point from = e.place("middle/view/gizmo/move_y").center();
    e.point_at(from);
    e.press();
    e.move(from + Point{0, -50});
    EXPECT_THAT(e.value(amount), HasSubstr("y"));
    EXPECT_GT(position_of(object).y, before.y + 0.05);
    e.type("0.5");
    e.move(from + Point{0, -90});
    e.release();
    EXPECT_NEAR(position_of(object).y, before.y + 0.5, 1e-6);
    e.key("Return");
    EXPECT_NEAR(position_of(object).y, before.y + 0.5, 1e-6);
    EXPECT_EQ(e.played().history().done().size(), steps + 1);
    e.key("ctrl+z");

    // What is no number is not kept.
    e.key("g");
    e.type("3 kg");
    e.key("Return");
    EXPECT_TRUE(e.shows(amount));
    EXPECT_EQ(position_of(object).x, before.x + 3) << "as far as it was a number";
    e.key("Escape");
    EXPECT_EQ(position_of(object).x, before.x);

    e.key("4");
    e.key("g");
    e.key("y");
    e.type("90");
    e.key("Return");
    EXPECT_NEAR(e.number("properties/colliders/1/transform/rotation/y"), 90, 0.011);
    e.key("5");
    e.key("g");
    e.type("2");
    e.key("Return");
    e.click("properties/colliders/1/box");
    EXPECT_NEAR(e.number("properties/colliders/1/box/half_extents/x"), 0.4, 1e-6);
    EXPECT_NEAR(e.number("properties/colliders/1/box/half_extents/y"), 0.2, 1e-6);
    undo_everything();
    expect_nothing_is_left();
}

TEST_F(EditorWindow, the_wheel_moves_toward_what_is_under_the_pointer) {
    DrivenEditor& e = open(empty);
    pause();
    // The floor there is nearer than the target.
    const Point at = e.place(view).at(0.7, 0.85);
    e.point_at(at);
    const Point pixel{std::floor(at.x), std::floor(at.y)};
    const Point before = floor_under(pixel);
    const Eye far = eye();
    const auto distance = [&] {
        const Eye now = eye();
        return std::hypot(now.position[0] - before.x, now.position[1], now.position[2] - before.y);
    };
    const double from = distance();
    e.wheel(5);
    EXPECT_GT(far.distance_to(eye()), 0.5);
    EXPECT_NEAR(distance() / from, std::pow(0.9, 5), 1e-3) << "a tenth of what is left with each notch";
    EXPECT_LT(length(floor_under(pixel) - before), 2e-3) << "the same point is under the pointer";
    e.wheel(-5);
    EXPECT_LT(far.distance_to(eye()), 1e-3) << "and back";
}

TEST_F(EditorWindow, keys_fly_as_the_preferences_say) {
    DrivenEditor& e = open(empty);
    pause();
    const auto flown = [&](const std::string& key, bool with_button) {
        const Eye before = eye();
        e.point_at(e.place(view).at(0.5, 0.3));
        if (with_button) e.press(3);
        e.hold_until(key, "the eye moves", [&] { return eye().distance_to(before) > 0.05 || !with_button; });
        if (with_button) e.release(3);
        const Eye after = eye();
        std::array<double, 3> way{};
        for (std::size_t i = 0; i < 3; ++i) way[i] = after.position[i] - before.position[i];
        return way;
    };
    const auto along = [](const std::array<double, 3>& way, const std::array<double, 3>& axis) {
        return way[0] * axis[0] + way[1] * axis[1] + way[2] * axis[2];
    };
    const auto ahead = eye().ahead();
    const double across = std::hypot(ahead[0], ahead[2]);
    const std::array<double, 3> right{-ahead[2] / across, 0, ahead[0] / across};
    EXPECT_GT(along(flown("w", true), ahead), 0.04);
    EXPECT_LT(along(flown("s", true), ahead), -0.04);
    EXPECT_GT(along(flown("d", true), right), 0.04);
    EXPECT_LT(along(flown("a", true), right), -0.04);
    EXPECT_GT(flown("e", true)[1], 0.03) << "up";
    EXPECT_LT(flown("q", true)[1], -0.03);
    EXPECT_EQ(along(flown("w", false), ahead), 0) << "only while the right button is held";

    const auto choose_next = [&](const std::string& what) {
        e.key("ctrl+comma");
        for (int i = 0; i < 60 && e.focused() != "preferences/" + what; ++i) e.key("Tab");
        e.key("Right");
        e.click("preferences/close");
        e.until("the dialog closes", [&] { return !e.shows("preferences/close"); });
    };
    choose_next("keys");
    EXPECT_GT(flown("w", true)[1], 0.03) << "the other map: up";
    EXPECT_GT(along(flown("e", true), ahead), 0.04) << "ahead";
    choose_next("fly");
    const Eye before = eye();
    e.hold_until("d", "the eye moves", [&] { return eye().distance_to(before) > 0.05; });
    // Control makes shortcuts of the same letters.
    const Eye still = eye();
    e.key("ctrl+s");
    e.key("Escape");
    EXPECT_EQ(still.distance_to(eye()), 0);
}

TEST_F(EditorWindow, views_along_axes_and_a_limited_pitch) {
    DrivenEditor& e = open(empty);
    pause();
    const std::pair<const char*, std::array<double, 3>> views[] = {
        {"KP_1", {0, 0, -1}}, {"KP_3", {-1, 0, 0}}, {"KP_7", {0, -1, 0}}, {"ctrl+KP_1", {0, 0, 1}}};
    for (const auto& [key, ahead] : views) {
        SCOPED_TRACE(key);
        e.key(key);
        e.until("the camera is there", [&, wanted = ahead] {
            const auto now = eye().ahead();
            return std::hypot(now[0] - wanted[0], now[1] - wanted[1], now[2] - wanted[2]) < 1e-3;
        });
    }
    e.click("toolbar/view_menu");
    e.click("toolbar/view_menu/from_left");
    e.until("the camera is at the left", [&] { return eye().ahead()[0] > 0.999; });
    // Far beyond straight up, and back down: the image never turns over.
    const Point middle = e.place(view).at(0.5, 0.5);
    for (const double way : {-400.0, 400.0}) {
        for (int i = 0; i < 3; ++i) {
            e.point_at(middle);
            e.press(3);
            e.move(middle + Point{0, way * 0.7}, 4);
            e.release(3);
        }
        const auto ahead = eye().ahead();
        EXPECT_GT(std::abs(ahead[1]), 0.99);
        EXPECT_GT(ahead[0], 0) << "still on this side";
    }
}

TEST_F(EditorWindow, cloth_is_pulled_by_a_point_with_a_limited_force) {
    DrivenEditor& e = open(hanging);
    e.until("some frames", [&] { return e.frame() > 3; });
    const Point at = e.place(view).at(0.5, 0.45);
    e.point_at(at);
    e.press();
    e.move(at + Point{120, -40}, 12);
    e.until("the pull is shown", [&] { return e.shows("middle/view/pull"); });
    for (const Point by : {Point{200, 100}, Point{-250, -100}, Point{0, 250}}) {
        e.move(at + by, 6);
        EXPECT_LE(e.number("middle/view/pull"), 5.001) << "newtons";
    }
    e.release();
    e.until("nothing is pulled", [&] { return !e.shows("middle/view/pull"); });
    pause();
    const Log log = e.log();
    ASSERT_GE(log.actions.size(), 4u);
    EXPECT_EQ(kind_of(log.actions.front().action), "grab");
    EXPECT_EQ(kind_of(log.actions.back().action), "release");
    for (std::size_t i = 1; i + 1 < log.actions.size(); ++i) EXPECT_EQ(kind_of(log.actions[i].action), "move_grab");
    const auto& grab = std::get<Grab>(log.actions.front().action);
    EXPECT_EQ(grab.cloth, "sheet");
    EXPECT_EQ(grab.max_force, 5);
    EXPECT_GT(log.actions.back().at, log.actions.front().at) << "it has run meanwhile";
    const Stage played = e.played();
    EXPECT_EQ(played.history().done().size(), 1u) << "a pull is one step";
}

TEST_F(EditorWindow, vertices_are_chosen_and_pinned_and_cloth_is_cut) {
    DrivenEditor& e = open(hanging);
    pause();
    e.click("objects/cloths/0/select");
    e.key("2");
    const Rectangle all = e.place(view);
    e.drag(all.at(0.3, 0.3), all.at(0.6, 0.5));
    EXPECT_THAT(e.value("properties/tool/pin"), AllOf(StartsWith("Pin "), Not("Pin 0")));
    const auto chosen = std::stoul(e.value("properties/tool/pin").substr(4));
    e.key("p");
    const auto pinned = e.played();
    const Json& pins = pinned.document()->json["cloths"][0]["pins"];
    ASSERT_EQ(pins.size(), 2u);
    EXPECT_EQ(pins[1]["vertices"].size(), chosen);
    e.key("shift+p");
    EXPECT_EQ(e.played().document()->scene.cloths[0].pins.size(), 1u);
    e.key("ctrl+z");
    EXPECT_EQ(e.played().document()->scene.cloths[0].pins.size(), 2u);

    e.key("6");
    e.drag(all.at(0.1, 0.35), all.at(0.9, 0.42));
    ASSERT_EQ(e.actions("cut").size(), 1u) << "tearing is switched on with the cut";
    EXPECT_GE(std::get<Cut>(e.actions("cut")[0]).points.size(), 2u);
    EXPECT_EQ(e.played().document()->scene.cloths[0].tearing, Tearing::cuts);
    e.drag(all.at(0.02, 0.02), all.at(0.1, 0.05));
    EXPECT_THAT(e.value("middle/view/messages/0/text"), HasSubstr("meets no cloth"))
        << "the only message: the cloth did not start again";
    undo_everything();
    expect_nothing_is_left();
}

}  // namespace
}  // namespace weft::editor
