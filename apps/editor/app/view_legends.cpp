#include "editor/app/view_legends.h"

#include <algorithm>
#include <string>

namespace weft::editor {
namespace {

constexpr ImU32 ink = IM_COL32(245, 245, 245, 255), backdrop = IM_COL32(15, 18, 23, 170);
constexpr int strips = 48;
// At 100 %.
constexpr float bar_length = 190, bar_height = 11, tick = 4, between_legends = 8;

ImU32 color_of_entry(const Vec4& c) {
    return ImGui::ColorConvertFloat4ToU32(ImVec4(c.x, c.y, c.z, c.w));
}

class LegendPage {
  public:
    explicit LegendPage(Ui& ui) : theme_(ui.theme()), draw_(*ImGui::GetWindowDrawList()) {}

    ImVec2 size_of(const Legend& legend) const {
        const float line = ImGui::GetTextLineHeightWithSpacing();
        ImVec2 size(width_of(legend.title), line * static_cast<float>(1 + legend.entries.size()));
        for (const Legend::Entry& entry : legend.entries)
            size.x = std::max(size.x, width_of(entry.text) + (entry.color ? line : 0));
        if (!legend.bar) return size;
        size.x = std::max(size.x, theme_.px(bar_length) + 2 * overhang(*legend.bar));
        size.y += theme_.px(bar_height + tick) + line;
        return size;
    }

    void write(const Legend& legend, ImVec2 at) {
        const float line = ImGui::GetTextLineHeightWithSpacing();
        text(at, legend.title);
        at.y += line;
        if (legend.bar) at.y += bar(*legend.bar, at);
        for (const Legend::Entry& entry : legend.entries) {
            const float side = ImGui::GetTextLineHeight(), inset = theme_.px(2);
            if (entry.color)
                draw_.AddRectFilled(at + ImVec2(inset, inset), at + ImVec2(side - inset, side - inset),
                                    color_of_entry(*entry.color), theme_.px(2));
            text(ImVec2(at.x + (entry.color ? line : 0), at.y), entry.text);
            at.y += line;
        }
    }

  private:
    static float width_of(const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; }
    void text(ImVec2 at, const std::string& letters) { draw_.AddText(at, ink, letters.c_str()); }
    // How far numbers extend beyond the ends of the bar.
    float overhang(const Legend::Bar& bar) const {
        float widest = 0;
        for (const std::string& number : tick_texts(bar)) widest = std::max(widest, width_of(number));
        return widest / 2;
    }
    // Returns its height.
    float bar(const Legend::Bar& bar, ImVec2 at) {
        const float length = theme_.px(bar_length), height = theme_.px(bar_height), line = theme_.px(1);
        const ImVec2 begin(at.x + overhang(bar), at.y);
        for (int i = 0; i < strips; ++i) {
            const float from = static_cast<float>(i) / strips, to = static_cast<float>(i + 1) / strips;
            const ImU32 left = color_of_entry(color_of(bar.scale, from)),
                        right = color_of_entry(color_of(bar.scale, to));
            draw_.AddRectFilledMultiColor(ImVec2(begin.x + from * length, begin.y),
                                          ImVec2(begin.x + to * length, begin.y + height), left, right, right, left);
        }
        std::vector<std::string> numbers = tick_texts(bar);
        if (2 * overhang(bar) + theme_.px(6) > length / 4) numbers = tick_texts(bar, 3);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const float x = begin.x + length * static_cast<float>(i) / static_cast<float>(numbers.size() - 1);
            draw_.AddRectFilled(ImVec2(x - line / 2, begin.y + height),
                                ImVec2(x + line / 2, begin.y + height + theme_.px(tick)), ink);
            text(ImVec2(x - width_of(numbers[i]) / 2, begin.y + height + theme_.px(tick)), numbers[i]);
        }
        return height + theme_.px(tick) + ImGui::GetTextLineHeightWithSpacing();
    }

    const Theme& theme_;
    ImDrawList& draw_;
};

}  // namespace

void show_legends(Ui& ui, const ImRect& view, std::span<const Legend> legends) {
    const Theme& theme = ui.theme();
    const float margin = theme.px(10), padding = theme.px(8);
    LegendPage page(ui);
    ImVec2 size(0, 0);
    std::size_t shown = 0;
    for (; shown < legends.size(); ++shown) {
        const ImVec2 more = page.size_of(legends[shown]);
        const float high = size.y + more.y + (shown > 0 ? theme.px(between_legends) : 0);
        if (high + 2 * (margin + padding) > view.GetHeight()) break;
        size = ImVec2(std::max(size.x, more.x), high);
    }
    if (shown == 0) return;
    ImVec2 at(view.Min.x + margin + padding, view.Max.y - margin - padding - size.y);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 pad(padding, padding);
    draw.PushClipRect(view.Min, view.Max, true);
    draw.AddRectFilled(at - pad, at + size + pad, backdrop, theme.px(5));
    for (const Legend& legend : legends.first(shown)) {
        page.write(legend, at);
        at.y += page.size_of(legend).y + theme.px(between_legends);
    }
    draw.PopClipRect();
    ui.note("legends",
            ImRect(view.Min.x + margin, view.Max.y - margin - 2 * padding - size.y,
                   view.Min.x + margin + 2 * padding + size.x, view.Max.y - margin),
            legends.front().title);
}

}  // namespace weft::editor
