// Places of tooltips.
#include "editor/ui/ui_stage.test.h"
#include "editor/ui/widgets/controls.h"
#include "editor/ui/widgets/number.h"

#include <gtest/gtest.h>

#include <array>

namespace weft::editor {
namespace {

class TooltipTest : public testing::Test {
  protected:
    TooltipTest() {
        stage.width = 800, stage.height = 300;
        stage.settle();
    }
    void rows(Ui& ui) {
        ImGui::SetCursorPos(ImVec2(left, 0));
        ImGui::BeginChild("panel", ImVec2(width, 300));
        for (std::size_t i = 0; i < values.size(); ++i)
            number(ui,
                   {.name = names[i],
                    .label = names[i],
                    .what = "A text that is long enough to need two lines in "
                            "a tooltip of the usual width, and no more"},
                   values[i], {.min = 0, .max = 1});
        ImGui::EndChild();
    }
    ImRect tip() {
        const ProbedWidget& shown = stage.widget("tooltip");
        return {ImVec2(shown.x, shown.y), ImVec2(shown.x + shown.width, shown.y + shown.height)};
    }
    void rest_on(std::string_view name) {
        stage.to(name);
        stage.settle();
        stage.script.wait(1);
        stage.settle();
    }

    float left = 500, width = 300;
    std::array<const char*, 8> names{"a", "b", "c", "d", "e", "f", "g", "h"};
    std::array<double, 8> values{};
    Stage stage{[this](Ui& ui) { rows(ui); }};
};

TEST_F(TooltipTest, stand_beside_the_panel_and_cover_no_row) {
    for (const float place : {500.0f, 0.0f}) {
        left = place;
        stage.settle();
        for (const char* const name : {"a", "h"}) {
            rest_on(name);
            const ImRect box = tip();
            ASSERT_GT(box.GetWidth(), 100) << name;
            EXPECT_FALSE(box.Overlaps(ImRect(ImVec2(left, 0), ImVec2(left + width, 300)))) << name;
            EXPECT_GE(box.Min.x, 0);
            EXPECT_GE(box.Min.y, 0);
            EXPECT_LE(box.Max.x, 800);
            EXPECT_LE(box.Max.y, 300);
        }
    }
}

TEST_F(TooltipTest, stand_within_the_window_if_the_panel_fills_it) {
    left = 0, width = 800;
    stage.settle();
    for (const char* const name : {"a", "h"}) {
        rest_on(name);
        const ImRect box = tip();
        ASSERT_GT(box.GetWidth(), 100) << name;
        const ProbedWidget& row = stage.widget(name);
        EXPECT_FALSE(box.Overlaps(ImRect(ImVec2(row.x, row.y), ImVec2(row.x + row.width, row.y + row.height))));
        EXPECT_LE(box.Max.x, 800);
        EXPECT_LE(box.Max.y, 300);
    }
}

}  // namespace
}  // namespace weft::editor
