#include "editor/ui/widgets/controls.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

namespace weft::editor {
namespace {

constexpr int bit_count = 32, bit_columns = 8;

std::string summary_of_bits(std::uint32_t value) {
    if (value == 0) return "none";
    if (value == ~0u) return "all";
    const int on = std::popcount(value);
    if (on <= 4 || bit_count - on <= 4) {
        std::string text = on <= 4 ? "" : "all but";
        for (int i = 0; i < bit_count; ++i)
            if (((value >> i & 1u) != 0) == (on <= 4)) text += (text.empty() ? "" : " ") + std::to_string(i);
        return text;
    }
    return std::to_string(on) + " of 32";
}

/// The box on which the arrow keys are. One set of boxes has the keyboard at a time.
int& chosen_bit() {
    static int box = 0;
    return box;
}

}  // namespace

Change bits(Ui& ui, const Field& field, std::uint32_t& value, std::optional<std::uint32_t> usual) {
    Field whole = field;
    whole.differs = usual && *usual != value;
    if (usual) whole.usual = summary_of_bits(*usual);
    const Row row = begin_row(ui, whole);
    if (row.reset && usual) {
        value = *usual;
        return Change::finished;
    }
    const Theme& theme = ui.theme();
    const Palette& colors = theme.colors;
    const std::string summary = summary_of_bits(value);
    clipped_text(row.control, summary, theme.color(colors.text));
    // The boxes stand below, over the whole row.
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const float side = std::floor(std::max(theme.px(8), ImGui::GetContentRegionAvail().x / bit_columns));
    const float high = std::round(ImGui::GetFontSize() * 1.35f);
    const ImVec2 size(side * bit_columns, high * (bit_count / bit_columns));
    const Item item = ui.place(field.name, size, summary);
    const auto box_of = [&](int i) {
        const ImVec2 corner(from.x + side * static_cast<float>(i % bit_columns),
                            from.y + high * static_cast<float>(i / bit_columns));
        return ImRect(corner, ImVec2(corner.x + side - theme.px(2), corner.y + high - theme.px(2)));
    };
    int under = -1, pressed = -1;
    int& chosen = chosen_bit();
    const ImGuiIO& io = ImGui::GetIO();
    for (int i = 0; i < bit_count && item.hovered; ++i)
        if (box_of(i).Contains(io.MousePos)) under = i;
    if (item.hovered && io.MouseClicked[0]) {
        ImGui::FocusWindow(ImGui::GetCurrentWindow());
        ImGui::SetFocusID(item.id, ImGui::GetCurrentWindow());
        GImGui->NavDisableHighlight = false;  // after a click keys go here
        pressed = chosen = std::max(under, 0);
        if (under < 0) pressed = -1;
    }
    if (item.focused) {
        ui.keep_arrows(item);
        ui.keep_delete();
        const auto step = [&](Key key, int by) {
            if (ui.pressed(key, true)) chosen = std::clamp(chosen + by, 0, bit_count - 1);
        };
        step(Key::left, -1), step(Key::right, 1);
        if (ui.pressed(Key::space) || ui.pressed(Key::enter) || ui.pressed(Key::pad_enter)) pressed = chosen;
        if (usual && value != *usual && (ui.pressed(Key::delete_key) || ui.pressed(Key::backspace))) {
            value = *usual;
            return Change::finished;
        }
    }
    ImGui::PushFont(theme.small);
    const Ui::Scope scope(ui, field.name);
    for (int i = 0; i < bit_count; ++i) {
        const ImRect box = box_of(i);
        const bool on = (value >> i & 1u) != 0;
        ui.note(std::to_string(i), box, on ? "on" : "off");
        if (!item.visible) continue;
        ImDrawList* list = ImGui::GetWindowDrawList();
        const ImVec4 off_ground = i == under ? colors.field_hovered : colors.field;
        list->AddRectFilled(box.Min, box.Max, theme.color(on ? colors.fill : off_ground), theme.px(2));
        const std::string text = std::to_string(i);
        const ImVec2 wide = ImGui::CalcTextSize(text.c_str());
        list->AddText(
            ImVec2(std::floor((box.Min.x + box.Max.x - wide.x) / 2), std::floor((box.Min.y + box.Max.y - wide.y) / 2)),
            theme.color(on ? colors.text : colors.muted), text.c_str());
        // A line as well, so that they are not told by color alone.
        if (on)
            list->AddRectFilled(ImVec2(box.Min.x + theme.px(3), box.Max.y - theme.px(2)),
                                ImVec2(box.Max.x - theme.px(3), box.Max.y - theme.px(1)),
                                theme.color(colors.accent_text));
        if (item.focused && i == chosen) list->AddRect(box.Min, box.Max, theme.color(colors.focus), 0, 0, theme.px(2));
    }
    ImGui::PopFont();
    field_tooltip(ui, item, whole);
    if (pressed < 0) return Change::none;
    value ^= 1u << pressed;
    ui.redraw();
    return Change::finished;
}

}  // namespace weft::editor
