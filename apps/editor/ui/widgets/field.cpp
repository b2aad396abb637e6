#include "editor/ui/widgets/field.h"

#include "editor/ui/compat.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace weft::editor {

void clipped_text(const ImRect& box, std::string_view text, ImU32 color, float align) {
    if (text.empty()) return;
    const char* begin = text.data();
    const char* end = begin + text.size();
    const ImVec2 size = ImGui::CalcTextSize(begin, end);
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float y = std::floor(box.Min.y + (box.GetHeight() - size.y) / 2);
    if (size.x <= box.GetWidth()) {
        const float x = std::floor(box.Min.x + align * (box.GetWidth() - size.x));
        list->AddText(ImVec2(x, y), color, begin, end);
        return;
    }
    const float dots = ImGui::CalcTextSize("…").x;
    const char* fits = begin;
    ImFont* font = ImGui::GetFont();
    font->CalcTextSizeA(ImGui::GetFontSize(), std::max(0.0f, box.GetWidth() - dots), 0, begin, end, &fits);
    while (fits > begin && (fits[-1] == '.' || fits[-1] == ' ')) --fits;
    if (fits > begin) list->AddText(ImVec2(box.Min.x, y), color, begin, fits);
    const float width = fits > begin ? ImGui::CalcTextSize(begin, fits).x : 0;
    list->AddText(ImVec2(std::floor(box.Min.x + width), y), color, "…");
}

void draw_icon(const Theme& theme, Icon icon, const ImRect& box, ImU32 color) {
    // The glyph of an icon is as wide as high, at the top of its line.
    const ImVec2 at = box.Min + (box.GetSize() - ImVec2(theme.icon_side, theme.icon_side)) * 0.5f;
    ImGui::GetWindowDrawList()->AddText(theme.body, theme.body->FontSize, ImVec2(std::round(at.x), std::round(at.y)),
                                        color, text_of(icon).c_str());
}

void muted_text(const Ui& ui, std::string_view text) {
    ImGui::PushStyleColor(ImGuiCol_Text, ui.theme().colors.muted);
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopStyleColor();
}

void draw_field(const Ui& ui, const Item& item, bool active) {
    const Palette& colors = ui.theme().colors;
    const ImVec4 color = active ? colors.field_active : item.hovered ? colors.field_hovered : colors.field;
    ImGui::GetWindowDrawList()->AddRectFilled(item.box.Min, item.box.Max, ui.theme().color(color),
                                              ImGui::GetStyle().FrameRounding);
}

void field_tooltip(Ui& ui, const Item& item, const Field& field, bool with_label) {
    if (!with_label && field.what.empty() && field.range.empty() && field.usual.empty()) return;
    ui.tooltip(item, [&] {
        if (with_label) ImGui::TextUnformatted(field.label.data(), field.label.data() + field.label.size());
        if (!field.what.empty()) ImGui::TextUnformatted(field.what.data(), field.what.data() + field.what.size());
        if (!field.range.empty()) muted_text(ui, field.range);
        if (!field.usual.empty())
            muted_text(ui, "Default " + field.usual + (field.differs ? " (double click resets)" : ""));
    });
}

Row begin_row(Ui& ui, const Field& field) {
    const Theme& theme = ui.theme();
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const float width = std::max(theme.px(40), ImGui::GetContentRegionAvail().x), height = ImGui::GetFrameHeight();
    const float mark = field.usual.empty() && !field.differs ? 0 : theme.px(22);
    const float label = field.label.empty() ? 0 : std::clamp(std::round(0.38f * width), theme.px(48), theme.px(180));
    const ImRect whole(from, from + ImVec2(width, height));
    Row row;
    row.control = ImRect(ImVec2(from.x + label, from.y), ImVec2(whole.Max.x - theme.px(22), whole.Max.y));
    if (field.label.empty() && mark == 0) row.control.Max.x = whole.Max.x;
    ImGui::ItemSize(whole, ImGui::GetStyle().FramePadding.y);
    if (label > 0) {
        const ImRect box(from, ImVec2(row.control.Min.x - theme.px(8), whole.Max.y));
        const bool enabled = (GImGui->CurrentItemFlags & ImGuiItemFlags_Disabled) == 0;
        const ImVec4 color = field.differs ? theme.colors.text : theme.colors.muted;
        clipped_text(box, field.label, theme.color(with_alpha(color, enabled ? 1 : 0.8f)));
        Item item = ui.place_at(std::string(field.name) + ".label", box, field.label, false);
        item.focused = false;
        const bool cut =
            ImGui::CalcTextSize(field.label.data(), field.label.data() + field.label.size()).x > box.GetWidth();
        field_tooltip(ui, item, field, cut);
        if (item.hovered && ImGui::GetIO().MouseClickedCount[0] == 2) row.reset = field.differs;
    }
    if (field.differs) {
        const ImRect box(ImVec2(row.control.Max.x, from.y), whole.Max);
        Item item = ui.place_at(std::string(field.name) + ".reset", box, {}, false);
        item.focused = false;
        if (item.hovered && ImGui::GetIO().MouseClicked[0]) row.reset = true;
        const ImVec4 color = item.hovered ? theme.colors.text : theme.colors.accent_text;
        draw_icon(theme, Icon::to_default, box, theme.color(color));
        ui.tooltip(item, [&] {
            ImGui::TextUnformatted(field.usual.empty() ? "Reset to the default" : "Reset to the default:");
            if (!field.usual.empty()) muted_text(ui, field.usual);
        });
    }
    return row;
}

// --- Typing

void begin_typing(Ui& ui, const Item& item, std::string text, bool at_end) {
    ui.gesture = {};
    ui.gesture.id = item.id;
    ui.gesture.typing = true;
    ui.gesture.at_end = at_end;
    ui.gesture.text = std::move(text);
    ui.redraw();
}

namespace {

std::string utf8(std::u32string_view text) {
    std::string out;
    for (const char32_t character : text) {
        char bytes[5]{};
        ImTextCharToUtf8(bytes, static_cast<unsigned>(character));
        out += bytes;
    }
    return out;
}

}  // namespace

void begin_typing_over(Ui& ui, const Item& item) {
    begin_typing(ui, item, utf8(ui.input().text), true);
    ui.gesture.took_text = true;
}

bool is_typing(const Ui& ui, const Item& item) {
    return ui.gesture.id == item.id && ui.gesture.typing;
}

Typed type_into(Ui& ui, const Item& item, std::string_view name, const ImRect& box, std::string_view hint) {
    constexpr std::size_t most = 1024;
    std::array<char, most> buffer{};
    Ui::Gesture& gesture = ui.gesture;
    const bool opening = !std::exchange(gesture.opened, true);
    // ImGui ignores text in the frame in which a field opens.
    if (opening && !gesture.took_text && !ui.input().text.empty()) {
        gesture.text = (gesture.at_end ? gesture.text : "") + utf8(ui.input().text);
        gesture.at_end = true;
    }
    std::memcpy(buffer.data(), gesture.text.data(), std::min(gesture.text.size(), most - 1));
    ImGuiWindow* window = ImGui::GetCurrentWindow();
    ImGuiWindowTempData& place = window->DC;
    const ImVec2 cursor = place.CursorPos, previous = place.CursorPosPrevLine, furthest = place.CursorMaxPos,
                 line = place.CurrLineSize, line_before = place.PrevLineSize;
    const float offset = place.CurrLineTextBaseOffset, offset_before = place.PrevLineTextBaseOffset;
    if (opening) {
        ImGui::FocusWindow(window);
        compat::request_text_input(item.id);
    }
    Typed typed;
    typed.edited = ImGui::TempInputText(box, item.id, Ui::label_of(name).c_str(), buffer.data(),
                                        static_cast<int>(buffer.size()), ImGuiInputTextFlags_AutoSelectAll);
    if (opening) {
        compat::forget_text_input_request();
        if (gesture.at_end) {
            ImGuiInputTextState& state = GImGui->InputTextState;
            state.Stb.cursor = state.Stb.select_start = state.Stb.select_end = state.CurLenW;
        }
    }
    place.CursorPos = cursor;
    place.CursorPosPrevLine = previous;
    place.CursorMaxPos = furthest;
    place.CurrLineSize = line;
    place.PrevLineSize = line_before;
    place.CurrLineTextBaseOffset = offset;
    place.PrevLineTextBaseOffset = offset_before;
    gesture.text = buffer.data();
    typed.text = gesture.text;
    if (typed.text.empty() && !hint.empty()) {
        ImRect inner = box;
        inner.Min.x += ImGui::GetStyle().FramePadding.x;
        clipped_text(inner, hint, ui.theme().color(ui.theme().colors.muted));
    }
    ImGui::GetWindowDrawList()->AddRect(box.Min, box.Max, ui.theme().color(ui.theme().colors.focus),
                                        ImGui::GetStyle().FrameRounding, 0, ui.theme().px(1.5f));
    if (opening) {
        typed.active = true;
        ui.redraw();
        return typed;
    }
    const bool tab = ui.pressed(Key::tab);
    typed.active = ImGui::TempInputIsActive(item.id) && !tab;
    if (typed.active) return typed;
    typed.entered = ui.pressed(Key::enter) || ui.pressed(Key::pad_enter);
    typed.cancelled = ui.pressed(Key::escape);
    typed.done = !typed.cancelled;
    gesture = {};
    if (tab) {
        ui.focus_next(!ui.input().modifiers().shift, true);
    } else if (typed.entered || typed.cancelled) {  // the keyboard stays here
        ImGui::SetFocusID(item.id, window);
        GImGui->NavDisableHighlight = false;
        GImGui->NavDisableMouseHover = true;
    }
    ui.redraw();
    return typed;
}

}  // namespace weft::editor
