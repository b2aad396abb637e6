// Scenes on disk and recovered sessions in the editor's window.
#include "editor_fixture.h"

namespace weft::editor {
namespace {

using testing::AllOf;
using testing::HasSubstr;

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
    EXPECT_FALSE(first.shows("recovery/0/recover"));
    pause();
    first.click("objects/add/box");
    first.click("objects/add/sphere");
    first.kill();
    DrivenEditor& second = start("second");
    second.until("the offer", [&] { return second.shows("recovery/0/recover"); });
    EXPECT_FALSE(second.shows("objects/colliders/1/select"));
    second.click("recovery/0/recover");
    second.until("the session is back", [&] { return second.shows("objects/colliders/2/select"); });
    EXPECT_EQ(second.value("objects/colliders/1/select"), "box");
    EXPECT_TRUE(second.is_enabled("toolbar/undo")) << "with its history";
    second.key("ctrl+z");
    second.until("the ball is gone", [&] { return !second.shows("objects/colliders/2/select"); });
    // Again: what was recovered is not lost in a second crash.
    second.kill();
    DrivenEditor& third = start("third");
    third.until("the offer", [&] { return third.shows("recovery/0/recover"); });
    third.click("recovery/0/recover");
    third.until("the session is back", [&] { return third.shows("objects/colliders/1/select"); });
    third.settle();
    EXPECT_FALSE(third.shows("objects/colliders/2/select"));
    EXPECT_TRUE(third.is_enabled("toolbar/undo"));
    // It differs from its file.
    third.key("ctrl+q");
    third.until("the question", [&] { return third.shows("unsaved/discard"); });
    EXPECT_EQ(third.end_by([&] { third.click("unsaved/discard"); }), 0);
    EXPECT_FALSE(start("fourth").shows("recovery/0/recover")) << "a session that has ended is not offered";
}

TEST_F(EditorWindow, a_session_that_was_saved_and_comes_back_does_not_take_its_file_for_changed) {
    const std::map<std::string, std::string> homes{{"XDG_CONFIG_HOME", (folder.path() / "config").string()},
                                                   {"XDG_STATE_HOME", (folder.path() / "state").string()}};
    const auto file = folder.write("scene.json", empty);
    const auto start = [&](const char* name) -> DrivenEditor& {
        return begin({.folder = folder.path() / name,
                      .arguments = {file.string()},
                      .environment = homes,
                      .keep_settings = true});
    };
    DrivenEditor& first = start("first");
    pause();
    first.click("objects/add/box");
    first.key("ctrl+s");
    EXPECT_THAT(first.value("middle/view/messages/0/text"), AllOf(HasSubstr("Saved"), HasSubstr("no cloth")));
    first.click("objects/add/sphere");
    first.kill();
    // Another session ends in the same way; both are offered in one list.
    DrivenEditor& second = start("second");
    second.until("the offer", [&] { return second.shows("recovery/0/recover"); });
    second.click("recovery/later");
    pause();
    second.click("objects/add/box");
    second.kill();

    DrivenEditor& third = start("third");
    third.until("the offer", [&] { return third.shows("recovery/1/recover"); });
    EXPECT_FALSE(third.shows("recovery/2/recover"));
    EXPECT_THAT(third.value("recovery/0/recover"), AllOf(HasSubstr("scene.json"), HasSubstr("1 action")));
    EXPECT_THAT(third.value("recovery/1/recover"), AllOf(HasSubstr("scene.json"), HasSubstr("3 actions")));
    third.click("recovery/0/discard");
    third.until("one is left", [&] { return !third.shows("recovery/1/recover"); });
    third.click("recovery/0/recover");
    third.until("the session is back", [&] { return third.shows("objects/colliders/2/select"); });
    third.settle();
    // It differs from its file by the ball, and the file is as it was saved.
    third.key("ctrl+s");
    EXPECT_FALSE(third.shows("changed_file/overwrite"));
    EXPECT_EQ((*open_document(file))->scene.colliders.size(), 3u);
    third.key("ctrl+z");
    third.until("the ball is gone", [&] { return !third.shows("objects/colliders/2/select"); });
    third.key("ctrl+s");
    EXPECT_FALSE(third.shows("changed_file/overwrite"));
    EXPECT_EQ((*open_document(file))->scene.colliders.size(), 2u);
    EXPECT_EQ(third.end_by([&] { third.key("ctrl+q"); }), 0);
    EXPECT_FALSE(start("fourth").shows("recovery/0/recover"));
}

TEST_F(EditorWindow, the_gallery_shows_images_that_are_made_meanwhile) {
    const auto cache = folder.path() / "cache";
    const auto file = folder.write("scene.json", hanging);
    const auto start = [&](const char* name) -> DrivenEditor& {
        return begin({.folder = folder.path() / name,
                      .arguments = {file.string()},
                      .environment = {{"WEFT_CACHE", cache.string()}}});
    };
    DrivenEditor& e = start("first");
    pause();
    e.key("ctrl+g");
    e.until("the gallery", [&] { return e.shows("gallery/flag"); });
    e.until(
        "a first image", [&] { return e.value("gallery/banner.image") == "ready"; }, 120);
    EXPECT_NE(e.value("gallery/hanging_bunny.image"), "ready") << "the dialog does not wait for all of them";
    e.click("gallery/close");
    e.until("the gallery closes", [&] { return !e.shows("gallery/flag"); });
    const auto images = [&] {
        std::size_t count = 0;
        for (const auto& entry : std::filesystem::directory_iterator(cache / "thumbnails"))
            count += entry.path().filename().string().starts_with("banner-");
        return count;
    };
    EXPECT_EQ(images(), 1u);
    DrivenEditor& again = start("second");
    pause();
    again.key("ctrl+g");
    again.until(
        "the image is read", [&] { return again.value("gallery/banner.image") == "ready"; }, 10);
    again.click("gallery/flag");
    again.until(
        "the scene is open", [&] { return again.value("objects/cloths/0/select") == "flag"; }, 60);
}

TEST_F(EditorWindow, a_lost_device_is_replaced_by_the_cpu) {
    const auto file = folder.write("scene.json", hanging);
    DrivenEditor& e = begin(
        {.folder = folder.path() / "run", .arguments = {file.string()}, .environment = {{"WEFT_LOSE_DEVICE", "60"}}});
    pause();
    e.key("ctrl+comma");
    for (int i = 0; i < 60 && e.focused() != "preferences/backend"; ++i) e.key("Tab");
    e.key("Right");
    e.click("preferences/close");
    ASSERT_EQ(e.actions("backend").size(), 1u);
    EXPECT_THAT(e.value("status/text"), HasSubstr("vulkan"));
    e.key("space");
    e.until(
        "a message", [&] { return e.shows("middle/view/messages/0/text"); }, 60);
    EXPECT_THAT(e.value("middle/view/messages/0/text"), HasSubstr("the CPU goes on from frame"));
    const std::uint64_t frame = e.frame();
    e.until("it runs on", [&] { return e.frame() > frame + 3; });
    EXPECT_THAT(e.value("status/text"), HasSubstr("cpu"));
    EXPECT_TRUE(e.plays());
}

}  // namespace
}  // namespace weft::editor
