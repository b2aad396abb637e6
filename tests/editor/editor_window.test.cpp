// The editor's window: runs, timeline, sizes, speed.
#include "editor_fixture.h"

#include <chrono>
#include <cstdlib>
#include <thread>

namespace weft::editor {
namespace {

using testing::AllOf;
using testing::HasSubstr;

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
    // One panel at a time.
    EXPECT_FALSE(e.shows("objects/add/box"));
    e.click("toolbar/page_objects");
    EXPECT_TRUE(e.shows("objects/add/box"));
    EXPECT_FALSE(e.shows(view));
    e.click("toolbar/page_properties");
    EXPECT_FALSE(e.shows("objects/add/box"));
    e.click("toolbar/page_view");
    EXPECT_GT(e.place(view).width, 300);
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
