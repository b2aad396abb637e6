// The editor in its window, driven by mouse and keys alone.
#include "base/temporary_folder.test.h"

#include "driven_editor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <thread>

namespace weft::editor {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* view = "middle/view/view";

/// A sheet that hangs from two corners before the camera.
constexpr const char* hanging = R"({ "weft": 1,
    "solver": {"substeps": 4},
    "cloths": [{"name": "sheet", "mesh": {"grid": {"size": [1, 1], "resolution": [21, 21]}}, "fabric": "cotton",
                "transform": {"position": [0, 0.9, 0], "rotation": [90, 0, 0]}, "pins": [{"vertices": [0, 20]}]}],
    "colliders": [{"name": "floor", "plane": {}}],
    "camera": {"position": [1.2, 1.3, 2.6], "target": [0, 0.7, 0], "fov": 40} })";

/// A floor and nothing else.
constexpr const char* empty = R"({ "weft": 1, "cloths": [], "colliders": [{"name": "floor", "plane": {}}],
    "camera": {"position": [2, 1.8, 2.4], "target": [0, 0.3, 0], "fov": 50} })";

/// The same from far away, where perspective does not change the shape of handles while they move.
constexpr const char* from_afar = R"({ "weft": 1, "cloths": [], "colliders": [{"name": "floor", "plane": {}}],
    "camera": {"position": [20, 15.3, 24], "target": [0, 0.3, 0], "fov": 5.4} })";

/// The value that a change has set.
Json value_of(const Action& action) {
    return *std::get<ChangeScene>(action).edits.at(0).value;
}

class EditorWindow : public testing::Test {
  protected:
    DrivenEditor& open(const char* scene, std::vector<std::string> arguments = {}) {
        const auto file = folder.write("scene.json", scene);
        arguments.insert(arguments.begin(), file.string());
        return begin({.folder = folder.path() / "run", .arguments = std::move(arguments)});
    }
    DrivenEditor& begin(DrivenEditor::Start start) {
        editor.reset();
        editor.emplace(std::move(start));
        return *editor;
    }
    /// Pauses the run, whose first frames are over.
    void pause() {
        editor->until("some frames", [&] { return editor->frame() > 3; });
        editor->key("space");
        editor->until("the run is paused", [&] { return !editor->plays(); });
        editor->settle();
    }
    void undo_everything() {
        while (editor->is_enabled("toolbar/undo")) editor->key("ctrl+z");
    }
    /// The log leads back to the document and the state of a run without any action.
    void expect_nothing_is_left() {
        const Log log = editor->log();
        Stage played = editor->played();
        auto plain = open_stage(log.head, {});
        ASSERT_TRUE(plain);
        while (plain->frame() < played.frame()) ASSERT_TRUE(plain->step());
        EXPECT_EQ(played.document()->json, log.head.document->json);
        EXPECT_EQ(played.hash(), plain->hash());
    }
    struct Position {
        double x, y, z;
    };
    /// As the properties show it; the object must be selected.
    Position position_of(const std::string& place) {
        const std::string at = "properties" + place + "/transform/position/";
        return {editor->number(at + "x"), editor->number(at + "y"), editor->number(at + "z")};
    }

    TemporaryFolder folder;
    std::optional<DrivenEditor> editor;
};

TEST_F(EditorWindow, plays_pauses_steps_and_resets) {
    DrivenEditor& e = open(hanging);
    EXPECT_TRUE(e.plays()) << "a scene runs from the start";
    pause();
    const std::uint64_t paused = e.frame();
    e.key("period");
    EXPECT_EQ(e.frame(), paused + 1);
    e.click("toolbar/step");
    EXPECT_EQ(e.frame(), paused + 2);
    e.key("space");
    e.until("it runs", [&] { return e.frame() > paused + 5; });
    e.click("toolbar/play");
    e.until("it is paused", [&] { return !e.plays(); });
    e.settle();
    const std::uint64_t again = e.frame();
    e.click("toolbar/reset");
    EXPECT_EQ(e.frame(), 0u);
    e.key("ctrl+z");
    EXPECT_EQ(e.frame(), again) << "a reset is undone";
    e.key("r");
    EXPECT_EQ(e.frame(), 0u);
    EXPECT_EQ(e.number("middle/timeline/track"), 0);
}

TEST_F(EditorWindow, objects_are_added_selected_duplicated_renamed_deleted_and_all_of_it_undone) {
    DrivenEditor& e = open(empty);
    pause();
    e.click("objects/add/more");
    for (const char* kind : {"cloth", "box", "sphere", "capsule", "plane", "wind"})
        e.click(std::string("objects/add/") + kind);
    EXPECT_EQ(e.value("objects/cloths/0/select"), "sheet");
    EXPECT_EQ(e.value("objects/colliders/1/select"), "box");
    EXPECT_EQ(e.value("objects/colliders/2/select"), "ball");
    EXPECT_EQ(e.value("objects/colliders/3/select"), "capsule");
    EXPECT_EQ(e.value("objects/colliders/4/select"), "floor 2");
    EXPECT_EQ(e.value("objects/air/wind/0/select"), "on") << "what was added is selected";
    EXPECT_EQ(e.actions("change").size(), 6u);

    // By its card, and by a click in the view.
    e.click("objects/colliders/2/select");
    EXPECT_TRUE(e.shows("properties/colliders/2/name"));
    e.key("3");
    const Point ball = e.place("middle/view/gizmo/center").center();
    e.key("Escape");
    EXPECT_FALSE(e.shows("properties/colliders/2/name"));
    e.click(ball + Point{12, 24});
    EXPECT_THAT(e.names("properties/colliders/"), testing::Contains(testing::EndsWith("/name")));

    e.click("objects/colliders/2/select");
    e.key("ctrl+d");
    EXPECT_EQ(e.value("objects/colliders/5/select"), "on");
    EXPECT_EQ(e.value("properties/colliders/5/name"), "ball 2");
    e.key("F2");
    e.until("the name can be typed", [&] { return e.shows("objects/colliders/5/name"); });
    e.type("moon");
    e.key("Return");
    EXPECT_EQ(e.value("properties/colliders/5/name"), "moon");
    ASSERT_EQ(e.actions("rename").size(), 1u);
    e.key("Delete");
    EXPECT_FALSE(e.shows("objects/colliders/5/select"));
    EXPECT_EQ(e.played().document()->scene.colliders.size(), 5u);

    undo_everything();
    EXPECT_FALSE(e.shows("objects/cloths/0/select"));
    EXPECT_FALSE(e.shows("objects/colliders/1/select"));
    expect_nothing_is_left();
    e.key("ctrl+shift+z");
    EXPECT_TRUE(e.shows("objects/cloths/0/select"));
}

TEST_F(EditorWindow, arrows_move_an_object_along_their_axes_and_stay_under_the_pointer) {
    DrivenEditor& e = open(from_afar);
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
        e.move(from + (center - from) * 2.0, 24);
        e.release();
        const std::vector<Action> all = e.actions("change");
        ASSERT_GT(all.size(), logged + 8);
        double last = 0;
        for (std::size_t i = logged; i < all.size(); ++i) {
            const double now = value_of(all[i]).at(static_cast<std::size_t>(axis - 'x'));
            EXPECT_LT(std::abs(std::remainder(now - last, 360)), 40) << "step " << i - logged;
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
    EXPECT_THAT(e.value("middle/view/messages/0/text"), HasSubstr("meets no cloth"));
    undo_everything();
    expect_nothing_is_left();
}

TEST_F(EditorWindow, values_are_typed_dragged_reset_and_reached_by_keys_alone) {
    DrivenEditor& e = open(hanging);
    pause();
    e.click("objects/cloths/0/select");
    const std::string density = "properties/cloths/0/fabric/density";
    e.scroll_to(density, "properties/cloths/0/name");
    const double usual = e.number(density);
    e.click(density);
    e.type("0.3");
    e.key("Return");
    EXPECT_DOUBLE_EQ(e.number(density), 0.3);
    ASSERT_EQ(e.actions("change").size(), 1u);
    EXPECT_EQ(std::get<ChangeScene>(e.actions("change")[0]).edits[0].place, "/cloths/0/fabric/density");

    const Rectangle box = e.place(density);
    e.drag(box.at(0.3, 0.5), box.at(0.6, 0.5));
    EXPECT_GT(e.number(density), 0.31);
    EXPECT_EQ(e.played().history().done().size(), 2u) << "a drag is one undo step";
    e.double_click(density);
    EXPECT_DOUBLE_EQ(e.number(density), usual);
    e.key("ctrl+z");
    EXPECT_GT(e.number(density), 0.31);
    e.key("ctrl+z");
    EXPECT_DOUBLE_EQ(e.number(density), 0.3);
    e.key("ctrl+z");
    EXPECT_DOUBLE_EQ(e.number(density), usual);

    // Damping comes after density.
    const std::string damping = "properties/cloths/0/fabric/damping";
    const double before = e.number(damping);
    for (int i = 0; i < 200 && e.focused() != density; ++i) e.key("Tab");
    e.key("Tab");
    EXPECT_TRUE(e.is_focused(damping));
    e.key("Right");
    EXPECT_GT(e.number(damping), before);
    e.key("Left");
    e.key("0");
    e.key("period");
    e.key("2");
    e.key("Return");
    EXPECT_DOUBLE_EQ(e.number(damping), 0.2);
    undo_everything();
    expect_nothing_is_left();
}

TEST_F(EditorWindow, the_timeline_is_scrubbed_and_the_run_continues_from_there) {
    DrivenEditor& e = open(hanging);
    e.until("enough frames", [&] { return e.frame() > 40; });
    pause();
    const std::uint64_t last = e.frame();
    const std::string track = "middle/timeline/track";
    const Rectangle bar = e.place(track);
    e.point_at(bar.at(0.8, 0.3));
    e.press();
    e.move(bar.at(0.2, 0.3), 10);
    e.release();
    const std::uint64_t there = e.frame();
    EXPECT_LT(there, last);
    EXPECT_GT(there, 0u);
    e.key("Right");
    EXPECT_EQ(e.frame(), there + 1);
    e.key("Left");
    EXPECT_EQ(e.frame(), there);
    EXPECT_FALSE(e.plays());
    e.key("space");
    e.until("it runs on", [&] { return e.frame() > there + 3; });
    e.key("space");
    e.until("it is paused", [&] { return !e.plays(); });
    e.settle();
    // The frames are those of the first run.
    const Log log = e.log();
    Stage played = e.played();
    while (played.frame() < e.frame()) ASSERT_TRUE(played.step());
    auto plain = open_stage(log.head, {});
    while (plain->frame() < played.frame()) ASSERT_TRUE(plain->step());
    EXPECT_EQ(played.hash(), plain->hash());
}

TEST_F(EditorWindow, scenes_are_saved_and_opened_and_a_broken_one_changes_nothing) {
    DrivenEditor& e = open(hanging);
    pause();
    e.click("objects/add/box");
    const std::filesystem::path file = folder.path() / "saved.json";
    e.key("ctrl+shift+s");
    e.until("the dialog", [&] { return e.shows("file_dialog/path"); });
    const auto type_path = [&](const std::filesystem::path& path) {
        e.click("file_dialog/path");
        e.key("ctrl+a");
        e.type(path.string());
        e.key("Return");
    };
    type_path(file);
    e.until("the dialog closes", [&] { return !e.shows("file_dialog/path"); });
    EXPECT_THAT(e.value("middle/view/messages/0/text"), HasSubstr("Saved"));
    const auto saved = open_document(file);
    ASSERT_TRUE(saved) << saved.error().message();
    EXPECT_EQ((*saved)->scene, e.played().document()->scene);

    // Save needs no question now, and neither after an undo.
    e.click("objects/add/sphere");
    e.key("ctrl+s");
    EXPECT_FALSE(e.shows("file_dialog/path"));
    EXPECT_EQ((*open_document(file))->scene.colliders.size(), 3u);
    e.key("ctrl+z");
    e.key("ctrl+s");
    EXPECT_FALSE(e.shows("file_dialog/path"));
    EXPECT_EQ((*open_document(file))->scene.colliders.size(), 2u);
    EXPECT_EQ((*open_document(file))->scene, (*saved)->scene);

    // Another file is overwritten only on demand.
    const auto other = folder.write("other.json", "mine");
    e.key("ctrl+shift+s");
    e.until("the dialog", [&] { return e.shows("file_dialog/path"); });
    type_path(other);
    EXPECT_THAT(e.value("file_dialog/problem"), HasSubstr("exists"));
    EXPECT_EQ(read_bytes(other).size(), 4u);
    e.key("Escape");
    e.until("the dialog closes", [&] { return !e.shows("file_dialog/path"); });
    EXPECT_EQ(read_bytes(other).size(), 4u);

    const auto broken =
        folder.write("broken.json", R"({"weft": 1, "cloths": [{"fabric": {"density": -1}, "mesh": 3}]})");
    e.key("ctrl+o");
    e.until("the dialog", [&] { return e.shows("file_dialog/path"); });
    type_path(broken);
    e.until("a message", [&] {
        return e.shows("middle/view/messages/0/text") &&
               e.value("middle/view/messages/0/text").find("broken.json") != std::string::npos;
    });
    EXPECT_THAT(e.value("middle/view/messages/0/text"), AllOf(HasSubstr("density"), HasSubstr("mesh")));
    EXPECT_EQ(e.value("objects/cloths/0/select"), "sheet");
    EXPECT_TRUE(e.shows("objects/colliders/1/select"));

    DrivenEditor& again = begin({.folder = folder.path() / "again", .arguments = {file.string()}});
    EXPECT_EQ(again.value("objects/colliders/1/select"), "box");
    EXPECT_EQ(again.log().head.document->scene, (*saved)->scene);
}

TEST_F(EditorWindow, unsaved_changes_are_asked_about) {
    DrivenEditor& e = open(hanging);
    pause();
    e.click("objects/add/box");
    e.key("ctrl+q");
    e.until("the question", [&] { return e.shows("unsaved/cancel"); });
    e.click("unsaved/cancel");
    e.until("the question is gone", [&] { return !e.shows("unsaved/cancel"); });
    EXPECT_TRUE(e.runs());
    // A save that was called off does not close the window later.
    const auto file = folder.path() / "scene.json";
    e.key("ctrl+n");
    e.click("unsaved/save");
    e.until("the scene is new", [&] { return !e.shows("objects/cloths/0/select"); });
    EXPECT_EQ((*open_document(file))->scene.colliders.size(), 2u);
    e.click("objects/add/cloth");
    e.key("ctrl+q");
    e.click("unsaved/save");
    e.until("the dialog", [&] { return e.shows("file_dialog/cancel"); });
    e.click("file_dialog/cancel");
    e.key("ctrl+s");
    e.until("the dialog", [&] { return e.shows("file_dialog/path"); });
    e.key("ctrl+a");
    e.type((folder.path() / "second.json").string());
    e.key("Return");
    e.until("the dialog closes", [&] { return !e.shows("file_dialog/path"); });
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "second.json"));
    e.settle();
    EXPECT_TRUE(e.runs());
    e.click("objects/add/box");
    e.key("ctrl+z");
    EXPECT_EQ(e.end_by([&] { e.key("ctrl+q"); }), 0);
}

TEST_F(EditorWindow, a_killed_session_comes_back) {
    DrivenEditor& e = open(empty);
    pause();
    e.click("objects/add/box");
    e.click("objects/add/sphere");
    e.key("3");
    const Point from = e.place("middle/view/gizmo/move_y").center();
    e.point_at(from);
    e.press();
    e.move(from + Point{0, -60});
    const double height = e.number("properties/colliders/2/transform/position/y");
    EXPECT_GT(height, 0.26);
    e.kill();
    const Stage played = e.played();
    ASSERT_EQ(played.document()->scene.colliders.size(), 3u);
    EXPECT_NEAR(played.document()->scene.colliders[2].transform.position.y, height, 1e-3);

    // With settings, the next start offers the session.
    const std::map<std::string, std::string> homes{{"XDG_CONFIG_HOME", (folder.path() / "config").string()},
                                                   {"XDG_STATE_HOME", (folder.path() / "state").string()}};
    const auto start = [&](const char* name) -> DrivenEditor& {
        return begin({.folder = folder.path() / name,
                      .arguments = {(folder.path() / "scene.json").string()},
                      .environment = homes,
                      .keep_settings = true});
    };
    DrivenEditor& first = start("first");
    EXPECT_FALSE(first.shows("recovery/recover"));
    pause();
    first.click("objects/add/box");
    first.click("objects/add/sphere");
    first.kill();
    DrivenEditor& second = start("second");
    second.until("the offer", [&] { return second.shows("recovery/recover"); });
    EXPECT_FALSE(second.shows("objects/colliders/1/select"));
    second.click("recovery/recover");
    second.until("the session is back", [&] { return second.shows("objects/colliders/2/select"); });
    EXPECT_EQ(second.value("objects/colliders/1/select"), "box");
    EXPECT_TRUE(second.is_enabled("toolbar/undo")) << "with its history";
    second.key("ctrl+z");
    second.until("the ball is gone", [&] { return !second.shows("objects/colliders/2/select"); });
    // Again: what was recovered is not lost in a second crash.
    second.kill();
    DrivenEditor& third = start("third");
    third.until("the offer", [&] { return third.shows("recovery/recover"); });
    third.click("recovery/recover");
    third.until("the session is back", [&] { return third.shows("objects/colliders/1/select"); });
    third.settle();
    EXPECT_FALSE(third.shows("objects/colliders/2/select"));
    EXPECT_TRUE(third.is_enabled("toolbar/undo"));
    // It differs from its file.
    third.key("ctrl+q");
    third.until("the question", [&] { return third.shows("unsaved/discard"); });
    EXPECT_EQ(third.end_by([&] { third.click("unsaved/discard"); }), 0);
    EXPECT_FALSE(start("fourth").shows("recovery/recover")) << "a session that has ended is not offered";
}

std::vector<std::string> without_frames(const Log& log) {
    std::vector<std::string> lines;
    for (const TimedAction& one : log.actions) lines.push_back(to_line({0, one.action}));
    return lines;
}

TEST_F(EditorWindow, at_three_frames_a_second_nothing_is_lost) {
    const auto work = [&](DrivenEditor& e) {
        pause();
        e.click("objects/add/more");
        e.at_once([&] {
            for (const char* kind : {"cloth", "box", "sphere", "capsule", "wind", "box"})
                e.click(std::string("objects/add/") + kind);
            e.key("ctrl+d");
            e.key("ctrl+d");
            e.key("ctrl+z");
            e.key("Delete");
            e.key("ctrl+z");
            e.key("ctrl+shift+z");
        });
        e.click("objects/colliders/1/select");
        e.at_once([&] {
            e.key("ctrl+d");
            e.key("F2");
            e.type("abc");
            e.key("Return");
            e.key("period");
            e.key("period");
        });
        return without_frames(e.log());
    };
    const std::vector<std::string> fast = work(open(empty));
    EXPECT_EQ(fast.size(), 15u);
    EXPECT_EQ(work(open(empty, {"--slow", "3"})), fast);
}

TEST_F(EditorWindow, small_and_resized_windows_go_on) {
    const auto file = folder.write("scene.json", hanging);
    DrivenEditor& e = begin({.folder = folder.path() / "run", .arguments = {file.string()}, .size = "320 200"});
    pause();
    for (const auto& [width, height] :
         {std::pair{200u, 120u}, {900u, 640u}, {320u, 200u}, {1200u, 200u}, {320u, 700u}, {1280u, 800u}}) {
        e.resize(width, height);
        e.settle();
    }
    e.key("space");
    const std::uint64_t before = e.frame();
    e.until("it runs", [&] { return e.frame() > before; });
    e.click("objects/add/box");
    EXPECT_TRUE(e.shows("objects/colliders/1/select"));
}

TEST_F(EditorWindow, costs_nothing_while_it_is_paused) {
    DrivenEditor& e = open(hanging);
    pause();
    // The view gets sharper once nothing moves.
    e.until("the view is at its best", [&] { return e.value("status/text").find("at 100 %") != std::string::npos; });
    double share = 1;
    for (int i = 0; i < 3 && share > 0.02; ++i) {
        const double before = e.processor_seconds();
        std::this_thread::sleep_for(std::chrono::seconds(2));
        share = (e.processor_seconds() - before) / 2;
    }
    EXPECT_LT(share, 0.02);
}

TEST(Editor, without_a_display_says_what_needs_none) {
    const TemporaryFolder folder;
    const auto out = folder.path() / "out.txt";
    const std::string command = std::string("env -u DISPLAY -u WAYLAND_DISPLAY ") + WEFT_PROGRAM +
                                " edit --no-settings >" + out.string() + " 2>&1";
    const int status = std::system(command.c_str());
    const std::vector<char> bytes = read_bytes(out);
    EXPECT_EQ(WEXITSTATUS(status), 1);
    EXPECT_THAT(std::string(bytes.begin(), bytes.end()),
                AllOf(HasSubstr("display"), HasSubstr("weft run"), HasSubstr("weft render")));
}

}  // namespace
}  // namespace weft::editor
