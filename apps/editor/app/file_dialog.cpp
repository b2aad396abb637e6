#include "editor/app/file_dialog.h"

#include "editor/app/popups.h"
#include "editor/ui/widgets/controls.h"

#include <algorithm>
#include <system_error>

namespace weft::editor {
namespace {

bool fits(const std::string& name, const std::vector<std::string>& endings) {
    return endings.empty() ||
           std::ranges::any_of(endings, [&](const std::string& ending) { return name.ends_with(ending); });
}

}  // namespace

void FileDialog::ask(FileQuestion question) {
    question_ = std::move(question);
    open_ = appearing_ = true;
    problem_.clear();
    overwrite_.clear();
    std::error_code failed;
    const auto& start = question_.start;
    path_ = question_.for_writing ? start.filename().string() : "";
    enter(start.has_parent_path() ? start.parent_path() : std::filesystem::current_path(failed));
}

void FileDialog::enter(const std::filesystem::path& folder) {
    std::error_code failed;
    const auto full = std::filesystem::weakly_canonical(folder, failed);
    std::vector<Entry> entries;
    for (const auto& entry : std::filesystem::directory_iterator(full, failed)) {
        std::error_code ignored;
        const std::string name = entry.path().filename().string();
        if (name.starts_with('.')) continue;
        const bool is_folder = entry.is_directory(ignored);
        if (is_folder || fits(name, question_.endings)) entries.push_back({name, is_folder});
    }
    if (failed) {
        problem_ = folder.string() + " cannot be read: " + failed.message();
        return;
    }
    problem_.clear();
    std::ranges::sort(entries, [](const Entry& a, const Entry& b) {
        return a.is_folder != b.is_folder ? a.is_folder : a.name < b.name;
    });
    folder_ = full;
    entries_ = std::move(entries);
}

void FileDialog::finish() {
    std::filesystem::path path = path_;
    if (path.empty()) {
        problem_ = "Choose a file, or type a path.";
        return;
    }
    if (path.is_relative()) path = folder_ / path;
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
        path_.clear();
        return enter(path);
    }
    if (question_.for_writing) {
        if (!path.has_extension() && !question_.endings.empty()) path += question_.endings.front();
        if (std::filesystem::exists(path, ignored) && overwrite_ != path.string()) {
            overwrite_ = path.string();
            problem_ = path.filename().string() + " exists. Press the button again to overwrite it.";
            return;
        }
    } else if (!std::filesystem::exists(path, ignored)) {
        problem_ = path.string() + " does not exist.";
        return;
    }
    open_ = false;
    question_.chosen(path);
}

void FileDialog::show(Ui& ui) {
    if (!open_) return;
    const Theme& theme = ui.theme();
    Dialog dialog(ui, "file_dialog", question_.title.c_str(), ImVec2(theme.px(620), theme.px(440)));
    if (appearing_) ui.focus(ui.probe().path("path"), true);
    appearing_ = false;
    if (ui.pressed(Key::escape)) open_ = false;
    const Change typed = text(ui, {.name = "path", .label = "File", .what = "A path, or a name in the folder below"},
                              path_, "type or paste a path");
    if (typed == Change::finished && ui.pressed(Key::enter)) finish();
    ImGui::TextUnformatted(folder_.string().c_str());
    // The note and the buttons stand below the list. In a low window the dialog scrolls.
    const float line = ImGui::GetFrameHeightWithSpacing();
    const float noted =
        problem_.empty()
            ? 0
            : ImGui::CalcTextSize(problem_.c_str(), nullptr, false, ImGui::GetContentRegionAvail().x - theme.px(40)).y +
                  theme.px(18);
    const float room = ImGui::GetContentRegionAvail().y - line - noted;
    ImGui::BeginChild("entries", ImVec2(0, std::max(room, 3 * line)), true);
    {
        const Ui::Scope scope(ui, "entries");
        const float width = ImGui::GetContentRegionAvail().x;
        std::filesystem::path go;
        for (const std::string& recent : question_.recent)
            if (button(ui, "recent " + recent,
                       {.icon = Icon::file,
                        .text = recent,
                        .what = "Used recently",
                        .flat = true,
                        .left = true,
                        .width = width}))
                path_ = recent, finish();
        if (button(ui, "..", {.icon = Icon::up, .text = "Folder above", .flat = true, .left = true, .width = width}))
            go = folder_ / "..";
        for (const Entry& entry : entries_) {
            if (!button(ui, entry.name,
                        {.icon = entry.is_folder ? Icon::folder : Icon::file,
                         .text = entry.name,
                         .chosen = path_ == entry.name,
                         .flat = true,
                         .left = true,
                         .width = width}))
                continue;
            if (entry.is_folder)
                go = folder_ / entry.name;
            else if (!question_.for_writing && path_ == entry.name)
                finish();
            else
                path_ = entry.name;
        }
        if (!go.empty()) enter(go);
    }
    ImGui::EndChild();
    if (!problem_.empty()) note(ui, "problem", overwrite_.empty() ? Note::error : Note::warning, problem_);
    if (button(ui, "ok", {.text = question_.action, .primary = true})) finish();
    ImGui::SameLine();
    if (button(ui, "cancel", {.text = "Cancel"})) open_ = false;
}

}  // namespace weft::editor
