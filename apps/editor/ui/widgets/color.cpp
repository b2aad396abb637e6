#include "editor/ui/widgets/color.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace weft::editor {
namespace {

float encoded(float c) {
    c = std::clamp(c, 0.0f, 1.0f);
    return c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f;
}

float decoded_value(float c) {
    return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}

// The picker in its popup.
Change pick(Ui& ui, const char* list, Vec3& linear) {
    Change change = Change::none;
    if (!ImGui::BeginPopup(list)) return change;
    float shown[3] = {encoded(linear.x), encoded(linear.y), encoded(linear.z)};
    ImGui::SetNextItemWidth(ui.theme().px(220));
    const bool edited = ImGui::ColorPicker3("##picker", shown,
                                            ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_NoLabel |
                                                ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_PickerHueWheel);
    ui.note("picker", ImRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax()));
    if (edited) {
        linear = {decoded_value(shown[0]), decoded_value(shown[1]), decoded_value(shown[2])};
        change = Change::in_progress;
        ui.redraw();
    }
    if (ImGui::IsItemDeactivatedAfterEdit()) change = Change::finished;
    if (ui.pressed(Key::escape)) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    return change;
}

}  // namespace

std::string hex_of(Vec3 linear) {
    const auto byte = [](float c) { return static_cast<unsigned>(std::lround(255 * encoded(c))); };
    char out[8];
    std::snprintf(out, sizeof out, "#%02x%02x%02x", byte(linear.x) & 255, byte(linear.y) & 255, byte(linear.z) & 255);
    return out;
}

std::optional<Vec3> color_of(std::string_view hex) {
    while (!hex.empty() && (hex.front() == ' ' || hex.front() == '#')) hex.remove_prefix(1);
    while (!hex.empty() && hex.back() == ' ') hex.remove_suffix(1);
    if (hex.size() != 3 && hex.size() != 6) return std::nullopt;
    unsigned value = 0;
    const auto [end, failed] = std::from_chars(hex.data(), hex.data() + hex.size(), value, 16);
    if (failed != std::errc() || end != hex.data() + hex.size()) return std::nullopt;
    const bool brief = hex.size() == 3;
    const auto channel = [&](unsigned index) {
        const unsigned byte = brief ? (value >> (8 - 4 * index) & 15) * 17 : value >> (16 - 8 * index) & 255;
        return decoded_value(static_cast<float>(byte) / 255);
    };
    return Vec3{channel(0), channel(1), channel(2)};
}

Change color(Ui& ui, const Field& field, Vec3& linear, std::optional<Vec3> usual) {
    Field whole = field;
    whole.differs = usual && *usual != linear;
    if (usual) whole.usual = hex_of(*usual);
    if (whole.range.empty()) whole.range = "sRGB, as #rrggbb";
    const Row row = begin_row(ui, whole);
    const Theme& theme = ui.theme();
    if (row.reset && usual) {
        linear = *usual;
        return Change::finished;
    }
    const float wide = std::floor(1.6f * row.control.GetHeight());
    const ImRect swatch(row.control.Min, ImVec2(row.control.Min.x + wide, row.control.Max.y));
    const Item item = ui.place_at(field.name, swatch, hex_of(linear));
    const ImGuiIO& io = ImGui::GetIO();
    const std::string list = Ui::label_of(std::string(field.name) + ".picker");
    const bool clicked = item.hovered && io.MouseClicked[0];
    if (clicked && io.MouseClickedCount[0] == 2 && whole.differs) {
        linear = *usual;
        return Change::finished;
    }
    const bool opens_picker = clicked || (item.focused && (ui.pressed(Key::space) || ui.pressed(Key::enter)));
    if (opens_picker) ui.redraw();
    if (item.visible) {
        ImDrawList* draw = ImGui::GetWindowDrawList();
        const ImVec4 shown(encoded(linear.x), encoded(linear.y), encoded(linear.z), 1);
        draw->AddRectFilled(swatch.Min, swatch.Max, theme.color(shown), ImGui::GetStyle().FrameRounding);
        draw->AddRect(swatch.Min, swatch.Max, theme.color(theme.colors.line), ImGui::GetStyle().FrameRounding, 0,
                      theme.px(1));
    }
    ui.draw_focus(item);
    field_tooltip(ui, item, whole);
    ImGui::SetNextWindowPos(ImVec2(swatch.Min.x, swatch.Max.y + theme.px(3)), ImGuiCond_Appearing);
    Change change = Change::none;
    {
        const Ui::Scope scope(ui, field.name);
        if (opens_picker) ImGui::OpenPopup(list.c_str());
        change = pick(ui, list.c_str(), linear);
    }
    // The value as text beside the swatch.
    const std::string name = std::string(field.name) + ".hex";
    const ImRect box(ImVec2(swatch.Max.x + theme.px(4), row.control.Min.y), row.control.Max);
    const Item typed_item = ui.place_at(name, box, hex_of(linear));
    if (is_typing(ui, typed_item)) {
        const Typed typed = type_into(ui, typed_item, name, box);
        const auto parsed = color_of(typed.text);
        if (!typed.done || !parsed || hex_of(*parsed) == hex_of(linear)) return change;
        linear = *parsed;
        return Change::finished;
    }
    const bool opens = (typed_item.hovered && io.MouseClicked[0]) || ui.takes_typing(typed_item) ||
                       (typed_item.focused && (ui.pressed(Key::enter) || ui.pressed(Key::f2)));
    if (opens) {
        begin_typing(ui, typed_item, hex_of(linear));
        (void)type_into(ui, typed_item, name, box);
        return change;
    }
    if (typed_item.visible) {
        draw_field(ui, typed_item, false);
        const ImRect inner(box.Min + ImVec2(theme.px(6), 0), box.Max);
        clipped_text(inner, hex_of(linear), ImGui::GetColorU32(ImGuiCol_Text));
    }
    ui.draw_focus(typed_item);
    field_tooltip(ui, typed_item, whole);
    return change;
}

}  // namespace weft::editor
