// Widgets driven by scripts of events, all of which come at once: each as slow as a user interface can be.
#include "editor/ui/widgets/color.h"
#include "editor/ui/widgets/controls.h"
#include "editor/ui/widgets/number.h"
#include "editor/ui/widgets/panels.h"

#include "editor/ui/ui_stage.test.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace weft::editor {
namespace {

/// What a widget reported.
struct Reports {
    int in_progress = 0, finished = 0, cancelled = 0;
    void add(Change change) {
        in_progress += change == Change::in_progress;
        finished += change == Change::finished;
        cancelled += change == Change::cancelled;
    }
};

class NumberTest : public testing::Test {
  protected:
    double value = 0.5, second = 1;
    NumberRange range{.min = 0, .max = 1, .unit = "m", .usual = 0.5};
    Reports reports;
    Stage stage{[this](Ui& ui) {
        reports.add(number(ui, {.name = "first", .label = "First"}, value, range));
        number(ui, {.name = "second", .label = "Second"}, second, {.min = 0, .max = 10, .unit = "s"});
    }};
};

TEST_F(NumberTest, a_drag_is_one_change) {
    const float width = stage.widget("first").width;
    stage.to("first").button(true);
    const Vec2 at = stage.middle("first");
    for (int i = 1; i <= 10; ++i) stage.script.move(at.x + width * 0.025f * static_cast<float>(i), at.y);
    stage.script.button(false);
    stage.settle();
    EXPECT_NEAR(value, 0.75, 0.006);
    EXPECT_GE(reports.in_progress, 1);
    EXPECT_EQ(reports.finished, 1);
    EXPECT_LT(std::abs(value * 1000 - std::round(value * 1000)), 1e-9) << "a short decimal: " << value;
}

TEST_F(NumberTest, a_drag_over_many_frames_gives_the_same) {
    const float width = stage.widget("first").width;
    const Vec2 at = stage.middle("first");
    stage.to("first").button(true);
    stage.settle();
    for (int i = 1; i <= 10; ++i) {
        stage.script.move(at.x + width * 0.025f * static_cast<float>(i), at.y);
        stage.settle();
    }
    EXPECT_EQ(reports.finished, 0);
    stage.script.button(false);
    stage.settle();
    EXPECT_NEAR(value, 0.75, 0.006);
    EXPECT_GE(reports.in_progress, 8);
    EXPECT_EQ(reports.finished, 1);
}

TEST_F(NumberTest, a_click_changes_nothing) {
    value = 0.3;
    stage.to("first").click();
    stage.settle();
    EXPECT_EQ(value, 0.3);
    EXPECT_EQ(reports.finished + reports.in_progress, 0);
    EXPECT_TRUE(stage.widget("first").focused);
}

TEST_F(NumberTest, a_double_click_resets) {
    value = 0.3;
    stage.frame();
    stage.to("first").click(2);
    stage.settle();
    EXPECT_EQ(value, 0.5);
    EXPECT_EQ(reports.finished, 1);
}

TEST_F(NumberTest, two_slow_clicks_are_no_double_click) {
    value = 0.3;
    stage.to("first").click().wait(1).click();
    stage.settle();
    EXPECT_EQ(value, 0.3);
}

TEST_F(NumberTest, the_mark_resets) {
    EXPECT_EQ(stage.ui.probe().find("first.reset"), nullptr) << "the default has no mark";
    value = 0.3;
    stage.frame();
    ASSERT_NE(stage.ui.probe().find("first.reset"), nullptr);
    stage.to("first.reset").click();
    stage.settle();
    EXPECT_EQ(value, 0.5);
    EXPECT_EQ(reports.finished, 1);
}

TEST_F(NumberTest, escape_takes_a_drag_back) {
    stage.to("first").button(true).move(stage.middle("first").x + 60, stage.middle("first").y);
    stage.settle();
    EXPECT_NE(value, 0.5);
    stage.script.press(Key::escape).button(false);
    stage.settle();
    EXPECT_EQ(value, 0.5);
    EXPECT_EQ(reports.cancelled, 1);
    EXPECT_EQ(reports.finished, 0);
}

TEST_F(NumberTest, shift_drags_finely_and_control_in_steps) {
    const float width = stage.widget("first").width;
    const Vec2 at = stage.middle("first");
    stage.to("first")
        .key(Key::left_shift, true)
        .button(true)
        .move(at.x + width / 2, at.y)
        .button(false)
        .key(Key::left_shift, false);
    stage.settle();
    EXPECT_NEAR(value, 0.55, 0.002);
    stage.to("first").button(true).key(Key::left_control, true).move(at.x + width * 0.21f, at.y);
    stage.settle();
    EXPECT_NEAR(value, 0.8, 1e-9);
    stage.script.button(false).key(Key::left_control, false);
    stage.settle();
}

TEST_F(NumberTest, typing_takes_units_and_expressions) {
    stage.to("first").click().press(Key::enter);
    stage.settle();
    EXPECT_TRUE(stage.ui.wants_text());
    stage.script.type("25")
        .add(render::TextTyped{' '})
        .add(render::TextTyped{'c'})
        .add(render::TextTyped{'m'})
        .press(Key::enter);
    stage.settle();
    EXPECT_NEAR(value, 0.25, 1e-12);
    EXPECT_EQ(reports.finished, 1);
    EXPECT_FALSE(stage.ui.wants_text());
    EXPECT_TRUE(stage.widget("first").focused) << "the keyboard stays";
}

TEST_F(NumberTest, a_digit_begins_to_type) {
    stage.to("first").click().type("0.8").press(Key::enter);
    stage.settle();
    EXPECT_NEAR(value, 0.8, 1e-12);
    EXPECT_EQ(reports.finished, 1);
}

TEST_F(NumberTest, tab_ends_typing_and_types_into_the_next) {
    stage.to("first").click().type("0.7").press(Key::tab).type("4").press(Key::enter);
    stage.settle();
    EXPECT_NEAR(value, 0.7, 1e-12);
    EXPECT_NEAR(second, 4, 1e-12);
    EXPECT_TRUE(stage.widget("second").focused);
}

TEST_F(NumberTest, escape_takes_typing_back) {
    stage.to("first").click().type("0.7").press(Key::escape);
    stage.settle();
    EXPECT_EQ(value, 0.5);
    EXPECT_EQ(reports.finished, 0);
    EXPECT_FALSE(stage.ui.wants_text());
}

TEST_F(NumberTest, what_is_not_a_number_stays_to_be_mended) {
    stage.to("first").click().press(Key::enter);
    stage.settle();
    stage.script.add(render::TextTyped{'k'}).add(render::TextTyped{'g'}).press(Key::enter);
    stage.settle();
    EXPECT_EQ(value, 0.5);
    EXPECT_TRUE(stage.ui.wants_text());
    stage.script.press(Key::backspace).press(Key::backspace).type("0.1").press(Key::enter);
    stage.settle();
    EXPECT_NEAR(value, 0.1, 1e-12);
}

TEST_F(NumberTest, a_number_beyond_the_range_is_the_end_of_it) {
    stage.to("first").click().type("7").press(Key::enter);
    stage.settle();
    EXPECT_EQ(value, 1);
    stage.script.type("0").press(Key::enter);
    stage.settle();
    EXPECT_EQ(value, 0);
}

TEST_F(NumberTest, arrows_step_and_are_one_change_until_released) {
    stage.to("first").click().key(Key::right, true);
    stage.settle();
    EXPECT_GT(value, 0.5);
    EXPECT_EQ(reports.finished, 0);
    stage.script.add(render::KeyChanged{Key::right, Key::right, true, true, {}});
    stage.settle();
    EXPECT_NEAR(value, 0.54, 1e-9);
    stage.script.key(Key::right, false);
    stage.settle();
    EXPECT_EQ(reports.finished, 1);
    EXPECT_TRUE(stage.widget("first").focused);
    stage.script.press(Key::delete_key);
    stage.settle();
    EXPECT_EQ(value, 0.5);
}

TEST_F(NumberTest, space_is_a_shortcut_beside_a_focused_number_and_digits_are_not) {
    bool space = false, digit = false;
    Stage other([&](Ui& ui) {
        number(ui, {.name = "n"}, value, range);
        space |= ui.shortcut(Key::space);
        digit |= ui.shortcut(Key::digit_1);
    });
    other.to("n").click().press(Key::space).press(Key::digit_1);
    other.settle();
    EXPECT_TRUE(space);
    EXPECT_FALSE(digit);
}

TEST(VectorWidget, each_number_is_its_own_and_one_mark_resets_all) {
    std::array<double, 3> values{1, 2, 3};
    const double usual[] = {0, 0, 0};
    Reports reports;
    Stage stage([&](Ui& ui) { reports.add(vector(ui, {.name = "v", .label = "V"}, values, {.unit = "m"}, usual)); });
    stage.to("v/y").click().type("8").press(Key::tab).type("9").press(Key::enter);
    stage.settle();
    EXPECT_EQ(values, (std::array<double, 3>{1, 8, 9}));
    EXPECT_EQ(reports.finished, 2);
    stage.to("v.reset").click();
    stage.settle();
    EXPECT_EQ(values, (std::array<double, 3>{0, 0, 0}));
}

TEST(IntegerWidget, has_whole_numbers) {
    long long value = 10;
    Stage stage([&](Ui& ui) { integer(ui, {.name = "i", .label = "I"}, value, {.min = 1, .max = 64}); });
    stage.to("i").click().type("6.6").press(Key::enter);
    stage.settle();
    EXPECT_EQ(value, 7);
    stage.script.press(Key::right);
    stage.settle();
    EXPECT_EQ(value, 8);
}

TEST(FlagWidget, changes_by_click_space_and_enter) {
    bool value = false;
    Reports reports;
    Stage stage([&](Ui& ui) { reports.add(flag(ui, {.name = "f", .label = "F"}, value, false)); });
    stage.to("f").click();
    stage.settle();
    EXPECT_TRUE(value);
    stage.script.press(Key::tab).press(Key::space);
    stage.settle();
    EXPECT_FALSE(value);
    stage.script.press(Key::enter);
    stage.settle();
    EXPECT_TRUE(value);
    EXPECT_EQ(reports.finished, 3);
    EXPECT_EQ(stage.widget("f").value, "on");
}

TEST(ChoiceWidget, opens_a_list_and_follows_the_arrow_keys) {
    std::size_t value = 0;
    constexpr std::string_view names[] = {"dihedral", "plate", "distance"};
    Reports reports;
    Stage stage([&](Ui& ui) { reports.add(choice(ui, {.name = "c", .label = "C"}, value, names, 0)); });
    stage.to("c").click();
    stage.settle();
    ASSERT_NE(stage.ui.probe().find("c/distance"), nullptr);
    stage.to("c/distance").click();
    stage.settle();
    EXPECT_EQ(value, 2u);
    EXPECT_EQ(stage.ui.probe().find("c/distance"), nullptr) << "the list is closed";
    stage.script.press(Key::tab).press(Key::left);
    stage.settle();
    EXPECT_EQ(value, 1u);
    stage.script.press(Key::enter);
    stage.settle();
    ASSERT_NE(stage.ui.probe().find("c/plate"), nullptr);
    EXPECT_TRUE(stage.widget("c/plate").focused);
    stage.script.press(Key::up).press(Key::enter);
    stage.settle();
    EXPECT_EQ(value, 0u);
    EXPECT_EQ(reports.finished, 3);
}

TEST(ChoiceWidget, has_a_list_that_stays_in_the_window) {
    constexpr std::string_view names[] = {"a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l"};
    for (const float above : {0.0f, 540.0f}) {
        std::size_t value = 0;
        Stage stage([&](Ui& ui) {
            ImGui::Dummy(ImVec2(1, above));
            choice(ui, {.name = "c", .label = "C"}, value, names, 0);
        });
        const ProbedWidget field = stage.widget("c");
        stage.to("c").click();
        stage.settle();
        for (const std::string_view name : names) {
            const ProbedWidget one = stage.widget("c/" + std::string(name));
            EXPECT_TRUE(one.visible) << above << name;
            EXPECT_GE(one.y, 0) << above << name;
            EXPECT_LE(one.y + one.height, stage.height) << above << name;
            EXPECT_TRUE(one.y >= field.y + field.height || one.y + one.height <= field.y) << above << name;
        }
        stage.to("c/l").click();
        stage.settle();
        EXPECT_EQ(value, 11u) << above;
    }
}

TEST(TextWidget, ends_by_enter_tab_and_click_and_takes_back_by_escape) {
    std::string value = "sheet";
    bool other = false;
    Reports reports;
    Stage stage([&](Ui& ui) {
        reports.add(text(ui, {.name = "t", .label = "T"}, value));
        flag(ui, {.name = "other", .label = "O"}, other);
    });
    stage.to("t").click();
    stage.settle();
    stage.script.type("flag").press(Key::enter);
    stage.settle();
    EXPECT_EQ(value, "flag");
    stage.to("t").click();
    stage.settle();
    stage.script.type("sail").press(Key::escape);
    stage.settle();
    EXPECT_EQ(value, "flag");
    stage.to("t").click();
    stage.settle();
    stage.script.type("kite").press(Key::tab);
    stage.settle();
    EXPECT_EQ(value, "kite");
    EXPECT_TRUE(stage.widget("other").focused);
    stage.to("t").click();
    stage.settle();
    stage.script.type("tent");
    stage.to("other").click();
    stage.settle();
    EXPECT_EQ(value, "tent");
    EXPECT_EQ(reports.finished, 3);
}

TEST(TextWidget, copies_and_pastes) {
    std::string one = "silk", other, clipboard;
    UiOptions options;
    options.clipboard = [&] { return clipboard; };
    options.set_clipboard = [&](const std::string& text) { clipboard = text; };
    Stage stage(
        [&](Ui& ui) {
            text(ui, {.name = "one", .label = "1"}, one);
            text(ui, {.name = "other", .label = "2"}, other);
        },
        options);
    stage.to("one").click().key(Key::left_control, true).press(Key::c).key(Key::left_control, false).press(Key::escape);
    stage.settle();
    EXPECT_EQ(clipboard, "silk");
    stage.to("other")
        .click()
        .key(Key::left_control, true)
        .press(Key::v)
        .key(Key::left_control, false)
        .press(Key::enter);
    stage.settle();
    EXPECT_EQ(other, "silk");
}

TEST(ButtonWidget, is_pressed_by_click_and_keys_and_not_beside_it) {
    int pressed = 0;
    Stage stage([&](Ui& ui) {
        if (button(ui, "b", {.icon = Icon::add, .text = "Add", .what = "Add it", .shortcut = "Ctrl+N"})) ++pressed;
        ImGui::Dummy(ImVec2(50, 50));
        if (button(ui, "off", {.text = "Off", .enabled = false})) pressed += 100;
    });
    stage.to("b").click(3);
    stage.settle();
    EXPECT_EQ(pressed, 3);
    stage.to("b").button(true).move(390, 590).button(false);
    stage.settle();
    EXPECT_EQ(pressed, 3) << "released elsewhere";
    stage.to("off").click();
    stage.settle();
    EXPECT_EQ(pressed, 3);
    stage.ui.focus("b");
    stage.settle();
    stage.script.press(Key::enter).press(Key::space);
    stage.settle();
    EXPECT_EQ(pressed, 5);
}

TEST(ColorWidget, is_typed_as_srgb) {
    Vec3 value{1, 1, 1};
    Reports reports;
    Stage stage([&](Ui& ui) { reports.add(color(ui, {.name = "c", .label = "C"}, value)); });
    stage.to("c.hex").click();
    stage.settle();
    stage.script.add(render::TextTyped{'#'}).type("bc0080").press(Key::enter);
    stage.settle();
    EXPECT_EQ(hex_of(value), "#bc0080");
    EXPECT_NEAR(value.x, 0.5029f, 1e-3f) << "linear";
    EXPECT_EQ(reports.finished, 1);
    EXPECT_FALSE(color_of("#12345").has_value());
    EXPECT_FALSE(color_of("#12345g").has_value());
    EXPECT_EQ(hex_of(*color_of("fa0")), "#ffaa00");
    stage.to("c").click();
    stage.settle();
    EXPECT_NE(stage.ui.probe().find("c/picker"), nullptr);
    stage.to("c/picker")
        .button(true)
        .move(stage.middle("c/picker").x - 10, stage.middle("c/picker").y + 5)
        .button(false);
    const int before = reports.finished;
    stage.settle();
    EXPECT_EQ(reports.finished, before + 1);
    EXPECT_NE(hex_of(value), "#bc0080");
}

TEST(SplitterWidget, is_dragged_and_moved_by_keys) {
    float size = 200;
    Stage stage([&](Ui& ui) {
        ImGui::Dummy(ImVec2(size, 100));
        ImGui::SameLine(0, 0);
        splitter(ui, "s", SplitAxis::x, 100, size, 100, 300);
    });
    const Vec2 at = stage.middle("s");
    stage.to("s").button(true).move(at.x + 50, at.y).button(false);
    stage.settle();
    EXPECT_EQ(size, 250);
    stage.to("s").button(true).move(at.x + 500, at.y).button(false);
    stage.settle();
    EXPECT_EQ(size, 300);
    stage.ui.focus("s");
    stage.settle();
    stage.script.press(Key::left);
    stage.settle();
    EXPECT_EQ(size, 284);
}

TEST(Focus, tab_goes_around_in_both_directions_and_skips_what_is_disabled) {
    std::array<bool, 4> values{};
    Stage stage([&](Ui& ui) {
        constexpr std::string_view names[] = {"a", "b", "c", "d"};
        for (std::size_t i = 0; i < 4; ++i) {
            if (i == 2) ImGui::BeginDisabled();
            flag(ui, {.name = names[i], .label = names[i]}, values[i]);
            if (i == 2) ImGui::EndDisabled();
        }
    });
    const auto focused = [&] {
        std::string all;
        for (const auto& [name, one] : stage.ui.probe().widgets())
            if (one.focused) all += name;
        return all;
    };
    std::string order;
    for (int i = 0; i < 4; ++i) {
        stage.script.press(Key::tab);
        stage.settle();
        order += focused();
    }
    EXPECT_EQ(order, "abda");
    stage.script.key(Key::left_shift, true).press(Key::tab).key(Key::left_shift, false);
    stage.settle();
    EXPECT_EQ(focused(), "d");
    stage.script.press(Key::up);
    stage.settle();
    EXPECT_EQ(focused(), "b");
}

TEST(Shortcuts, need_exactly_their_modifiers_and_no_text_field) {
    std::string value;
    int undo = 0, save = 0, letter = 0;
    Stage stage([&](Ui& ui) {
        text(ui, {.name = "t"}, value);
        undo += ui.shortcut(Key::z, {.control = true});
        save += ui.shortcut(Key::s, {.control = true});
        letter += ui.shortcut(Key::s);
    });
    const auto all = [&] {
        stage.script.key(Key::left_control, true)
            .press(Key::z)
            .press(Key::s)
            .key(Key::left_control, false)
            .press(Key::s);
        stage.settle();
    };
    all();
    EXPECT_EQ(undo, 1);
    EXPECT_EQ(save, 1);
    EXPECT_EQ(letter, 1);
    stage.to("t").click();
    stage.settle();
    all();
    EXPECT_EQ(undo, 1) << "the text field undoes";
    EXPECT_EQ(save, 2);
    EXPECT_EQ(letter, 1);
}

class LinkedVectorTest : public testing::Test {
  protected:
    std::array<double, 2> values{100, 100};
    static constexpr std::array<double, 2> usual{100, 100};
    static constexpr std::array<std::string_view, 2> parts{"warp", "weft"};
    Reports reports;
    Stage stage{[this](Ui& ui) {
        reports.add(linked_vector(ui, {.name = "v", .label = "Stretch"}, values, {.min = 0, .max = 1000, .unit = "N/m"},
                                  usual, parts));
    }};
    bool shows(const char* name) { return stage.ui.probe().find(name) != nullptr; }
};

TEST_F(LinkedVectorTest, equal_numbers_change_as_one) {
    EXPECT_TRUE(shows("v/all"));
    EXPECT_FALSE(shows("v/warp"));
    stage.to("v/all").click();
    stage.settle();
    stage.script.type("250").press(Key::enter);
    stage.settle();
    EXPECT_EQ(values, (std::array<double, 2>{250, 250}));
    EXPECT_EQ(reports.finished, 1);
}

TEST_F(LinkedVectorTest, can_be_taken_apart_and_linked_again) {
    stage.to("v/link").click();
    stage.settle();
    ASSERT_TRUE(shows("v/warp") && shows("v/weft"));
    EXPECT_EQ(reports.finished, 0) << "that changes nothing";
    stage.to("v/weft").click();
    stage.settle();
    stage.script.type("250").press(Key::enter);
    stage.settle();
    EXPECT_EQ(values, (std::array<double, 2>{100, 250}));
    stage.to("v/link").click();
    stage.settle();
    EXPECT_EQ(values, (std::array<double, 2>{100, 100}));
    EXPECT_TRUE(shows("v/all"));
}

TEST_F(LinkedVectorTest, different_numbers_have_rows_with_names) {
    values = {3, 4};
    stage.ui.redraw();
    stage.settle();
    ASSERT_TRUE(shows("v/warp") && shows("v/weft"));
    EXPECT_GT(stage.widget("v/weft").y, stage.widget("v/warp").y);
    EXPECT_GE(stage.widget("v/weft").width, 100);
}

}  // namespace
}  // namespace weft::editor
