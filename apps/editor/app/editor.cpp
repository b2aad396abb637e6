#include "editor/app/editor.h"

#include "editor/app/objects.h"
#include "editor/app/popups.h"
#include "editor/app/scene_files.h"
#include "editor/app/timeline_bar.h"
#include "editor/app/view_legends.h"
#include "editor/ui/widgets/controls.h"
#include "editor/ui/widgets/panels.h"
#include "view/framing.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

namespace weft::editor {
namespace {

constexpr ImGuiWindowFlags fixed_window = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                          ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;
constexpr std::size_t plotted_steps = 120;

/// One panel of the window.
template <class Content>
void panel(Ui& ui, const char* name, ImVec2 size, ImVec4 color, ImVec2 padding, Content&& content,
           ImGuiWindowFlags more = 0) {
    const Theme& theme = ui.theme();
    ImGui::PushStyleColor(ImGuiCol_ChildBg, color);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
    ImGui::BeginChild(name, size, false, ImGuiWindowFlags_AlwaysUseWindowPadding | more);
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
    // Only inside: after the child, spacing would move the next panel.
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(theme.px(6), theme.px(5)));
    {
        const Ui::Scope scope(ui, name);
        content();
    }
    ImGui::PopStyleVar();
    ImGui::EndChild();
}

unsigned editor_threads(const Options& options) {
    // One core is left to the window.
    return options.threads > 1 ? options.threads : std::max(1u, std::thread::hardware_concurrency() - 1);
}

}  // namespace

Editor::Editor(EditorOptions options) : options_(std::move(options)) {
    options_.simulation.threads = editor_threads(options_.simulation);
    if (options_.simulation.backend == "auto" && options_.simulation.device.empty())
        options_.simulation.backend = "cpu";
}

Editor::~Editor() {
    // Both threads call the window.
    view_thread_.reset();
    session_.reset();
    if (simulator_) simulator_->play(false);  // an export may keep it for a while
    simulator_.reset();
    if (!log_file_.empty() && options_.record.empty()) {
        std::error_code ignored;
        std::filesystem::remove(log_file_, ignored);  // the session has ended by itself
    }
    if (options_.keep_settings) (void)save_settings(settings_, settings_file());
}

Result<std::unique_ptr<Editor>> Editor::open(const EditorOptions& options) {
    std::unique_ptr<Editor> editor(new Editor(options));
    if (auto started = editor->start(); !started) return started.errors();
    return editor;
}

Result<void> Editor::start() {
    std::string problem;
    if (options_.keep_settings) settings_ = load_settings(settings_file(), problem);
    DocumentPtr document = first_document();
    if (!options_.scene.empty()) {
        auto opened = open_document(options_.scene);
        if (!opened) return opened.errors();
        document = *opened;
    }
    auto stage = Stage::open(document, {.simulation = options_.simulation});
    if (!stage) return stage.errors();
    auto window = UiWindow::open({.width = options_.width,
                                  .height = options_.height,
                                  .device = options_.simulation.device,
                                  .appearance = settings_.appearance,
                                  .scale = options_.scale > 0 ? options_.scale : settings_.scale,
                                  .probe = options_.probe,
                                  .least_frame = options_.least_frame});
    if (!window) {
        Errors errors = window.errors();
        errors.back().what += "; weft run and weft render need no display";
        return errors;
    }
    window_ = std::move(*window);
    image_ = window_->renderer().add_image();
    view_.settings.keys = settings_.keys;
    view_.settings.fly_always = settings_.fly_always;
    view_.settings.pull_force = settings_.pull_force;
    make_commands();
    view_thread_ = std::make_unique<ViewThread>(ViewThreadOptions{.on_image = [this] { window_->redraw(); }});
    set_stage(std::move(*stage));
    if (!options_.scene.empty()) add_recent(settings_, options_.scene);
    if (!problem.empty()) session_->say(problem);
    if (options_.record.empty() && options_.keep_settings) {
        for (const std::filesystem::path& file : abandoned_logs(log_folder())) abandoned_.push_back(summary_of(file));
        if (!abandoned_.empty()) panel_ = Panel::recovery;
    }
    simulator_->play(true);
    return {};
}

// Replaces what runs.
void Editor::set_stage(Stage stage, const std::optional<Log>& recovered) {
    session_.reset();
    if (simulator_) simulator_->play(false);  // an export may keep it for a while
    simulator_.reset();
    if (!log_file_.empty() && options_.record.empty()) {
        std::error_code ignored;
        std::filesystem::remove(log_file_, ignored);
    }
    std::optional<ActionLog> log;
    std::string problem;
    log_file_ = options_.record.empty() ? new_log_file(log_folder()) : options_.record;
    if (options_.record.empty() && (log_folder().empty() || !options_.keep_settings)) log_file_.clear();
    if (!log_file_.empty()) {
        const Options& with = stage.options();
        // A session that was recovered goes on with its actions, so that it can be recovered again.
        const LogHead fresh{stage.document(), with.backend, with.threads};
        auto made = ActionLog::create(log_file_, recovered ? recovered->head : fresh);
        if (made) {
            log = std::move(*made);
            for (std::size_t i = 0; recovered && i < recovered->actions.size(); ++i) log->add(recovered->actions[i]);
        } else {
            problem = made.error().message() + ": after a crash this session cannot be recovered";
            log_file_.clear();
        }
    }
    photographer_ = std::make_shared<Photographer>();
    const DocumentPtr document = stage.document();
    const std::optional<Stage::SavedFile> saved = stage.saved();
    simulator_ = std::make_shared<Simulator>(
        std::move(stage),
        Simulator::Hooks{.observe = [camera = photographer_](Stage& one) -> std::shared_ptr<const void> {
                             return camera->take(one);
                         },
                         .wake = [this] { window_->redraw(); }},
        std::move(log));
    session_ = std::make_unique<Session>(*simulator_);
    if (saved)
        session_->mark_saved(saved->file, saved->text, saved->json);
    else if (recovered)
        session_->set_saved(recovered->head.document->json);
    if (!problem.empty()) session_->say(problem);
    marks_ = {};
    view_.selector.choose_none();
    view_.anchors.discard();
    view_.brush.cancel();
    const auto* picture = static_cast<const Picture*>(session_->now().picture.get());
    view_.camera = document->scene.camera.value_or(framing(subject_of(*picture->world).all, 1.6f));
}

// --- Opening

// The scene is built in the background; the present one goes on until then.
void Editor::open_later(const std::filesystem::path& file, DocumentPtr document) {
    if (opening_.valid()) return;
    opening_ = std::async(std::launch::async, [file, document, simulation = options_.simulation, this] {
        Opened opened{{}, {}, file};
        DocumentPtr from = document;
        if (!from) {
            auto read = open_document(file);
            if (!read)
                opened.errors = read.errors();
            else
                from = *read;
        }
        if (from) {
            auto stage = Stage::open(from, {.simulation = simulation});
            if (!stage)
                opened.errors = stage.errors();
            else
                opened.stage.emplace(std::move(*stage));
        }
        window_->redraw();
        return opened;
    });
}

void Editor::take_opened() {
    if (!opening_.valid() || opening_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    Opened opened = opening_.get();
    if (!opened.stage) {
        session_->say("Open " + opened.file.filename().string(), opened.errors);
        return;
    }
    set_stage(std::move(*opened.stage), opened.recovered);
    if (opened.recovered) {
        // The new log has all of it.
        if (!log_file_.empty()) discard_log(opened.file);
        if (!opened.errors.empty()) session_->say("Recovered in part", opened.errors);
    } else if (!opened.file.empty()) {
        add_recent(settings_, opened.file);
    }
    simulator_->play(true);
}

// Plays a log in the background, as far as it can be played.
void Editor::recover(const std::filesystem::path& file) {
    panel_ = Panel::none;
    if (opening_.valid()) return;
    opening_ = std::async(std::launch::async, [file, this] {
        Opened opened{{}, {}, file};
        auto log = read_log(file);
        auto stage = log ? open_stage(log->head, {}) : Result<Stage>(log.errors());
        if (!stage) {
            opened.errors = stage.errors();
        } else {
            std::size_t done = 0;
            const auto count = [&](std::size_t actions) {
                done = actions;
                return true;
            };
            if (auto played = play(*stage, log->actions, log->end, count); !played) {
                opened.errors = played.errors();
                log->actions.resize(done);
            }
            opened.stage.emplace(std::move(*stage));
            opened.recovered.emplace(std::move(*log));
        }
        window_->redraw();
        return opened;
    });
}

void Editor::discard_log(const std::filesystem::path& file) {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
    std::erase_if(abandoned_, [&](const LogSummary& one) { return one.file == file; });
}

void Editor::drop(const std::vector<std::string>& files) {
    for (const std::string& file : files) {
        if (file.ends_with(".json")) {
            unless_changed([this, file] { open_later(file, {}); });
            return;
        }
        add_cloth_from(file);
        did("drop");
    }
}

// --- A frame

Result<void> Editor::run() {
    return window_->run([this](Ui& ui) { return frame(ui); });
}

Result<void> Editor::frame(Ui& ui) {
    take_opened();
    session_->begin_frame(ui.now());
    take_added();
    if (auto taken = take_view_image(); !taken) return taken;
    if (!ui.input().files.empty()) drop(ui.input().files);
    if (window_->close_requested() && !closing_) {
        window_->keep_open();
        close();
    }
    keys(ui);
    layout(ui);
    dialogs(ui);
    request_view();
    update_title();
    const Published& now = session_->now();
    if (now.frame != plotted_) {
        plotted_ = now.frame;
        step_ms_.push_back(static_cast<float>(now.step_ms));
        if (step_ms_.size() > plotted_steps) step_ms_.pop_front();
    }
    return {};
}

void Editor::layout(Ui& ui) {
    const Theme& theme = ui.theme();
    const ImVec2 size = ui.size();
    ImGui::SetNextWindowPos(ImVec2(0, 0));
    ImGui::SetNextWindowSize(size);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, theme.colors.background);
    ImGui::Begin("editor", nullptr, fixed_window);
    ImGui::PopStyleColor();
    toolbar(ui);
    const float status = theme.px(26), bar = splitter_width(ui), least = theme.px(60);
    const float height = std::max(least, size.y - ImGui::GetCursorPosY() - status);
    if (narrow(ui)) {
        const ImVec2 whole(size.x, height);
        if (page_ == Page::view) middle_panel(ui, whole);
        if (page_ == Page::objects) objects_panel(ui, whole);
        if (page_ == Page::properties) properties_panel(ui, whole);
    } else {
        // Smaller windows show less at the sides.
        const float room = std::max(0.0f, size.x - 2 * bar - theme.px(140));
        const float left = std::min(theme.px(settings_.left), room * 0.4f),
                    right = std::min(theme.px(settings_.right), room * 0.55f);
        objects_panel(ui, ImVec2(left, height));
        ImGui::SameLine(0, 0);
        splitter(ui, "split_left", SplitAxis::x, height, settings_.left, 120, 600);
        ImGui::SameLine(0, 0);
        middle_panel(ui, ImVec2(std::max(least, size.x - left - right - 2 * bar), height));
        ImGui::SameLine(0, 0);
        splitter(ui, "split_right", SplitAxis::x, height, settings_.right, 200, 800, true);
        ImGui::SameLine(0, 0);
        properties_panel(ui, ImVec2(right, height));
    }
    status_line(ui);
    ImGui::End();
    ImGui::PopStyleVar(2);
}

void Editor::objects_panel(Ui& ui, ImVec2 size) {
    const Theme& theme = ui.theme();
    panel(ui, "objects", size, theme.colors.panel, ImVec2(theme.px(10), theme.px(8)), [&] {
        cards_.show(ui, *session_, marks_, [&](std::string_view name) { add_object(name); });
        if (show_history_) history(ui);
    });
}

void Editor::middle_panel(Ui& ui, ImVec2 size) {
    const Theme& theme = ui.theme();
    constexpr ImGuiWindowFlags still = ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;
    const float least = theme.px(60);
    const auto content = [&] {
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
        const float bottom = timeline_height(ui);
        panel(
            ui, "view", ImVec2(size.x, std::max(least, size.y - bottom)), theme.colors.background, ImVec2(0, 0),
            [&] { view(ui); }, still);
        panel(
            ui, "timeline", ImVec2(size.x, bottom), theme.colors.panel, ImVec2(theme.px(8), theme.px(6)),
            [&] { show_timeline(ui, *session_); }, still);
        ImGui::PopStyleVar();
    };
    panel(ui, "middle", size, theme.colors.background, ImVec2(0, 0), content, still);
}

void Editor::properties_panel(Ui& ui, ImVec2 size) {
    const Theme& theme = ui.theme();
    panel(ui, "properties", size, theme.colors.panel, ImVec2(theme.px(10), theme.px(8)), [&] {
        const auto* picture = static_cast<const Picture*>(session_->now().picture.get());
        if (picture && tool_panel_.show(ui, *session_, view_, *picture)) ImGui::Separator();
        settings_.pull_force = view_.settings.pull_force;
        ImGui::PushFont(theme.strong);
        const std::string& selected = session_->selected();
        ImGui::TextUnformatted(selected.empty() ? "Properties"
                                                : describe_object(*session_->document(), selected).c_str());
        ImGui::PopFont();
        properties_.show(ui, *session_);
    });
}

void Editor::view(Ui& ui) {
    Vec2 image_size{};
    if (view_image_ && !view_image_->image.rgba.empty())
        image_size = {static_cast<float>(view_image_->image.width), static_cast<float>(view_image_->image.height)};
    const ImVec2 corner = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
    view_.has_keys = panel_ == Panel::none && !file_dialog_.is_open();
    view_.show(ui, *session_, marks_, image_, image_size);
    if (view_image_) show_legends(ui, ImRect(corner, corner + room), view_image_->legends);
    ImGui::SetCursorScreenPos(ImVec2(corner.x + ui.theme().px(10), corner.y + ui.theme().px(8)));
    view_overlay(ui);
}

void Editor::request_view() {
    const auto picture = std::static_pointer_cast<const Picture>(session_->now().picture);
    if (!picture || !view_thread_) return;
    // Settings of the document that the world has not yet followed, such as light and materials, are drawn at once.
    ViewRequest request{.world = picture->world,
                        .scene = std::shared_ptr<const SceneDesc>(session_->document(), &session_->document()->scene),
                        .folder = session_->document()->folder,
                        .camera = view_.camera,
                        .width = static_cast<std::uint32_t>(view_.size().x),
                        .height = static_cast<std::uint32_t>(view_.size().y),
                        .overlays = overlays_,
                        .paint = view_.paint(*session_, *picture),
                        .hidden = {marks_.hidden.begin(), marks_.hidden.end()}};
    const std::string name = session_->selected_name();
    if (session_->selected().starts_with("/cloths/")) request.selected_cloths = {name};
    if (session_->selected().starts_with("/colliders/")) request.selected_colliders = {name};
    view_thread_->request(std::move(request));
}

Result<void> Editor::take_view_image() {
    const auto image = view_thread_->image();
    if (!image || image == view_image_) return {};
    view_image_ = image;
    if (!image->errors.empty()) {
        session_->say("The view cannot be drawn", image->errors);
        return {};
    }
    return window_->renderer().update(image_, image->image);
}

void Editor::update_title() {
    const std::filesystem::path& file = session_->document()->file;
    const std::string name = file.empty() ? "untitled" : file.filename().string();
    const std::string title = name + (session_->has_changes() ? " (changed)" : "") + " - weft";
    if (title == title_) return;
    title_ = title;
    window_->window().set_title(title);
}

Result<void> edit(const EditorOptions& options) {
    auto editor = Editor::open(options);
    if (!editor) return editor.errors();
    return (*editor)->run();
}

}  // namespace weft::editor
