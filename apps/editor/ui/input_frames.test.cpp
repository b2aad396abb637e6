// Events divided into frames: each frame is what a slow user interface sees of a burst of events.
#include "editor/ui/input_frames.h"

#include "editor/ui/ui_stage.test.h"

#include <gtest/gtest.h>

namespace weft::editor {
namespace {

constexpr std::size_t left = 0;

std::vector<InputFrame> frames_of(Script& script, bool typing = false) {
    InputFrames frames;
    frames.add(script.take());
    std::vector<InputFrame> all;
    do {
        all.push_back(frames.next(100, typing));
    } while (frames.pending() && all.size() < 100);
    return all;
}

TEST(InputFrames, moves_are_one_frame) {
    Script script;
    const auto frames = frames_of(script.move(1, 1).move(2, 2).move(30, 40));
    ASSERT_EQ(frames.size(), 1u);
    EXPECT_EQ(frames[0].pointer, (Vec2{30, 40}));
    EXPECT_EQ(frames[0].time, 100) << "nothing is left: now";
}

TEST(InputFrames, a_click_faster_than_a_frame_is_seen_down_and_up) {
    Script script;
    const auto frames = frames_of(script.move(5, 5).click());
    ASSERT_EQ(frames.size(), 3u);
    EXPECT_FALSE(frames[0].buttons[left]) << "the place comes first";
    EXPECT_TRUE(frames[1].buttons[left]);
    EXPECT_FALSE(frames[2].buttons[left]);
}

TEST(InputFrames, a_double_click_is_four_changes_with_their_own_times) {
    Script script;
    script.clock = 10;
    const auto frames = frames_of(script.move(5, 5).click(2));
    ASSERT_EQ(frames.size(), 5u);
    int presses = 0;
    for (std::size_t i = 1; i < frames.size(); ++i)
        if (frames[i].buttons[left] && !frames[i - 1].buttons[left]) ++presses;
    EXPECT_EQ(presses, 2);
    EXPECT_NEAR(frames[3].time - frames[1].time, 0.07, 1e-9) << "the clock of events, not that of frames";
}

TEST(InputFrames, a_drag_within_a_frame_is_pressed_where_it_began_and_released_where_it_ended) {
    Script script;
    script.move(10, 10).button(true).move(20, 10).move(50, 10).button(false).move(90, 90);
    const auto frames = frames_of(script);
    ASSERT_EQ(frames.size(), 5u);
    EXPECT_EQ(frames[1].pointer, (Vec2{10, 10}));
    EXPECT_TRUE(frames[1].buttons[left]);
    EXPECT_EQ(frames[2].pointer, (Vec2{50, 10}));
    EXPECT_TRUE(frames[2].buttons[left]) << "the whole drag is seen while the button is down";
    EXPECT_EQ(frames[3].pointer, (Vec2{50, 10}));
    EXPECT_FALSE(frames[3].buttons[left]);
    EXPECT_EQ(frames[4].pointer, (Vec2{90, 90}));
}

TEST(InputFrames, a_press_whose_move_was_not_reported_happens_at_its_place) {
    InputFrames frames;
    frames.add({{1, render::ButtonChanged{PointerButton::right, true, {7, 8}, {}}}});
    InputFrame one = frames.next(2);
    EXPECT_EQ(one.pointer, (Vec2{7, 8}));
    EXPECT_TRUE(one.buttons.none());
    one = frames.next(2);
    EXPECT_TRUE(one.buttons[1]);
    EXPECT_FALSE(frames.pending());
}

TEST(InputFrames, a_wheel_turns_where_the_pointer_was) {
    Script script;
    const auto frames = frames_of(script.move(1, 1).wheel(1).wheel(1).move(9, 9));
    ASSERT_EQ(frames.size(), 3u);
    EXPECT_EQ(frames[0].wheel.y, 0);
    EXPECT_EQ(frames[1].wheel.y, 2);
    EXPECT_EQ(frames[1].pointer, (Vec2{1, 1}));
    EXPECT_EQ(frames[2].wheel.y, 0);
    EXPECT_EQ(frames[2].pointer, (Vec2{9, 9}));
}

TEST(InputFrames, control_is_held_when_its_key_is_pressed_and_only_then) {
    Script script;
    script.key(Key::left_control, true).press(Key::z).key(Key::left_control, false).press(Key::z);
    int with = 0, without = 0;
    for (const InputFrame& frame : frames_of(script))
        for (const InputFrame::Press& one : frame.keys)
            if (one.key == Key::z && one.down) ++(frame.modifiers().control ? with : without);
    EXPECT_EQ(with, 1);
    EXPECT_EQ(without, 1);
}

TEST(InputFrames, a_key_before_control_is_not_a_shortcut) {
    Script script;
    for (const InputFrame& frame : frames_of(script.key(Key::z, true).key(Key::left_control, true)))
        for (const InputFrame::Press& one : frame.keys)
            if (one.key == Key::z) {
                EXPECT_FALSE(frame.modifiers().control);
            }
}

TEST(InputFrames, two_keys_are_two_frames_in_their_order) {
    Script script;
    std::vector<Key> pressed;
    for (const InputFrame& frame : frames_of(script.press(Key::space).press(Key::s).press(Key::space))) {
        int in_frame = 0;
        for (const InputFrame::Press& one : frame.keys) {
            if (!one.down) continue;
            pressed.push_back(one.key);
            ++in_frame;
        }
        EXPECT_LE(in_frame, 1);
    }
    EXPECT_EQ(pressed, (std::vector<Key>{Key::space, Key::s, Key::space}));
}

TEST(InputFrames, text_keeps_its_order_with_keys_that_edit) {
    Script script;
    script.type("ab").press(Key::backspace).type("c");
    std::u32string text;
    for (const InputFrame& frame : frames_of(script, true)) {
        text += frame.text;  // a field inserts text first
        for (const InputFrame::Press& one : frame.keys)
            if (one.key == Key::backspace && one.down) text.pop_back();
    }
    EXPECT_EQ(text, U"ac");
}

TEST(InputFrames, typing_needs_few_frames) {
    Script script;
    EXPECT_LE(frames_of(script.type("cotton").press(Key::enter), true).size(), 5u) << "one more for the second t";
    EXPECT_LE(frames_of(script.type("012345"), true).size(), 2u);
}

TEST(InputFrames, lost_focus_releases_everything) {
    Script script;
    script.move(1, 1).button(true).key(Key::w, true).add(render::FocusChanged{false});
    const auto frames = frames_of(script);
    EXPECT_TRUE(frames.back().buttons.none());
    EXPECT_TRUE(frames.back().down.none());
    EXPECT_FALSE(frames.back().focused);
}

TEST(InputFrames, dropped_files_come_with_the_pointer) {
    Script script;
    script.move(40, 50).add(render::FilesDropped{{"a.obj", "b.json"}}).move(60, 60);
    const auto frames = frames_of(script);
    for (const InputFrame& frame : frames) {
        if (frame.files.empty()) continue;
        EXPECT_EQ(frame.files, (std::vector<std::string>{"a.obj", "b.json"}));
        return;
    }
    ADD_FAILURE() << "no files";
}

}  // namespace
}  // namespace weft::editor
