// Toolbar, menus, status line and what lies over the view.
#include "editor/app/editor.h"
#include "editor/app/objects.h"
#include "editor/ui/expression.h"
#include "editor/ui/widgets/controls.h"
#include "editor/ui/widgets/field.h"
#include "editor/ui/widgets/panels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

namespace weft::editor {
namespace {

/// Substeps that leave a thousandth unsolved: the rest falls with their square.
std::uint32_t substeps_for(const Published& now) {
    constexpr double good = 1e-3;
    const double factor = std::sqrt(std::max(now.mean_residual, good) / good);
    return static_cast<std::uint32_t>(std::ceil(now.document->scene.solver.substeps * factor));
}

std::string milliseconds(double ms) {
    return format_number(ms, ms < 1 ? 2 : 3) + " ms";
}

}  // namespace

std::string shortcut_text(const Command& command) {
    if (command.key == Key::none) return {};
    std::string text;
    if (command.modifiers.control) text += "Ctrl+";
    if (command.modifiers.shift) text += "Shift+";
    const auto key = static_cast<int>(command.key);
    if (command.key >= Key::a && command.key <= Key::z)
        return text + static_cast<char>('A' + key - static_cast<int>(Key::a));
    if (command.key >= Key::digit_0 && command.key <= Key::digit_9)
        return text + static_cast<char>('0' + key - static_cast<int>(Key::digit_0));
    if (command.key >= Key::f1 && command.key <= Key::f12)
        return text + "F" + std::to_string(key - static_cast<int>(Key::f1) + 1);
    if (command.key >= Key::pad_0 && command.key <= Key::pad_9)
        return text + "Keypad " + std::to_string(key - static_cast<int>(Key::pad_0));
    switch (command.key) {
        case Key::space:
            return text + "Space";
        case Key::period:
            return text + ".";
        case Key::comma:
            return text + ",";
        case Key::delete_key:
            return text + "Del";
        case Key::home:
            return text + "Home";
        case Key::enter:
            return text + "Enter";
        case Key::left_bracket:
            return text + "[";
        case Key::right_bracket:
            return text + "]";
        case Key::equal:
            return text + "=";
        case Key::minus:
            return text + "-";
        default:
            return text;
    }
}

// A button that opens a list of commands below it.
void Editor::menu(Ui& ui, const char* name, const char* label, std::initializer_list<const char*> names) {
    const ImVec2 below(ImGui::GetCursorScreenPos().x, ImGui::GetCursorScreenPos().y + ImGui::GetFrameHeight());
    if (button(ui, name, {.text = label, .flat = true})) ImGui::OpenPopup(name);
    ImGui::SetNextWindowPos(below);
    const Theme& theme = ui.theme();
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(theme.px(6), theme.px(6)));
    if (ImGui::BeginPopup(name)) {
        menu_entries(ui, name, names);
        ImGui::EndPopup();
    }
    ImGui::PopStyleVar();
    ImGui::SameLine();
}

void Editor::menu_entries(Ui& ui, const char* name, std::initializer_list<const char*> names) {
    const Theme& theme = ui.theme();
    const Ui::Scope scope(ui, name);
    // Labels and keys stand apart.
    float width = theme.px(300);
    const auto wide_as = [](std::string_view text) {
        return ImGui::CalcTextSize(text.data(), text.data() + text.size()).x;
    };
    for (const char* one : names)
        if (*one)
            width =
                std::max(width, wide_as(command(one)->label) + wide_as(shortcut_text(*command(one))) + theme.px(70));
    for (const char* one : names) {
        if (!*one) {
            ImGui::Separator();
            continue;
        }
        const Command& known = *command(one);
        const std::string keys = shortcut_text(known);
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        const bool pressed = button(ui, known.name,
                                    {.icon = known.icon,
                                     .text = known.label,
                                     .what = known.what,
                                     .flat = true,
                                     .left = true,
                                     .enabled = !known.enabled || known.enabled(),
                                     .width = width});
        const float wide = ImGui::CalcTextSize(keys.c_str()).x;
        ImGui::GetWindowDrawList()->AddText(ImVec2(corner.x + width - wide - theme.px(8), corner.y + theme.px(5)),
                                            theme.color(theme.colors.muted), keys.c_str());
        if (!pressed) continue;
        ImGui::CloseCurrentPopup();
        run_command(known);
    }
    if (std::string_view(name) != "overlays") return;
    for (const Overlay& overlay : weft::overlays()) {
        const bool on = std::ranges::find(overlays_, &overlay) != overlays_.end();
        std::string label(overlay.name);
        std::ranges::replace(label, '_', ' ');
        if (button(ui, overlay.name,
                   {.icon = on ? Icon::check : Icon::overlay,
                    .text = label,
                    .what = overlay.what,
                    .chosen = on,
                    .flat = true,
                    .left = true,
                    .width = width}))
            toggle_overlay(&overlay);
    }
}

void Editor::toolbar(Ui& ui) {
    const Theme& theme = ui.theme();
    ImGui::PushStyleColor(ImGuiCol_ChildBg, theme.colors.header);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(theme.px(8), theme.px(5)));
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(theme.px(4), theme.px(4)));
    ImGui::BeginChild("toolbar", ImVec2(ui.size().x, ImGui::GetFrameHeight() + theme.px(10)), false,
                      ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar |
                          ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_HorizontalScrollbar);
    {
        const Ui::Scope scope(ui, "toolbar");
        if (narrow(ui)) pages(ui);
        menu(ui, "file", "File",
             {"new", "open", "import", "gallery", "recover", "", "save", "save_as", "", "export", "screenshot", "",
              "quit"});
        menu(ui, "edit", "Edit",
             {"undo", "redo", "history", "", "duplicate", "rename", "delete", "", "pin", "unpin", "key", "",
              "preferences"});
        menu(ui, "select_menu", "Select", {"all", "none", "invert", "", "grow", "shrink", "boundary", "", "through"});
        menu(ui, "view_menu", "View",
             {"frame", "frame_all", "", "from_front", "from_back", "from_left", "from_right", "from_top", "from_bottom",
              "", "go_to_camera", "use_camera", "", "axes", "amount"});
        menu(ui, "overlays", "Overlays", {});
        menu(ui, "help_menu", "Help", {"help"});
        ImGui::SameLine(0, theme.px(14));
        const bool playing = session_->now().playing;
        if (button(ui, "play",
                   {.icon = playing ? Icon::pause : Icon::play,
                    .text = playing ? "Pause" : "Play",
                    .what = playing ? "Hold the simulation" : "Run the simulation",
                    .shortcut = "Space",
                    .primary = true,
                    .width = theme.px(92)}))
            toggle_play();
        float gap = theme.px(14);
        for (const char* name : {"step", "reset", "", "undo", "redo", "", "hand", "select", "move", "turn", "scale",
                                 "cut", "lasso", "brush", "anchors"}) {
            if (!*name) {
                gap = theme.px(14);
                continue;
            }
            ImGui::SameLine(0, std::exchange(gap, theme.px(4)));
            const Command& one = *command(name);
            const bool chosen = name_of(view_.settings.tool) == one.name;
            const std::string keys = shortcut_text(one);
            if (button(ui, one.name,
                       {.icon = one.icon,
                        .what = one.what,
                        .shortcut = keys,
                        .chosen = chosen,
                        .flat = true,
                        .enabled = !one.enabled || one.enabled()}))
                run_command(one);
        }
    }
    scroll_toolbar(ui);
    ImGui::EndChild();
    ImGui::PopStyleVar(2);
    ImGui::PopStyleColor();
}

// Too narrow for the panels side by side: one of them is shown.
bool Editor::narrow(const Ui& ui) const {
    return ui.size().x < ui.theme().px(560);
}

void Editor::pages(Ui& ui) {
    struct Choice {
        Page page;
        const char *name, *what;
        Icon icon;
    };
    for (const Choice& one :
         {Choice{Page::view, "page_view", "Show the view", Icon::eye},
          {Page::objects, "page_objects", "Show the list of objects", Icon::menu},
          {Page::properties, "page_properties", "Show the selected object's values", Icon::settings}}) {
        if (button(ui, one.name, {.icon = one.icon, .what = one.what, .chosen = page_ == one.page, .flat = true}))
            page_ = one.page;
        ImGui::SameLine();
    }
}

// What does not fit is reached by the wheel; an arrow at the end shows that there is more.
void Editor::scroll_toolbar(Ui& ui) {
    const float most = ImGui::GetScrollMaxX(), wheel = ImGui::GetIO().MouseWheel;
    if (most <= 0) return;
    if (ImGui::IsWindowHovered() && wheel != 0)
        ImGui::SetScrollX(std::clamp(ImGui::GetScrollX() - wheel * ui.theme().px(80), 0.0f, most));
    const Theme& theme = ui.theme();
    const ImVec2 corner = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    const auto arrow = [&](float x, Icon icon) {
        const ImRect box(ImVec2(x, corner.y), ImVec2(x + theme.icon_side + theme.px(4), corner.y + size.y));
        ImGui::GetWindowDrawList()->AddRectFilled(box.Min, box.Max, theme.color(theme.colors.header));
        draw_icon(theme, icon, box, theme.color(theme.colors.muted));
    };
    if (ImGui::GetScrollX() < most - 1) arrow(corner.x + size.x - theme.icon_side - theme.px(4), Icon::right);
    if (ImGui::GetScrollX() > 1) arrow(corner.x, Icon::left);
}

// Lines over the upper left corner of the view: messages, hints.
void Editor::view_overlay(Ui& ui) {
    const Theme& theme = ui.theme();
    const float width = std::min(ImGui::GetContentRegionAvail().x - theme.px(10), theme.px(520));
    if (width < theme.px(80)) return;
    ImGui::BeginGroup();
    ImGui::PushItemWidth(width);
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
    if (!session_->messages().empty() || opening_.valid() || export_) {
        // A plate behind them, as they lie on the image.
        ImDrawList& draw = *ImGui::GetWindowDrawList();
        ImDrawListSplitter layers;
        layers.Split(&draw, 2);
        layers.SetCurrentChannel(&draw, 1);
        ImGui::BeginGroup();
        messages(ui);
        ImGui::EndGroup();
        layers.SetCurrentChannel(&draw, 0);
        const ImVec2 pad(theme.px(6), theme.px(4));
        ImVec4 plate = theme.colors.panel;
        plate.w = 0.92f;
        draw.AddRectFilled(ImGui::GetItemRectMin() - pad, ImGui::GetItemRectMax() + pad, theme.color(plate),
                           theme.px(6));
        layers.Merge(&draw);
    }
    hints(ui);
    ImGui::PopTextWrapPos();
    ImGui::PopItemWidth();
    ImGui::EndGroup();
}

void Editor::messages(Ui& ui) {
    const Ui::Scope scope(ui, "messages");
    std::vector<Message>& all = session_->messages();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Message& message = all[i];
        // Notes go by themselves, errors stay until they are closed.
        constexpr double note_time = 6;  // s
        if (!message.is_error) {
            const double left = message.since + note_time - ui.now();
            if (left <= 0) {
                all.erase(all.begin() + static_cast<std::ptrdiff_t>(i--));
                continue;
            }
            ui.redraw_in(left);
        }
        const Ui::Scope one(ui, std::to_string(i));
        std::string text = message.title.empty() ? "" : message.title + ": ";
        for (const std::string& line : message.lines) text += (&line == &message.lines.front() ? "" : "\n") + line;
        if (button(ui, "close", {.icon = Icon::cross, .what = "Close this message", .flat = true})) {
            all.erase(all.begin() + static_cast<std::ptrdiff_t>(i));
            return;
        }
        ImGui::SameLine();
        note(ui, "text", message.is_error ? Note::error : Note::info, text);
    }
    if (opening_.valid()) note(ui, "opening", Note::info, "Opening …");
    if (!export_) return;
    export_->update();
    const std::string name = export_->file().filename().string();
    if (export_->running()) {
        ui.redraw_in(0.2);
        if (progress(ui, "export", export_->done(), "Exporting " + name)) export_->cancel();
    } else {
        const std::string problem = export_->problem(), file = export_->file().string();
        export_.reset();
        if (problem == "canceled")
            session_->say("The export of " + name + " was canceled");
        else if (problem.empty())
            session_->say("Exported " + file);
        else
            session_->say("Export of " + name, {Error{"", problem}});
    }
}

// One line, which loses each hint once it is done.
void Editor::hints(Ui& ui) {
    constexpr std::pair<const char*, const char*> all[] = {{"pull", "Drag the cloth to pull it"},
                                                           {"space", "Space pauses"},
                                                           {"drop", "Drop a mesh or a scene on the window"},
                                                           {"help", "H shows keys and mouse"}};
    // As many as fit.
    const float room = view_.size().x - ui.theme().px(30);
    std::string line;
    for (const auto& [hint, text] : all) {
        if (std::string_view(hint) == "pull" && view_.settings.tool != Tool::hand) continue;
        const std::string longer = line + (line.empty() ? "" : "  ·  ") + text;
        if (!settings_.hints_done.contains(hint) && ImGui::CalcTextSize(longer.c_str()).x < room) line = longer;
    }
    const auto* picture = static_cast<const Picture*>(session_->now().picture.get());
    if (picture && !picture->pulls.empty()) did("pull");
    if (line.empty()) return;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 size = ImGui::CalcTextSize(line.c_str());
    const float pad = ui.theme().px(6);
    ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(at.x - pad, at.y - pad / 2),
                                              ImVec2(at.x + size.x + pad, at.y + size.y + pad / 2),
                                              IM_COL32(20, 22, 26, 170), pad);
    ImGui::GetWindowDrawList()->AddText(at, IM_COL32(240, 240, 240, 255), line.c_str());
    ui.note("hints", ImRect(at, ImVec2(at.x + size.x, at.y + size.y)), line);
    ImGui::Dummy(size);
}

void Editor::status_line(Ui& ui) {
    const Theme& theme = ui.theme();
    ImGui::PushStyleColor(ImGuiCol_ChildBg, theme.colors.header);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(theme.px(10), theme.px(5)));
    ImGui::BeginChild("status", ImVec2(ui.size().x, theme.px(26)), false,
                      ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar);
    status_texts(ui);
    ImGui::EndChild();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
}

void Editor::status_texts(Ui& ui) {
    const Theme& theme = ui.theme();
    const Published& now = session_->now();
    const Ui::Scope scope(ui, "status");
    std::array<char, 64> time{};
    std::snprintf(time.data(), time.size(), "%.2f s", now.time);
    std::string text =
        "Frame " + std::to_string(now.frame) + " (" + time.data() + ")   Step " + milliseconds(now.step_ms);
    if (now.playing) text += "   " + format_number(now.real_time_factor, 2) + " × real time";
    if (now.particles > 0) {
        text += "   Stretch " + format_number(100 * now.mean_stretch, 2) + " %, unsolved " +
                format_number(100 * now.mean_residual, 2) + " %";
    }
    text += "   " + std::to_string(now.particles) + " particles   " + now.backend;
    if (now.threads > 1) text += ", " + std::to_string(now.threads) + " threads";
    if (view_image_)
        text += "   View " + milliseconds(view_image_->ms) + " at " + std::to_string(view_image_->percent) + " %";
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::PushStyleColor(ImGuiCol_Text, theme.colors.muted);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
    const ImRect box(at, ImVec2(at.x + ImGui::GetItemRectSize().x, at.y + ImGui::GetItemRectSize().y));
    ui.note("text", box, text);
    ui.note("frame", box, std::to_string(now.frame));
    ui.note("images", box, std::to_string(view_thread_->count()));
    ui.note("step_ms", box, std::to_string(now.step_ms));
    ui.note("acknowledged", box, std::to_string(now.acknowledged));
    ui.note("posted", box, std::to_string(session_->posted()));
    if (ImGui::IsItemHovered()) {
        ImGui::BeginTooltip();
        if (const auto cure = substeps_for(now); cure > now.document->scene.solver.substeps)
            ImGui::Text("About %u substeps leave 0.1 %% of the stretch unsolved.", cure);
        for (std::size_t i = 0; i < now.stage_ms.size(); ++i)
            if (now.stage_ms[i] > 0) {
                ImGui::TextUnformatted(std::string(stage_name(static_cast<std::uint32_t>(i))).c_str());
                ImGui::SameLine(theme.px(110));
                ImGui::Text("%.3f ms", now.stage_ms[i]);
            }
        ImGui::EndTooltip();
    }
    for (const std::string_view report : now.reports) {
        ImGui::SameLine(0, theme.px(14));
        ImGui::PushStyleColor(ImGuiCol_Text, theme.colors.warning);
        ImGui::TextUnformatted((text_of(Icon::warning) + " " + std::string(report)).c_str());
        ImGui::PopStyleColor();
    }
}

void Editor::history(Ui& ui) {
    const Ui::Scope scope(ui, "history");
    const Published& now = session_->now();
    ImGui::PushFont(ui.theme().strong);
    ImGui::TextUnformatted("History");
    ImGui::PopFont();
    const float width = ImGui::GetContentRegionAvail().x;
    for (std::size_t i = 0; i < now.done.size(); ++i) {
        const StepLabel& step = now.done[i];
        const Ui::Scope one(ui, std::to_string(i));
        if (button(ui, "undo_setting",
                   {.icon = Icon::undo, .what = "Take back this setting alone; the cloth stays", .flat = true}))
            session_->post(UndoSetting{step.number});
        ImGui::SameLine();
        const std::string label =
            step.label + " (frame " + std::to_string(step.frame) + ")" + (step.cloth_returns ? "" : ", scene only");
        if (button(ui, "go",
                   {.text = label,
                    .what = "Go back to before this step",
                    .flat = true,
                    .left = true,
                    .width = width - ImGui::GetFrameHeight() - ui.theme().px(6)}))
            for (std::size_t k = i; k < now.done.size(); ++k) session_->undo();
    }
    for (std::size_t i = now.undone.size(); i-- > 0;) muted_text(ui, "(undone) " + now.undone[i]);
    muted_text(ui, format_number(static_cast<double>(now.undo_bytes) / 1e6, 3) + " MB");
}

}  // namespace weft::editor
