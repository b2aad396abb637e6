#include "editor/ui/widgets/controls.h"

#include <algorithm>
#include <cmath>

namespace weft::editor {
namespace {

constexpr float icon_gap = 6;

/// Whether the item is pressed: a click that ends on it, or Space or Enter while it has the keyboard.
bool press(Ui& ui, const Item& item, bool& held) {
    const ImGuiIO& io = ImGui::GetIO();
    ImGuiWindow* window = ImGui::GetCurrentWindow();
    if (item.hovered && io.MouseClicked[0]) {
        ImGui::FocusWindow(window);
        ImGui::SetActiveID(item.id, window);
        ImGui::SetFocusID(item.id, window);
    }
    held = ImGui::GetActiveID() == item.id;
    if (held && !io.MouseDown[0]) {
        ImGui::ClearActiveID();
        ui.redraw();
        return item.box.Contains(io.MousePos);
    }
    return item.focused && (ui.pressed(Key::space) || ui.pressed(Key::enter) || ui.pressed(Key::pad_enter));
}

bool differs(std::optional<bool> usual, bool value) {
    return usual && *usual != value;
}

}  // namespace

// --- Buttons

float button_width(const Ui& ui, const ButtonStyle& style) {
    const Theme& theme = ui.theme();
    if (style.text.empty()) return ImGui::GetFrameHeight();
    const float text = ImGui::CalcTextSize(style.text.data(), style.text.data() + style.text.size()).x;
    const float icon = style.icon == Icon::none ? 0 : theme.icon_side + theme.px(icon_gap);
    return std::ceil(text + icon + 2 * theme.px(10));
}

bool button(Ui& ui, std::string_view name, const ButtonStyle& style) {
    const Theme& theme = ui.theme();
    const Palette& colors = theme.colors;
    if (!style.enabled) ImGui::BeginDisabled();
    const float width = style.width > 0 ? style.width : button_width(ui, style);
    const Item item = ui.place(name, ImVec2(width, ImGui::GetFrameHeight()), style.chosen ? "on" : style.text);
    bool held = false;
    const bool pressed = style.enabled && press(ui, item, held);
    if (item.visible) {
        ImDrawList* list = ImGui::GetWindowDrawList();
        const float round = ImGui::GetStyle().FrameRounding;
        const bool filled = style.primary || style.chosen;
        ImVec4 ground = filled ? colors.accent : colors.field;
        if (held) ground = filled ? between(colors.accent, colors.background, 0.25f) : colors.field_active;
        if (item.hovered && !held)
            ground = filled ? between(colors.accent, colors.background, 0.12f) : colors.field_hovered;
        if (!style.flat || filled || item.hovered || held)
            list->AddRectFilled(item.box.Min, item.box.Max, theme.color(ground), round);
        const ImU32 color = theme.color(filled ? colors.on_accent : colors.text);
        if (style.chosen && style.text.empty()) {
            const float inset = theme.px(6), line = theme.px(2);
            list->AddRectFilled(ImVec2(item.box.Min.x + inset, item.box.Max.y - 2 * line),
                                ImVec2(item.box.Max.x - inset, item.box.Max.y - line), color);
        }
        const float text = ImGui::CalcTextSize(style.text.data(), style.text.data() + style.text.size()).x;
        const bool has_icon = style.icon != Icon::none;
        const float content = (has_icon ? theme.icon_side + (style.text.empty() ? 0 : theme.px(icon_gap)) : 0) + text;
        const float middle = std::max(0.0f, (item.box.GetWidth() - content) / 2);
        float x = std::floor(item.box.Min.x + (style.left ? std::min(middle, theme.px(8)) : middle));
        if (has_icon) {
            draw_icon(theme, style.icon, ImRect(ImVec2(x, item.box.Min.y), ImVec2(x + theme.icon_side, item.box.Max.y)),
                      color);
            x += theme.icon_side + theme.px(icon_gap);
        }
        if (!style.text.empty())
            clipped_text(ImRect(ImVec2(x, item.box.Min.y), item.box.Max - ImVec2(theme.px(4), 0)), style.text, color);
    }
    ui.draw_focus(item);
    if (!style.what.empty() || !style.shortcut.empty()) {
        ui.tooltip(item, [&] {
            const std::string_view what = style.what.empty() ? style.text : style.what;
            ImGui::TextUnformatted(what.data(), what.data() + what.size());
            if (!style.shortcut.empty()) muted_text(ui, style.shortcut);
        });
    }
    if (!style.enabled) ImGui::EndDisabled();
    return pressed;
}

bool area_button(Ui& ui, std::string_view name, ImVec2 size, std::string_view value, std::string_view what) {
    const Theme& theme = ui.theme();
    const Item item = ui.place(name, size, value);
    bool held = false;
    const bool pressed = press(ui, item, held);
    const ImVec4 ground = held           ? theme.colors.field_active
                          : item.hovered ? theme.colors.field_hovered
                                         : theme.colors.field;
    if (item.visible)
        ImGui::GetWindowDrawList()->AddRectFilled(item.box.Min, item.box.Max, theme.color(ground),
                                                  ImGui::GetStyle().FrameRounding);
    ui.draw_focus(item);
    if (!what.empty()) ui.tooltip(item, [&] { ImGui::TextUnformatted(what.data(), what.data() + what.size()); });
    return pressed;
}

// --- Flag

Change flag(Ui& ui, const Field& field, bool& value, std::optional<bool> usual) {
    Field whole = field;
    whole.differs = differs(usual, value);
    if (usual) whole.usual = *usual ? "on" : "off";
    const Row row = begin_row(ui, whole);
    const Theme& theme = ui.theme();
    if (row.reset && usual) {
        value = *usual;
        return Change::finished;
    }
    const float side = theme.icon_side;
    const ImVec2 corner(row.control.Min.x, std::floor(row.control.Min.y + (row.control.GetHeight() - side) / 2));
    const char* state = value ? "On" : "Off";
    const float wide = side + theme.px(icon_gap) + ImGui::CalcTextSize("Off").x + theme.px(6);
    const ImRect box(ImVec2(corner.x, row.control.Min.y), ImVec2(corner.x + wide, row.control.Max.y));
    const Item item = ui.place_at(field.name, box, value ? "on" : "off");
    bool held = false;
    bool pressed = press(ui, item, held);
    if (item.focused && usual) ui.keep_delete();
    if (item.focused && usual && (ui.pressed(Key::delete_key) || ui.pressed(Key::backspace)) && whole.differs)
        pressed = true;
    if (item.visible) {
        const Palette& colors = theme.colors;
        ImDrawList* list = ImGui::GetWindowDrawList();
        const ImRect square(corner, corner + ImVec2(side, side));
        const ImVec4 ground = value ? colors.accent : item.hovered ? colors.field_hovered : colors.field;
        list->AddRectFilled(square.Min, square.Max, theme.color(ground), theme.px(4));
        if (!value) list->AddRect(square.Min, square.Max, theme.color(colors.line), theme.px(4), 0, theme.px(1));
        if (value) draw_icon(theme, Icon::check, square, theme.color(colors.on_accent));
        const ImRect text(ImVec2(square.Max.x + theme.px(icon_gap), row.control.Min.y), row.control.Max);
        clipped_text(text, state, ImGui::GetColorU32(ImGuiCol_Text));
    }
    ui.draw_focus(item);
    field_tooltip(ui, item, whole);
    if (!pressed) return Change::none;
    value = !value;
    ui.redraw();
    return Change::finished;
}

// --- Choice

namespace {

float widest_of(std::span<const std::string_view> texts) {
    float widest = 0;
    for (const std::string_view one : texts)
        widest = std::max(widest, ImGui::CalcTextSize(one.data(), one.data() + one.size()).x);
    return widest;
}

/// The list of names. Returns the one that was chosen.
std::optional<std::size_t> choice_list(Ui& ui, std::string_view name, const ImRect& field, std::size_t value,
                                       std::span<const std::string_view> names,
                                       std::span<const std::string_view> whats) {
    const Theme& theme = ui.theme();
    std::optional<std::size_t> chosen;
    const float indent = theme.icon_side + theme.px(12), names_end = indent + widest_of(names) + theme.px(16);
    float widest = std::max(field.GetWidth() - theme.px(8), names_end - theme.px(4));
    if (!whats.empty()) widest = std::max(widest, names_end + widest_of(whats) + theme.px(8));
    widest = std::min(widest, ui.size().x - theme.px(24));
    // Below the field, or above it where there is more room. A long list scrolls.
    const float gap = theme.px(3), below = ui.size().y - field.Max.y - 2 * gap, above = field.Min.y - 2 * gap;
    const float whole = static_cast<float>(names.size()) * ImGui::GetFrameHeight() + theme.px(8);
    const bool upward = whole > below && above > below;
    const float height = std::min({whole, std::max(theme.px(60), upward ? above : below), theme.px(420)});
    const float left = std::clamp(field.Min.x, 0.0f, std::max(0.0f, ui.size().x - widest - theme.px(16)));
    ImGui::SetNextWindowPos(ImVec2(left, upward ? field.Min.y - gap - height : field.Max.y + gap));
    ImGui::SetNextWindowSizeConstraints(ImVec2(field.GetWidth(), 0), ImVec2(FLT_MAX, height));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(theme.px(4), theme.px(4)));
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
    if (ImGui::BeginPopup(Ui::label_of(std::string(name) + ".list").c_str(), ImGuiWindowFlags_NoMove)) {
        {
            const Ui::Scope scope(ui, name);
            for (std::size_t i = 0; i < names.size(); ++i) {
                const Item item =
                    ui.place(names[i], ImVec2(widest, ImGui::GetFrameHeight()), i == value ? "chosen" : "");
                bool held = false;
                if (press(ui, item, held)) chosen = i;
                if (i == value) ImGui::SetItemDefaultFocus();
                if (item.hovered || item.focused || held) draw_field(ui, item, held);
                if (i == value) {
                    const ImRect mark(item.box.Min,
                                      ImVec2(item.box.Min.x + theme.icon_side + theme.px(8), item.box.Max.y));
                    draw_icon(theme, Icon::check, mark, theme.color(theme.colors.accent_text));
                }
                const ImRect text(item.box.Min + ImVec2(indent, 0), item.box.Max);
                clipped_text(text, names[i], ImGui::GetColorU32(ImGuiCol_Text));
                if (i < whats.size())
                    clipped_text(ImRect(item.box.Min + ImVec2(names_end, 0), item.box.Max), whats[i],
                                 ImGui::GetColorU32(ImGuiCol_TextDisabled));
                ui.draw_focus(item);
            }
        }
        if (chosen || ui.pressed(Key::escape)) ImGui::CloseCurrentPopup();
        ImGui::EndPopup();
    }
    ImGui::PopStyleVar(2);
    return chosen;
}

}  // namespace

Change choice(Ui& ui, const Field& field, std::size_t& value, std::span<const std::string_view> names,
              std::optional<std::size_t> usual, std::span<const std::string_view> whats) {
    Field whole = field;
    std::string what(field.what);
    if (value < whats.size()) {
        what += (what.empty() ? "" : "\n") + std::string(names[value]) + ": " + std::string(whats[value]);
        whole.what = what;
    }
    whole.differs = usual && *usual != value;
    if (usual && *usual < names.size()) whole.usual = names[*usual];
    const Row row = begin_row(ui, whole);
    const Theme& theme = ui.theme();
    if (row.reset && usual) {
        value = *usual;
        return Change::finished;
    }
    const std::string_view shown = value < names.size() ? names[value] : "";
    const Item item = ui.place_at(field.name, row.control, shown);
    ui.keep_arrows(item);
    bool held = false;
    const std::string list = Ui::label_of(std::string(field.name) + ".list");
    const bool open = ImGui::IsPopupOpen(list.c_str());
    if (press(ui, item, held)) {
        ImGui::OpenPopup(list.c_str());
        ui.redraw();
    }
    std::size_t now = value;
    if (item.focused && !open && !names.empty()) {
        if (ui.pressed(Key::right, true)) now = std::min(value + 1, names.size() - 1);
        if (ui.pressed(Key::left, true) && value > 0) now = value - 1;
        if ((ui.pressed(Key::delete_key) || ui.pressed(Key::backspace)) && usual) now = *usual;
    }
    if (item.visible) {
        draw_field(ui, item, held || open);
        const float side = ImGui::GetFrameHeight();
        ImRect text(item.box.Min + ImVec2(theme.px(8), 0), item.box.Max - ImVec2(side, 0));
        clipped_text(text, shown, ImGui::GetColorU32(ImGuiCol_Text));
        const ImRect arrow(ImVec2(item.box.Max.x - side, item.box.Min.y), item.box.Max);
        draw_icon(theme, Icon::down, arrow, ImGui::GetColorU32(ImGuiCol_TextDisabled));
    }
    ui.draw_focus(item);
    if (!open) field_tooltip(ui, item, whole);
    if (const auto chosen = choice_list(ui, field.name, row.control, value, names, whats)) {
        now = *chosen;
        ui.redraw();
    }
    if (now == value) return Change::none;
    value = now;
    return Change::finished;
}

// --- Text

Change text(Ui& ui, const Field& field, std::string& value, std::string_view hint) {
    const Row row = begin_row(ui, field);
    const Theme& theme = ui.theme();
    const Item item = ui.place_at(field.name, row.control, value);
    if (is_typing(ui, item)) {
        const Typed typed = type_into(ui, item, field.name, row.control, hint);
        if (typed.active || typed.cancelled || typed.text == value) return Change::none;
        value = typed.text;
        return Change::finished;
    }
    const bool clicked = item.hovered && ImGui::GetIO().MouseClicked[0];
    const bool by_key = item.focused && (ui.pressed(Key::enter) || ui.pressed(Key::pad_enter) || ui.pressed(Key::f2));
    if (clicked || by_key || ui.takes_typing(item)) begin_typing(ui, item, value);
    if (item.focused && !ui.input().text.empty() && ui.input().text[0] > U' ' && !is_typing(ui, item))
        begin_typing_over(ui, item);
    if (is_typing(ui, item)) {
        (void)type_into(ui, item, field.name, row.control, hint);
        return Change::none;
    }
    if (item.hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_TextInput);
    if (item.visible) {
        draw_field(ui, item, false);
        const ImRect inner(item.box.Min + ImVec2(ImGui::GetStyle().FramePadding.x, 0),
                           item.box.Max - ImVec2(theme.px(4), 0));
        clipped_text(inner, value.empty() ? hint : value,
                     ImGui::GetColorU32(value.empty() ? ImGuiCol_TextDisabled : ImGuiCol_Text));
    }
    ui.draw_focus(item);
    field_tooltip(ui, item, field);
    return Change::none;
}

// --- Section, note, progress

bool section(Ui& ui, std::string_view name, std::string_view label, bool& open, Icon icon) {
    const Theme& theme = ui.theme();
    const Item item =
        ui.place(name, ImVec2(ImGui::GetContentRegionAvail().x, ImGui::GetFrameHeight()), open ? "open" : "closed");
    bool held = false;
    if (press(ui, item, held)) open = !open;
    if (item.focused) {  // as in lists of folders
        ui.keep_arrows(item);
        if (ui.pressed(Key::right)) open = true;
        if (ui.pressed(Key::left)) open = false;
    }
    if (item.visible) {
        const Palette& colors = theme.colors;
        const ImVec4 ground = held ? colors.field_active : item.hovered ? colors.field_hovered : colors.header;
        ImGui::GetWindowDrawList()->AddRectFilled(item.box.Min, item.box.Max, theme.color(ground),
                                                  ImGui::GetStyle().FrameRounding);
        const float side = ImGui::GetFrameHeight();
        ImRect arrow(item.box.Min, item.box.Min + ImVec2(side, side));
        draw_icon(theme, open ? Icon::down : Icon::right, arrow, theme.color(colors.muted));
        float x = arrow.Max.x + theme.px(2);
        if (icon != Icon::none) {
            draw_icon(theme, icon, ImRect(ImVec2(x, arrow.Min.y), ImVec2(x + theme.icon_side, arrow.Max.y)),
                      theme.color(colors.text));
            x += theme.icon_side + theme.px(icon_gap);
        }
        ImGui::PushFont(theme.strong);
        clipped_text(ImRect(ImVec2(x, item.box.Min.y), item.box.Max - ImVec2(theme.px(6), 0)), label,
                     ImGui::GetColorU32(ImGuiCol_Text));
        ImGui::PopFont();
    }
    ui.draw_focus(item);
    return open;
}

void note(Ui& ui, std::string_view name, Note kind, std::string_view text) {
    const Theme& theme = ui.theme();
    const Palette& colors = theme.colors;
    const Icon icon = kind == Note::info      ? Icon::info
                      : kind == Note::good    ? Icon::check
                      : kind == Note::warning ? Icon::warning
                                              : Icon::error;
    const ImVec4 color = kind == Note::info      ? colors.accent_text
                         : kind == Note::good    ? colors.good
                         : kind == Note::warning ? colors.warning
                                                 : colors.error;
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const float indent = theme.icon_side + theme.px(icon_gap);
    const float width = std::max(theme.px(40), ImGui::GetContentRegionAvail().x - indent);
    const char *begin = text.data(), *end = begin + text.size();
    const ImVec2 size = ImGui::CalcTextSize(begin, end, false, width);
    const ImRect box(from, from + ImVec2(indent + width, std::max(size.y, theme.body->FontSize)));
    ImGui::ItemSize(box);
    ui.note(name, box, text);
    if (!ImGui::ItemAdd(box, 0)) return;
    draw_icon(theme, icon, ImRect(from, from + ImVec2(theme.icon_side, theme.body->FontSize)), theme.color(color));
    ImGui::GetWindowDrawList()->AddText(theme.body, theme.body->FontSize, from + ImVec2(indent, 0),
                                        theme.color(colors.text), begin, end, width);
}

bool progress(Ui& ui, std::string_view name, float done, std::string_view text, bool can_cancel) {
    const Theme& theme = ui.theme();
    const Palette& colors = theme.colors;
    const ButtonStyle cancel{.icon = Icon::cross, .what = "Cancel", .flat = true};
    const float gap = theme.px(4), side = can_cancel ? button_width(ui, cancel) + gap : 0;
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const ImRect box(from, from + ImVec2(ImGui::GetContentRegionAvail().x - side, ImGui::GetFrameHeight()));
    ImGui::ItemSize(box, ImGui::GetStyle().FramePadding.y);
    const int percent = static_cast<int>(std::floor(100 * std::clamp(done, 0.0f, 1.0f)));
    const std::string share = done < 0 ? "" : std::to_string(percent) + "%";
    ui.note(name, box, share);
    if (ImGui::ItemAdd(box, 0)) {
        ImDrawList* list = ImGui::GetWindowDrawList();
        const float round = ImGui::GetStyle().FrameRounding;
        list->AddRectFilled(box.Min, box.Max, theme.color(colors.field), round);
        float begin = 0, end = std::clamp(done, 0.0f, 1.0f);
        if (done < 0) {  // a part that wanders
            begin = static_cast<float>(std::fmod(ui.now() * 0.5, 1.0)) * 1.2f - 0.2f;
            end = std::min(1.0f, begin + 0.2f);
            begin = std::max(0.0f, begin);
            ui.redraw_in(1.0 / 20);
        }
        const float left = box.Min.x + begin * box.GetWidth(), right = box.Min.x + end * box.GetWidth();
        if (right - left > 1)
            list->AddRectFilled(ImVec2(left, box.Min.y), ImVec2(right, box.Max.y), theme.color(colors.fill),
                                std::min(round, (right - left) / 2));
        const float wide = ImGui::CalcTextSize(share.c_str()).x;
        const ImRect inner(box.Min + ImVec2(theme.px(8), 0), box.Max - ImVec2(theme.px(8), 0));
        clipped_text(ImRect(inner.Min, inner.Max - ImVec2(wide + theme.px(6), 0)), text,
                     ImGui::GetColorU32(ImGuiCol_Text));
        clipped_text(inner, share, ImGui::GetColorU32(ImGuiCol_Text), 1);
    }
    if (!can_cancel) return false;
    ImGui::SameLine(0, gap);
    return button(ui, std::string(name) + ".cancel", cancel);
}

}  // namespace weft::editor
