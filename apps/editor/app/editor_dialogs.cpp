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
        case Panel::unsaved: {
            const Theme& theme = ui.theme();
            Dialog dialog(ui, "unsaved", "The scene has changes that are not saved",
                          ImVec2(theme.px(440), theme.px(120)));
            ImGui::Dummy(ImVec2(0, theme.px(6)));
            const auto go_on = [&] {
                panel_ = Panel::none;
                if (auto after = std::exchange(after_unsaved_, {})) after();
            };
            if (button(ui, "save", {.icon = Icon::save, .text = "Save", .primary = true}))
                panel_ = Panel::none, save(false, std::exchange(after_unsaved_, {}));
            ImGui::SameLine();
            if (button(ui, "discard", {.icon = Icon::trash, .text = "Discard them"})) go_on();
            ImGui::SameLine();
            if (button(ui, "cancel", {.text = "Cancel"})) panel_ = Panel::none, after_unsaved_ = {};
            return;
        }
        case Panel::recovery: {
            const Theme& theme = ui.theme();
            Dialog dialog(ui, "recovery", "A session has ended unexpectedly", ImVec2(theme.px(520), theme.px(150)));
            ImGui::TextWrapped("Its actions can be played again, except the last one if it was not written.");
            if (button(ui, "recover", {.icon = Icon::to_default, .text = "Recover it", .primary = true}))
                recover(abandoned_.front());
            ImGui::SameLine();
            if (button(ui, "discard", {.icon = Icon::trash, .text = "Discard it"})) {
                std::error_code ignored;
                for (const auto& log : abandoned_) std::filesystem::remove(log, ignored);
                panel_ = Panel::none;
            }
            ImGui::SameLine();
            if (button(ui, "later", {.text = "Later"})) panel_ = Panel::none;
            return;
        }
        case Panel::changed_file:
            return changed_file_dialog(ui);
    }
}

void Editor::changed_file_dialog(Ui& ui) {
    const Theme& theme = ui.theme();
    const std::filesystem::path file = session_->document()->file;
    Dialog dialog(ui, "changed_file", "The file has changed on disk", ImVec2(theme.px(520), theme.px(150)));
    ImGui::TextWrapped("%s is not as it was when it was opened or saved last. Saving undoes those changes.",
                       file.filename().c_str());
    if (button(ui, "save_as", {.icon = Icon::save, .text = "Save as …", .primary = true}))
        panel_ = Panel::none, save(true, std::exchange(after_unsaved_, {}));
    ImGui::SameLine();
    if (button(ui, "overwrite", {.icon = Icon::trash, .text = "Overwrite it"}))
        panel_ = Panel::none, save_to(file, std::exchange(after_unsaved_, {}), true);
    ImGui::SameLine();
    if (button(ui, "cancel", {.text = "Cancel"})) panel_ = Panel::none, after_unsaved_ = {};
}

void Editor::gallery_dialog(Ui& ui) {
    const Theme& theme = ui.theme();
    Dialog dialog(ui, "gallery", "Gallery", ImVec2(theme.px(760), theme.px(480)));
    ImGui::BeginChild("scenes", ImVec2(0, -ImGui::GetFrameHeightWithSpacing() * 1.2f), false);
    static const std::vector<GalleryScene> scenes = gallery();
    const float width = (ImGui::GetContentRegionAvail().x - theme.px(24)) / 3;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        if (i % 3 != 0) ImGui::SameLine();
        if (!button(ui, scenes[i].name,
                    {.icon = Icon::cloth, .text = scenes[i].name, .what = scenes[i].file.string(), .width = width}))
            continue;
        panel_ = Panel::none;
        unless_changed([this, file = scenes[i].file] { open_later(file, {}); });
    }
    ImGui::EndChild();
    if (button(ui, "close", {.text = "Close"})) panel_ = Panel::none;
}

void Editor::export_dialog(Ui& ui) {
    const Theme& theme = ui.theme();
    Dialog dialog(ui, "export", "Export the run from its first frame", ImVec2(theme.px(520), theme.px(210)));
    auto frames = static_cast<long long>(export_options_.frames);
    const Field field{.name = "frames", .label = "Frames", .what = "How many frames are simulated"};
    if (integer(ui, field, frames, {.min = 1, .max = 1e6, .integer = true}) != Change::none)
        export_options_.frames = static_cast<std::uint64_t>(frames);
    muted_text(ui, "The run of weft run: without what the hand has pulled and cut.");
    if (button(ui, "choose", {.icon = Icon::export_file, .text = "Choose a file …", .primary = true})) {
        panel_ = Panel::none;
        file_dialog_.ask({.title = "Export: .glb, .mp4, .png, .pc2, .obj or .ply",
                          .action = "Export",
                          .endings = export_endings(),
                          .for_writing = true,
                          .start = session_->document()->folder / "cloth.glb",
                          .chosen = [this](const std::filesystem::path& file) {
                              export_options_.file = file;
                              auto job = ExportJob::start(*session_->document(), export_options_);
                              if (!job) return session_->say("Export", job.errors());
                              export_ = std::move(*job);
                          }});
    }
    ImGui::SameLine();
    if (button(ui, "cancel", {.text = "Cancel"})) panel_ = Panel::none;
}

void Editor::preferences(Ui& ui) {
    const Theme& theme = ui.theme();
    Dialog dialog(ui, "preferences", "Preferences", ImVec2(theme.px(480), theme.px(330)));
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
    if (choice(ui, {.name = "keys", .label = "Flight keys", .what = "With the right button held"}, keys, maps) !=
        Change::none)
        view_.settings.keys = settings_.keys = keys == 1 ? FlyKeys::source : FlyKeys::usual;
    double force = static_cast<double>(settings_.pull_force);
    if (number(ui, {.name = "pull_force", .label = "Pull", .what = "Largest force of the hand"}, force,
               {.min = 0.01, .max = 10000, .unit = "N", .usual = 5}) != Change::none)
        view_.settings.pull_force = settings_.pull_force = static_cast<float>(force);
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
    Dialog dialog(ui, "help", "Keys and mouse", ImVec2(theme.px(800), theme.px(560)));
    ImGui::BeginChild("text", ImVec2(0, -ImGui::GetFrameHeightWithSpacing() * 1.2f), false);
    constexpr std::pair<const char*, const char*> mouse[] = {
        {"Left drag on cloth", "pulls it, with a force that has a limit (tool Hand)"},
        {"Left drag on a collider", "moves it (tool Hand)"},
        {"Left drag elsewhere, Alt + left", "orbits"},
        {"Right drag", "looks around; with W A S D Q E flies, Shift is faster"},
        {"Middle drag", "moves the view"},
        {"Wheel", "nearer and farther; while pulling, moves the point away and back"},
        {"Click", "selects; with Select, Lasso or Anchors a vertex"},
        {"Drag with Select, Lasso", "chooses vertices; Shift adds, Ctrl removes"},
        {"Drag with Brush", "paints; Ctrl erases, Shift smooths"},
        {"Ctrl while a handle is dragged", "moves in steps"},
        {"Esc", "takes the drag back; then selects nothing"},
        {"Double click on a value", "the default"},
        {"Tab, arrows, Enter", "go through the panels and change values"}};
    for (const auto& [what, does] : mouse) {
        ImGui::TextUnformatted(what);
        ImGui::SameLine(theme.px(250));
        ImGui::TextUnformatted(does);
    }
    ImGui::Separator();
    for (const Command& one : commands_) {
        if (one.key == Key::none) continue;
        ImGui::TextUnformatted(std::string(one.label).c_str());
        ImGui::SameLine(theme.px(250));
        ImGui::TextUnformatted(shortcut_text(one).c_str());
    }
    ImGui::Separator();
    muted_text(ui, "Screen readers are not supported.");
    muted_text(ui, typeface_notice);
    ImGui::EndChild();
    if (button(ui, "close", {.text = "Close", .primary = true})) panel_ = Panel::none;
}

}  // namespace weft::editor
