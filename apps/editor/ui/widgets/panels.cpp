#include "editor/ui/widgets/panels.h"

#include "editor/ui/expression.h"
#include "editor/ui/widgets/field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace weft::editor {

float splitter_width(const Ui& ui) {
    return ui.theme().px(6);
}

bool splitter(Ui& ui, std::string_view name, SplitAxis axis, float length, float& size, float least, float most,
              bool after) {
    const Theme& theme = ui.theme();
    const bool x = axis == SplitAxis::x;
    const float thick = splitter_width(ui), before = size;
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const ImRect box(from, from + (x ? ImVec2(thick, length) : ImVec2(length, thick)));
    ImGui::ItemSize(box);  // without a line of text, which would make the row higher
    const Item item = ui.place_at(name, box, format_number(static_cast<double>(size)));
    const ImGuiIO& io = ImGui::GetIO();
    if (item.hovered && io.MouseClicked[0]) {
        ImGui::SetActiveID(item.id, ImGui::GetCurrentWindow());
        ui.gesture = {};
        ui.gesture.id = item.id;
        ui.gesture.start = static_cast<double>(size);
        ui.gesture.pointer = static_cast<double>(x ? io.MousePos.x : io.MousePos.y);
    }
    const bool active = ImGui::GetActiveID() == item.id && ui.gesture.id == item.id;
    if (active || item.hovered) ImGui::SetMouseCursor(x ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
    const float sign = after ? -1.0f : 1.0f;
    if (active) {
        const float by = (x ? io.MousePos.x : io.MousePos.y) - static_cast<float>(ui.gesture.pointer);
        size = static_cast<float>(ui.gesture.start) + sign * by / theme.scale;
        if (!io.MouseDown[0]) {
            ImGui::ClearActiveID();
            ui.gesture = {};
        }
    }
    if (item.focused) {
        ui.keep_arrows(item);
        const Key less = x ? Key::left : Key::up, more = x ? Key::right : Key::down;
        const int steps = static_cast<int>(ui.pressed(more, true)) - static_cast<int>(ui.pressed(less, true));
        size += sign * 16 * static_cast<float>(steps);
        if (!x && GImGui->NavMoveSubmitted) ImGui::NavMoveRequestCancel();
    }
    size = std::clamp(size, least, std::max(least, most));
    const Palette& colors = theme.colors;
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled(item.box.Min, item.box.Max,
                        theme.color(active || item.hovered ? colors.field_active : colors.background));
    // Three dots in the middle.
    for (const float step : {-1.0f, 0.0f, 1.0f}) {
        const ImVec2 middle = item.box.GetCenter();
        const float away = step * theme.px(6);
        list->AddCircleFilled(middle + (x ? ImVec2(0, away) : ImVec2(away, 0)), theme.px(1.5f),
                              theme.color(colors.line), 8);
    }
    ui.draw_focus(item);
    if (size != before) ui.redraw();
    return size != before;
}

namespace {

struct Extent {
    float low = std::numeric_limits<float>::infinity(), high = -std::numeric_limits<float>::infinity();
};

Extent extent_of(std::span<const float> values) {
    Extent extent;
    for (const float value : values) {
        if (!std::isfinite(value)) continue;
        extent.low = std::min(extent.low, value);
        extent.high = std::max(extent.high, value);
    }
    return extent;
}

// One stretch of the line at a time, between gaps.
void draw_line(std::span<const float> values, const ImRect& box, const Extent& shown, ImU32 color, float width) {
    std::vector<ImVec2> points;
    ImDrawList* list = ImGui::GetWindowDrawList();
    const auto flush = [&] {
        if (points.size() > 1) list->AddPolyline(points.data(), static_cast<int>(points.size()), color, 0, width);
        points.clear();
    };
    const float count = static_cast<float>(std::max<std::size_t>(2, values.size()) - 1);
    const float range = shown.high - shown.low;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::isfinite(values[i])) {
            flush();
            continue;
        }
        const float x = box.Min.x + box.GetWidth() * static_cast<float>(i) / count;
        points.push_back(ImVec2(x, box.Max.y - box.GetHeight() * (values[i] - shown.low) / range));
    }
    flush();
}

}  // namespace

void plot(Ui& ui, std::string_view name, std::span<const float> values, const PlotStyle& style) {
    const Theme& theme = ui.theme();
    const Palette& colors = theme.colors;
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const float line = theme.body->FontSize + theme.px(2);
    const ImRect whole(from, from + ImVec2(ImGui::GetContentRegionAvail().x, line + theme.px(style.height)));
    ImGui::ItemSize(whole, 0);
    const Extent extent = extent_of(values);
    const bool any = extent.low <= extent.high;
    const double last = values.empty() ? 0 : static_cast<double>(values.back());
    const std::string now = !values.empty() && std::isfinite(last) ? format_number(last, style.unit, 3) : "–";
    const Item item = ui.place_at(name, whole, now, false);
    if (!item.visible) return;
    const ImRect head(whole.Min, ImVec2(whole.Max.x, whole.Min.y + line));
    const float wide = ImGui::CalcTextSize(now.c_str()).x;
    clipped_text(ImRect(head.Min, head.Max - ImVec2(wide + theme.px(6), 0)), style.label, theme.color(colors.muted));
    clipped_text(head, now, theme.color(colors.text), 1);
    const ImRect field(ImVec2(whole.Min.x, head.Max.y), whole.Max);
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled(field.Min, field.Max, theme.color(colors.field), ImGui::GetStyle().FrameRounding);
    if (!any) return;
    Extent shown = extent;
    if (style.from_zero) shown = {std::min(0.0f, shown.low), std::max(0.0f, shown.high)};
    if (shown.high - shown.low < 1e-12f) shown.high = shown.low + 1;
    const float padding = theme.px(4);
    ImRect inner(field.Min + ImVec2(padding, padding), field.Max - ImVec2(padding, padding));
    // The extremes, in small letters at the left.
    ImGui::PushFont(theme.small);
    const std::string high = format_number(static_cast<double>(shown.high), 3),
                      low = format_number(static_cast<double>(shown.low), 3);
    const float scale = std::max(ImGui::CalcTextSize(high.c_str()).x, ImGui::CalcTextSize(low.c_str()).x);
    const ImRect numbers(inner.Min, ImVec2(inner.Min.x + scale, inner.Max.y));
    const float small = ImGui::GetFontSize();
    clipped_text(ImRect(numbers.Min, ImVec2(numbers.Max.x, numbers.Min.y + small)), high, theme.color(colors.muted), 1);
    clipped_text(ImRect(ImVec2(numbers.Min.x, numbers.Max.y - small), numbers.Max), low, theme.color(colors.muted), 1);
    ImGui::PopFont();
    inner.Min.x += scale + padding;
    ImGui::PushClipRect(field.Min, field.Max, true);  // corners of steep lines reach further than their points
    draw_line(values, inner, shown, theme.color(colors.accent_text), theme.px(1.5f));
    ImGui::PopClipRect();
    // The value under the pointer.
    if (!item.hovered || values.size() < 2) return;
    const float share =
        std::clamp((ImGui::GetIO().MousePos.x - inner.Min.x) / std::max(1.0f, inner.GetWidth()), 0.0f, 1.0f);
    const auto index = static_cast<std::size_t>(std::lround(share * static_cast<float>(values.size() - 1)));
    const float x =
        std::floor(inner.Min.x + inner.GetWidth() * static_cast<float>(index) / static_cast<float>(values.size() - 1));
    list->AddLine(ImVec2(x, field.Min.y), ImVec2(x, field.Max.y), theme.color(colors.line), theme.px(1));
    if (!std::isfinite(values[index])) return;
    ImGui::BeginTooltip();
    ImGui::TextUnformatted(format_number(static_cast<double>(values[index]), style.unit, 4).c_str());
    if (style.seconds > 0) {
        const double ago = style.seconds * (1 - static_cast<double>(index) / static_cast<double>(values.size() - 1));
        muted_text(ui, format_number(ago, 2) + " s ago");
    }
    ImGui::EndTooltip();
}

}  // namespace weft::editor
