// Dialogs of the editor.
#include "editor/app/editor.h"
#include "editor/app/popups.h"
#include "editor/app/scene_files.h"
#include "editor/ui/typeface.h"
#include "editor/ui/widgets/controls.h"
#include "editor/ui/widgets/field.h"
#include "editor/ui/widgets/number.h"

#include <algorithm>
#include <array>
#include <string>
#include <thread>

namespace weft::editor {

void Editor::dialogs(Ui& ui) {
    file_dialog_.show(ui);
    switch (panel_) {
        case Panel::none:
            return;
        case Panel::gallery:
            return gallery_dialog(ui);
        case Panel::export_file:
            return export_dialog(ui);
        case Panel::help:
            return help(ui);
        case Panel::preferences:
            return preferences(ui);
        case Panel::unsaved:
            return unsaved_dialog(ui);
        case Panel::recovery:
            return recovery_dialog(ui);
        case Panel::changed_file:
            return changed_file_dialog(ui);
    }
}

void Editor::unsaved_dialog(Ui& ui) {
    const Theme& theme = ui.theme();
    Dialog dialog(ui, "unsaved", "The scene has changes that are not saved", ImVec2(theme.px(440), 0));
    const auto go_on = [&] {
        panel_ = Panel::none;
        if (auto after = std::exchange(after_unsaved_, {})) after();
    };
    if (button(ui, "save", {.icon = Icon::save, .text = "Save", .primary = true}))
        panel_ = Panel::none, save(false, std::exchange(after_unsaved_, {}));
    if (next_button(ui, "discard", {.icon = Icon::trash, .text = "Discard them"})) go_on();
    if (next_button(ui, "cancel", {.text = "Cancel"})) panel_ = Panel::none, after_unsaved_ = {};
}

// All sessions that have ended unexpectedly, newest first.
void Editor::recovery_dialog(Ui& ui) {
    const Theme& theme = ui.theme();
    Dialog dialog(ui, "recovery",
                  abandoned_.size() > 1 ? "Sessions have ended unexpectedly" : "A session has ended unexpectedly",
                  ImVec2(theme.px(620), 0));
    ImGui::TextUnformatted("What was done can be played again, except the last action if it was not written.");
    std::filesystem::path chosen, unwanted;
    for (std::size_t i = 0; i < abandoned_.size(); ++i) {
        const LogSummary& log = abandoned_[i];
        const Ui::Scope scope(ui, std::to_string(i));
        const std::string scene = log.scene.empty() ? "untitled" : std::filesystem::path(log.scene).filename().string();
        const std::string text = scene + ", " + (log.time.empty() ? log.file.filename().string() : log.time) + ", " +
                                 std::to_string(log.actions) + (log.actions == 1 ? " action" : " actions");
        const ButtonStyle discard{.icon = Icon::trash, .text = "Discard"};
        const float beside = ImGui::GetContentRegionAvail().x - button_width(ui, discard) - theme.px(8);
        if (button(ui, "recover",
                   {.icon = Icon::to_default,
                    .text = text,
                    .what = log.scene.empty() ? "Play the actions of this session again" : log.scene,
                    .primary = i == 0,
                    .left = true,
                    .width = std::max(beside, theme.px(120))}))
            chosen = log.file;
        if (next_button(ui, "discard", discard)) unwanted = log.file;
    }
    if (button(ui, "later", {.text = "Later", .what = "File, Recover shows this list again"})) panel_ = Panel::none;
    if (abandoned_.size() > 1 && next_button(ui, "discard_all", {.icon = Icon::trash, .text = "Discard all"}))
        while (!abandoned_.empty()) discard_log(std::filesystem::path(abandoned_.front().file));
    if (!unwanted.empty()) discard_log(unwanted);
    if (abandoned_.empty()) panel_ = Panel::none;
    if (!chosen.empty()) unless_changed([this, chosen] { recover(chosen); });
}

void Editor::changed_file_dialog(Ui& ui) {
    const Theme& theme = ui.theme();
    const std::filesystem::path file = session_->document()->file;
    Dialog dialog(ui, "changed_file", "The file has changed on disk", ImVec2(theme.px(520), 0));
    ImGui::Text("%s is not as it was when it was opened or saved last. Saving undoes those changes.",
                file.filename().c_str());
    if (button(ui, "save_as", {.icon = Icon::save, .text = "Save as …", .primary = true}))
        panel_ = Panel::none, save(true, std::exchange(after_unsaved_, {}));
    if (next_button(ui, "overwrite", {.icon = Icon::trash, .text = "Overwrite it"}))
        panel_ = Panel::none, save_to(file, std::exchange(after_unsaved_, {}), true);
    if (next_button(ui, "cancel", {.text = "Cancel"})) panel_ = Panel::none, after_unsaved_ = {};
}

void Editor::gallery_dialog(Ui& ui) {
    bool open = true;
    const auto chosen = gallery_.show(ui, window_->renderer(), open);
    if (!open) panel_ = Panel::none;
    if (chosen) unless_changed([this, file = *chosen] { open_later(file, {}); });
}

void Editor::preferences(Ui& ui) {
    const Theme& theme = ui.theme();
    Dialog dialog(ui, "preferences", "Preferences", ImVec2(theme.px(520), 0));
    std::size_t appearance = settings_.appearance == Appearance::light ? 1 : 0;
    constexpr std::array<std::string_view, 2> appearances{"dark", "light"};
    bool changed = choice(ui, {.name = "appearance", .label = "Appearance"}, appearance, appearances) != Change::none;
    settings_.appearance = appearance == 1 ? Appearance::light : Appearance::dark;
    double percent = static_cast<double>(theme.scale) * 100;
    const NumberRange range{.min = 75, .max = 300, .unit = "%"};
    const Change scaled =
        number(ui, {.name = "scale", .label = "Scale", .what = "Size of text and widgets"}, percent, range);
    if (scaled == Change::finished) settings_.scale = static_cast<float>(percent / 100), changed = true;
    if (changed) ui.set_theme(settings_.appearance, settings_.scale > 0 ? settings_.scale : theme.scale);
    std::size_t keys = settings_.keys == FlyKeys::source ? 1 : 0;
    constexpr std::array<std::string_view, 2> maps{"W S forward, back; Q E down, up",
                                                   "W S up, down; Q E back, forward"};
    if (choice(ui, {.name = "keys", .label = "Flight keys", .what = "Keys that move the eye"}, keys, maps) !=
        Change::none)
        view_.settings.keys = settings_.keys = keys == 1 ? FlyKeys::source : FlyKeys::usual;
    std::size_t always = settings_.fly_always ? 1 : 0;
    constexpr std::array<std::string_view, 2> when{"right button held", "always"};
    if (choice(ui, {.name = "fly", .label = "They act", .what = "When the flight keys move the eye"}, always, when) !=
        Change::none)
        view_.settings.fly_always = settings_.fly_always = always == 1;
    const Published& now = session_->now();
    std::size_t backend = now.backend == "vulkan" ? 1 : 0;
    constexpr std::array<std::string_view, 2> backends{"cpu", "vulkan"};
    if (choice(ui, {.name = "backend", .label = "Backend", .what = "Where the running scene is simulated"}, backend,
               backends) == Change::finished)
        session_->post(UseBackend{std::string(backends[backend]), now.threads});
    long long threads = now.threads;
    if (integer(ui, {.name = "threads", .label = "Threads"}, threads, {.min = 1, .max = 256, .integer = true}) ==
        Change::finished)
        session_->post(UseBackend{now.backend, static_cast<std::uint32_t>(threads)});
    if (button(ui, "close", {.text = "Close", .primary = true})) panel_ = Panel::none;
}

void Editor::help(Ui& ui) {
    const Theme& theme = ui.theme();
    Dialog dialog(ui, "help", "Keys and mouse", ImVec2(theme.px(1040), 0));
    std::vector<std::pair<std::string, std::string>> lines{
        {"Left drag on cloth", "Pull it, with a force that has a limit (tool Hand)"},
        {"Left drag on a collider", "Move it (tool Hand)"},
        {"Left drag elsewhere, Alt + left", "Orbit"},
        {"Right drag", "Look around; with W A S D Q E fly, Shift is faster"},
        {"Middle drag", "Move the view"},
        {"Wheel", "Toward the pointer and back; while pulling, move the point away and back"},
        {"Click", "Select; with Select, Lasso or Anchors a vertex"},
        {"Drag with Select or Lasso", "Choose vertices; Shift adds, Ctrl removes"},
        {"Drag with Brush", "Paint; Ctrl erases, Shift smooths"},
        {"Ctrl while a handle is dragged", "Move in steps"},
        {"Numbers at a handle", "An exact amount: while it is dragged, or after a click on it; Enter keeps it"},
        {"Esc", "Take the drag back; then select nothing"},
        {"Double click on a value", "The default"},
        {"Tab, arrows, Enter", "Go through the panels and change values"}};
    for (const Command& one : commands_)
        if (one.key != Key::none) lines.emplace_back(shortcut_text(one), std::string(one.label));
    // Side by side where there is room.
    const int columns = ImGui::GetContentRegionAvail().x > theme.px(600) ? 2 : 1;
    const std::size_t rows = (lines.size() + static_cast<std::size_t>(columns) - 1) / static_cast<std::size_t>(columns);
    if (ImGui::BeginTable("lines", 2 * columns, ImGuiTableFlags_SizingStretchProp)) {
        for (std::size_t row = 0; row < rows; ++row) {
            for (std::size_t at = row; at < lines.size(); at += rows) {
                ImGui::TableNextColumn();
                ImGui::PushTextWrapPos(0);
                ImGui::TextUnformatted(lines[at].first.c_str());
                ImGui::PopTextWrapPos();
                ImGui::TableNextColumn();
                ImGui::PushTextWrapPos(0);
                muted_text(ui, lines[at].second);
                ImGui::PopTextWrapPos();
            }
        }
        ImGui::EndTable();
    }
    muted_text(ui, "Screen readers are not supported.");
    muted_text(ui, typeface_notice);
    if (button(ui, "close", {.text = "Close", .primary = true})) panel_ = Panel::none;
}

}  // namespace weft::editor
