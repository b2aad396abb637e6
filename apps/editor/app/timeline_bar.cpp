#include "editor/app/timeline_bar.h"

#include "editor/ui/expression.h"
#include "editor/ui/widgets/field.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace weft::editor {
namespace {

/// A round number of frames between ticks that are at least so many pixels apart.
std::uint64_t tick_step(double frames_per_pixel, double least_pixels) {
    std::uint64_t step = 1;
    for (const std::uint64_t factor : {1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000, 100000, 1000000}) {
        step = factor;
        if (static_cast<double>(factor) >= frames_per_pixel * least_pixels) break;
    }
    return step;
}

bool contains(const std::vector<FrameRange>& ranges, std::uint64_t frame) {
    return std::ranges::any_of(ranges, [&](FrameRange r) { return r.first <= frame && frame <= r.last; });
}

/// The recorded frame nearest to the wanted one.
std::uint64_t nearest_recorded(const Published& now, std::uint64_t wanted) {
    std::uint64_t best = now.frame, distance = ~std::uint64_t{0};
    for (const auto* ranges : {&now.valid, &now.stale}) {
        for (const FrameRange range : *ranges) {
            const std::uint64_t frame = std::clamp(wanted, range.first, range.last);
            const std::uint64_t far = frame > wanted ? frame - wanted : wanted - frame;
            if (far < distance) best = frame, distance = far;
        }
    }
    return best;
}

}  // namespace

float timeline_height(const Ui& ui) {
    return ui.theme().px(46);
}

void show_timeline(Ui& ui, Session& session) {
    const Theme& theme = ui.theme();
    const Published& now = session.now();
    const std::uint64_t last = std::max<std::uint64_t>({now.last_recorded, now.frame, 60});
    const float width = ImGui::GetContentRegionAvail().x, height = theme.px(30);
    const Item item = ui.place("track", ImVec2(width, height), std::to_string(now.frame));
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float pad = theme.px(8);
    const float left = item.box.Min.x + pad, right = item.box.Max.x - pad;
    const auto x_of = [&](double frame) {
        return left + static_cast<float>(frame / static_cast<double>(last)) * (right - left);
    };
    const float top = item.box.Min.y + theme.px(4), bottom = item.box.Max.y - theme.px(12);
    draw.AddRectFilled(ImVec2(left, top), ImVec2(right, bottom), theme.color(theme.colors.field), theme.px(2));
    for (const FrameRange range : now.valid)
        draw.AddRectFilled(ImVec2(x_of(static_cast<double>(range.first)), top),
                           ImVec2(x_of(static_cast<double>(range.last)) + 1, bottom), theme.color(theme.colors.fill));
    // Hatched, so that they are not told by color alone.
    for (const FrameRange range : now.stale) {
        const float from = x_of(static_cast<double>(range.first)), to = x_of(static_cast<double>(range.last)) + 1;
        draw.PushClipRect(ImVec2(from, top), ImVec2(to, bottom), true);
        for (float x = from - (bottom - top); x < to; x += theme.px(6))
            draw.AddLine(ImVec2(x, bottom), ImVec2(x + (bottom - top), top), theme.color(theme.colors.line));
        draw.PopClipRect();
    }
    const double frames_per_pixel = static_cast<double>(last) / std::max(1.0f, right - left);
    const std::uint64_t step = tick_step(frames_per_pixel, theme.px(60));
    ImGui::PushFont(theme.small);
    for (std::uint64_t frame = 0; frame <= last; frame += step) {
        const float x = x_of(static_cast<double>(frame));
        draw.AddLine(ImVec2(x, bottom), ImVec2(x, bottom + theme.px(3)), theme.color(theme.colors.muted));
        const std::string label = std::to_string(frame);
        const float wide = ImGui::CalcTextSize(label.c_str()).x;
        draw.AddText(ImVec2(std::clamp(x - wide / 2, item.box.Min.x, item.box.Max.x - wide), bottom + theme.px(2)),
                     theme.color(theme.colors.muted), label.c_str());
    }
    ImGui::PopFont();
    const float x = x_of(static_cast<double>(now.frame));
    draw.AddLine(ImVec2(x, item.box.Min.y), ImVec2(x, bottom), theme.color(theme.colors.accent), theme.px(2));
    draw.AddTriangleFilled(ImVec2(x - theme.px(5), item.box.Min.y), ImVec2(x + theme.px(5), item.box.Min.y),
                           ImVec2(x, item.box.Min.y + theme.px(7)), theme.color(theme.colors.accent));
    ui.draw_focus(item);

    // Scrubbing.
    bool hovered = false, held = false;
    const bool was_held = ImGui::GetActiveID() == item.id;
    ImGui::ButtonBehavior(item.box, item.id, &hovered, &held, ImGuiButtonFlags_PressedOnClick);
    if (held || was_held) GImGui->NavDisableHighlight = false;  // after a click keys go here
    if (held) {
        const float fraction =
            std::clamp((ImGui::GetIO().MousePos.x - left) / std::max(1.0f, right - left), 0.0f, 1.0f);
        const auto wanted = static_cast<std::uint64_t>(std::lround(fraction * static_cast<float>(last)));
        const std::uint64_t frame = nearest_recorded(now, wanted);
        static std::uint64_t asked = ~std::uint64_t{0};
        if (now.playing) session.simulator().play(false);
        if (frame != now.frame && frame != asked) session.post(Seek{frame});
        asked = frame;
    }
    if (item.focused) {
        const auto go = [&](std::uint64_t frame) {
            if (contains(now.valid, frame) || contains(now.stale, frame)) session.post(Seek{frame});
        };
        if (ui.pressed(Key::left, true) && now.frame > 0) go(now.frame - 1);
        if (ui.pressed(Key::right, true)) go(now.frame + 1);
        if (ui.pressed(Key::home)) go(0);
        if (ui.pressed(Key::end)) go(now.last_recorded);
        ui.keep_arrows(item);
    }
    ui.tooltip(item, [&] {
        ImGui::TextUnformatted("Recorded frames. Drag to show one; play continues from there.");
        const double megabytes = static_cast<double>(now.memory_bytes) / 1e6;
        muted_text(ui, format_number(megabytes, 3) + " MB in memory, " +
                           format_number(static_cast<double>(now.disk_bytes) / 1e6, 3) +
                           " MB on disk. Hatched: from before a change.");
    });
}

}  // namespace weft::editor
