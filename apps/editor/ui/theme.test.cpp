// Contrast of colors, letters of the typeface, icons, tracks of sliders, the probe's file.
#include "editor/ui/theme.h"

#include "editor/ui/ui_stage.test.h"
#include "editor/ui/widgets/controls.h"
#include "editor/ui/widgets/number.h"

#include "base/temporary_folder.test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numeric>
#include <set>
#include <sstream>

namespace weft::editor {
namespace {

using testing::HasSubstr;

// WCAG 2.1, level AA: 4.5 for text, 3 for the edges of what can be operated.
TEST(Palettes, have_enough_contrast) {
    for (const Appearance appearance : {Appearance::dark, Appearance::light}) {
        const Palette& c = palette(appearance);
        for (const ImVec4 ground : {c.panel, c.header, c.popup, c.background}) {
            for (const ImVec4 text : {c.text, c.muted, c.accent_text, c.good, c.warning, c.error})
                EXPECT_GE(contrast(text, ground), 4.5f) << static_cast<int>(appearance);
            EXPECT_GE(contrast(c.focus, ground), 3.0f);
        }
        for (const ImVec4 ground : {c.field, c.field_hovered, c.field_active, c.fill}) {
            EXPECT_GE(contrast(c.text, ground), 4.5f) << static_cast<int>(appearance);
            EXPECT_GE(contrast(c.muted, ground), 4.5f) << "units beside the number, " << static_cast<int>(appearance);
        }
        EXPECT_GE(contrast(c.on_accent, c.accent), 4.5f);
        EXPECT_GE(contrast(c.line, c.panel), 3.0f);
    }
    EXPECT_NEAR(contrast(ImVec4(0, 0, 0, 1), ImVec4(1, 1, 1, 1)), 21, 1e-3f);
    EXPECT_NEAR(contrast(ImVec4(1, 1, 1, 1), ImVec4(1, 1, 1, 1)), 1, 1e-6f);
}

TEST(Typeface, has_the_letters_that_units_and_texts_need) {
    for (const float scale : {0.75f, 1.0f, 3.0f}) {
        Ui ui({.scale = scale});
        ui.begin(100, 100, 0);
        for (ImFont* font : {ui.theme().body, ui.theme().strong, ui.theme().small})
            for (const char32_t letter : std::u32string_view(U"aZ09°²³⁻¹·µΩ→…×−≤≥±–“”"))
                EXPECT_NE(font->FindGlyphNoFallback(static_cast<ImWchar>(letter)), nullptr)
                    << static_cast<unsigned>(letter);
        for (const char32_t letter : std::u32string_view(U"ŠđЖяαΩẞ"))
            EXPECT_NE(ui.theme().body->FindGlyphNoFallback(static_cast<ImWchar>(letter)), nullptr)
                << static_cast<unsigned>(letter);
        for (int i = 1; i < static_cast<int>(Icon::count); ++i)
            EXPECT_NE(ui.theme().body->FindGlyphNoFallback(static_cast<ImWchar>(character_of(static_cast<Icon>(i)))),
                      nullptr);
        std::set<float> widths;
        for (ImWchar digit = '0'; digit <= '9'; ++digit) widths.insert(ui.theme().body->GetCharAdvance(digit));
        EXPECT_EQ(widths.size(), 1u) << "digits are equally wide";
        EXPECT_NEAR(ui.theme().body->FontSize, 18 * scale, 1);
        ui.end();
    }
}

TEST(Typeface, is_drawn_anew_for_another_scale) {
    Ui ui;
    ui.begin(100, 100, 0);
    EXPECT_TRUE(ui.take_new_fonts());
    ui.end();
    ui.begin(100, 100, 0.1);
    EXPECT_FALSE(ui.take_new_fonts());
    ui.set_theme(Appearance::light, 1.5f);
    ui.end();
    EXPECT_TRUE(ui.wants_frame());
    ui.begin(100, 100, 0.2);
    EXPECT_TRUE(ui.take_new_fonts());
    EXPECT_EQ(ui.theme().scale, 1.5f);
    EXPECT_EQ(ui.theme().px(10), 15);
    ui.end();
    ui.set_theme(Appearance::light, 99);
    ui.begin(100, 100, 0.3);
    EXPECT_EQ(ui.theme().scale, most_scale);
    ui.end();
}

TEST(Icons, differ_and_stay_within_their_square) {
    std::set<std::vector<std::uint8_t>> seen;
    for (int i = 1; i < static_cast<int>(Icon::count); ++i) {
        const auto icon = static_cast<Icon>(i);
        const std::vector<std::uint8_t> drawn = draw_icon(icon, 24);
        EXPECT_TRUE(seen.insert(drawn).second) << name_of(icon);
        const long sum = std::accumulate(drawn.begin(), drawn.end(), 0l);
        EXPECT_GT(sum, 255 * 20) << name_of(icon);
        for (std::size_t k = 0; k < 24; ++k)
            for (const std::size_t edge : {k, 23 * 24 + k, k * 24, k * 24 + 23})
                EXPECT_LT(drawn[edge], 200) << name_of(icon) << " is cut off";
    }
    EXPECT_EQ(text_of(Icon::play), "\xEE\x80\x81");
    EXPECT_EQ(text_of(Icon::none), "");
}

TEST(Tracks, go_from_end_to_end_and_back) {
    const NumberRange ranges[] = {{.min = 0, .max = 1, .usual = 0.1},
                                  {.min = -180, .max = 180},
                                  {.min = 1e-3, .max = 100},
                                  {.min = 0, .max = 1e6, .usual = 8000.0},
                                  {.min = 0, .usual = 0.15},
                                  {.min = 1, .max = 64, .integer = true},
                                  {}};
    for (const NumberRange& range : ranges) {
        const Track track(range, range.usual.value_or(0.5));
        double last = -1e30;
        for (double at = 0; at <= 1; at += 0.05) {
            const double value = track.value(at);
            EXPECT_GE(value, last);
            last = value;
            EXPECT_NEAR(track.position(value), at, 1e-6);
        }
        if (std::isfinite(range.max)) {
            EXPECT_NEAR(track.value(1), range.max, 1e-6 * std::abs(range.max));
            EXPECT_NEAR(track.value(0), range.min, 1e-6);
            EXPECT_TRUE(track.bounded());
        }
    }
    EXPECT_TRUE(Track(ranges[2], 1).logarithmic());
    EXPECT_TRUE(Track(ranges[3], 8000).logarithmic());
    EXPECT_FALSE(Track(ranges[0], 0.1).logarithmic());
    EXPECT_FALSE(Track(ranges[1], 0).logarithmic());
    EXPECT_FALSE(Track(ranges[6], 0).bounded());
    const double middle = Track(ranges[3], 8000).position(8000);
    EXPECT_GT(middle, 0.2) << "the default is within reach";
    EXPECT_LT(middle, 0.8);
}

TEST(Ranges, are_described_and_keep_numbers_within) {
    EXPECT_EQ(describe({.min = 0, .max = 1000, .unit = "N/m"}), "0 … 1000 N/m");
    EXPECT_EQ(describe({.min = 0, .min_excluded = true, .unit = "kg/m²"}), "> 0 kg/m²");
    EXPECT_EQ(describe({.min = 5, .zero_too = true, .unit = "N/m"}), "≥ 5 N/m, or 0");
    EXPECT_EQ(describe({}), "");
    EXPECT_EQ(describe({.min = -1e6, .max = 1e6, .unit = "m"}), "in m");
    EXPECT_GT(clamped(0, {.min = 0, .max = 10, .min_excluded = true}), 0);
    EXPECT_EQ(clamped(1, {.min = 5, .zero_too = true}), 0);
    EXPECT_EQ(clamped(4, {.min = 5, .zero_too = true}), 5);
    EXPECT_EQ(clamped(2.6, {.min = 1, .max = 64, .integer = true}), 3);
}

std::string text_in(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

TEST(Probes, tell_where_widgets_are) {
    bool value = true;
    Stage stage([&](Ui& ui) {
        const Ui::Scope scope(ui, "panel \"1\"");
        flag(ui, {.name = "wind", .label = "Wind"}, value);
        ImGui::Dummy(ImVec2(10, 2000));
        button(ui, "below", {.text = "Below"});
    });
    const ProbedWidget& widget = stage.widget("panel \"1\"/wind");
    EXPECT_TRUE(widget.visible);
    EXPECT_EQ(widget.value, "on");
    EXPECT_GT(widget.width, 20);
    EXPECT_FALSE(stage.widget("panel \"1\"/below").visible);
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "probe.json";
    ASSERT_TRUE(stage.ui.probe().write(file).ok());
    const std::string text = text_in(file);
    EXPECT_THAT(text, HasSubstr("\"panel \\\"1\\\"/wind\": {\"x\": "));
    EXPECT_THAT(text, HasSubstr("\"value\": \"on\""));
    EXPECT_THAT(text, HasSubstr("\"window\": {\"width\": 400, \"height\": 600, \"scale\": 1}"));
    EXPECT_FALSE(stage.ui.probe().write(folder.path() / "none" / "probe.json").ok());
}

TEST(Probes, count_frames_after_which_nothing_is_left) {
    bool animated = false;
    Stage stage([&](Ui& ui) {
        if (animated) ui.redraw();
    });
    const std::uint64_t before = stage.ui.probe().settled;
    stage.script.move(10, 10).click();
    stage.ui.add(stage.script.take());
    while (stage.ui.wants_frame()) {
        EXPECT_EQ(stage.ui.probe().settled, before);
        stage.frame();
    }
    EXPECT_EQ(stage.ui.probe().settled, before + 1);
    animated = true;
    for (int i = 0; i < 5; ++i) stage.frame();
    EXPECT_EQ(stage.ui.probe().settled, before + 1);
}

}  // namespace
}  // namespace weft::editor
