// The editor: a window with the view, the list of objects, their properties and the timeline of a running scene.
#pragma once

#include "editor/app/cards.h"
#include "editor/app/export_dialog.h"
#include "editor/app/file_dialog.h"
#include "editor/app/gallery.h"
#include "editor/app/picture.h"
#include "editor/app/properties.h"
#include "editor/app/session.h"
#include "editor/app/settings.h"
#include "editor/app/tool_panel.h"
#include "editor/app/view_panel.h"
#include "editor/ui/ui_window.h"
#include "editor/view/view_thread.h"

#include <weft/bounds.h>
#include <weft/simulation.h>

#include <deque>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace weft::editor {

struct EditorOptions {
    std::filesystem::path scene = {};  ///< empty: the first scene
    Options simulation = {};
    std::filesystem::path probe = {};   ///< UiWindowOptions::probe
    std::filesystem::path record = {};  ///< a log of the session is written here; empty: to the folder of logs
    std::uint32_t width = 1280, height = 720;
    double least_frame = 0;  ///< s, of the user interface, for tests
    float scale = 0;         ///< of the user interface; 0: that of the settings or the system
    bool keep_settings = true;
};

/// Something that the user can do: by menu, button and key.
struct Command {
    std::string_view name;  ///< for tests and for the probe
    std::string_view label, what;
    Icon icon{};
    Key key = Key::none;
    Modifiers modifiers = {};
    std::function<void()> run;
    std::function<bool()> enabled = {};
};

class Editor {
  public:
    /// Builds the scene and opens the window. Fails without a display, with an error that names the commands that need
    /// none.
    static Result<std::unique_ptr<Editor>> open(const EditorOptions& options);
    ~Editor();
    /// Runs until the window is closed.
    Result<void> run();

  private:
    explicit Editor(EditorOptions options);
    struct Opened {
        std::optional<Stage> stage;
        Errors errors;
        std::filesystem::path file;
        std::optional<Log> recovered = {};  ///< what has led to the stage
    };
    Result<void> start();
    void set_stage(Stage stage, const std::optional<Log>& recovered = {});
    void open_later(const std::filesystem::path& file, DocumentPtr document);
    void take_opened();
    void recover(const std::filesystem::path& log);
    void discard_log(const std::filesystem::path& file);

    Result<void> frame(Ui& ui);
    void layout(Ui& ui);
    void toolbar(Ui& ui);
    void scroll_toolbar(Ui& ui);
    bool narrow(const Ui& ui) const;
    void pages(Ui& ui);
    void objects_panel(Ui& ui, ImVec2 size);
    void middle_panel(Ui& ui, ImVec2 size);
    void properties_panel(Ui& ui, ImVec2 size);
    void menus(Ui& ui);
    void menu(Ui& ui, const char* name, const char* label, std::initializer_list<const char*> commands);
    void menu_entries(Ui& ui, const char* name, std::initializer_list<const char*> commands);
    void view(Ui& ui);
    void view_overlay(Ui& ui);
    void timeline(Ui& ui);
    void status_line(Ui& ui);
    void status_texts(Ui& ui);
    void messages(Ui& ui);
    void hints(Ui& ui);
    void dialogs(Ui& ui);
    void history(Ui& ui);
    void gallery_dialog(Ui& ui);
    void unsaved_dialog(Ui& ui);
    void recovery_dialog(Ui& ui);
    void changed_file_dialog(Ui& ui);
    void export_dialog(Ui& ui);
    Result<void> start_export(const std::filesystem::path& file);
    void help(Ui& ui);
    void preferences(Ui& ui);
    void request_view();
    Result<void> take_view_image();

    void make_commands();
    const Command* command(std::string_view name) const;
    void run_command(const Command& command);
    void keys(Ui& ui);

    void add_object(std::string_view name);
    void add_cloth_from(const std::string& file);
    void take_added();
    void remove_selected();
    void duplicate_selected();
    void toggle_play();
    void step_once();
    void key_selected();
    /// `after`: what follows once it is saved.
    void save(bool as, std::function<void()> after = {});
    void save_to(std::filesystem::path file, std::function<void()> after = {}, bool overwrite_changed = false);
    void ask_open();
    void ask_export();
    void screenshot();
    void drop(const std::vector<std::string>& files);
    /// Runs `what` at once, or after the user has answered what becomes of unsaved changes.
    void unless_changed(std::function<void()> what);
    void toggle_overlay(const Overlay* overlay);
    void close();
    void update_title();
    void did(const std::string& hint) { settings_.hints_done.insert(hint); }

    EditorOptions options_;
    Settings settings_;
    std::unique_ptr<UiWindow> window_;
    std::shared_ptr<Photographer> photographer_;
    std::shared_ptr<Simulator> simulator_;
    std::unique_ptr<Session> session_;
    std::unique_ptr<ViewThread> view_thread_;
    std::shared_ptr<const ViewImage> view_image_;
    UiImage image_ = UiImage::none;
    std::vector<Command> commands_;
    Cards cards_;
    Properties properties_;
    ViewPanel view_;
    ToolPanel tool_panel_;
    ViewMarks marks_;
    std::vector<const Overlay*> overlays_;
    FileDialog file_dialog_;
    Gallery gallery_;
    std::unique_ptr<ExportJob> export_;
    ExportChoices export_choices_;
    enum class Panel : std::uint8_t { none, gallery, export_file, help, preferences, unsaved, recovery, changed_file };
    Panel panel_ = Panel::none;
    enum class Page : std::uint8_t { view, objects, properties };
    Page page_ = Page::view;  ///< in a narrow window
    bool show_history_ = false;
    std::function<void()> after_unsaved_;
    std::vector<LogSummary> abandoned_;
    std::future<Opened> opening_;
    struct Added {
        std::string file;
        Bounds bounds;  ///< of the mesh, m
        Errors errors;
        bool has_colors = false;
    };
    std::vector<std::future<Added>> adding_;
    std::filesystem::path log_file_;
    std::deque<float> step_ms_;
    std::uint64_t plotted_ = 0;
    std::string title_;
    bool closing_ = false;
};

/// `Ctrl+Shift+Z`; empty without a key.
std::string shortcut_text(const Command& command);

/// Opens the editor and runs it; for the command line.
Result<void> edit(const EditorOptions& options);

}  // namespace weft::editor
