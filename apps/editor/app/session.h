// What the panels work on: the document as the user sees it, the selection, and actions on their way to the simulator.
#pragma once

#include "editor/core/simulator.h"
#include "editor/ui/ui.h"

#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace weft::editor {

/// An error or a note for the user, until it is closed.
struct Message {
    bool is_error = false;
    std::string title;  ///< empty: none
    std::vector<std::string> lines;
    double since = 0;  ///< s, on the clock of the user interface
};

class Session {
  public:
    explicit Session(Simulator& simulator);

    /// Takes what the simulator has published. `now`: s.
    void begin_frame(double now);

    /// The document with all changes, also those that the simulator has not carried out yet. Never waits.
    const DocumentPtr& document() const { return document_; }
    const Published& now() const { return *published_; }
    /// The number of the last action; the simulator has carried it out once now().acknowledged is as large.
    std::uint64_t posted() const { return posted_; }
    Simulator& simulator() { return simulator_; }

    /// Changes the document. `phase`: of the widget that made the change; changes of one gesture are one undo step.
    /// A change that the document's checks refuse becomes a message and nothing else.
    void change(const std::string& label, std::vector<Edit> edits, Change phase = Change::finished);
    void post(Action action);
    void undo() { post(Undo{}); }
    void redo() { post(Redo{}); }

    // --- Selection

    /// The JSON pointer of the selected object, such as `/cloths/0`, `/air/wind/1`, `/solver`; empty: nothing.
    const std::string& selected() const { return selected_; }
    void select(std::string place);
    /// The name of the selected cloth or collider; empty if something else is selected.
    std::string selected_name() const;

    // --- Messages

    std::vector<Message>& messages() { return messages_; }
    void say(Message message);
    void say(const std::string& title, const Errors& errors);
    void say(const std::string& note);

    // --- Files

    /// Whether the document differs from its file.
    bool has_changes() const;
    /// From now on the document is that of the file, which holds the text.
    void mark_saved(const std::filesystem::path& file, FileTextPtr text);
    /// The same with another scene: what the document was when it was saved.
    void mark_saved(const std::filesystem::path& file, FileTextPtr text, Json scene);
    /// The file has this scene. For sessions that do not begin with their file's content.
    void set_saved(Json scene) { saved_ = std::move(scene); }

  private:
    struct Pending {
        std::uint64_t number = 0;
        std::vector<Edit> edits;
    };
    void rebuild();
    void keep_file();
    void keep_selection(const Document& before);

    Simulator& simulator_;
    PublishedPtr published_;
    DocumentPtr document_;
    std::deque<Pending> pending_;
    std::uint64_t posted_ = 0;
    std::uint64_t gesture_ = 0, next_gesture_ = 1;
    std::string gesture_label_;
    bool gesture_posted_ = false;
    std::string selected_;
    std::vector<Message> messages_;
    Json saved_;
    std::filesystem::path file_;
    FileTextPtr file_text_;
    double now_ = 0;
};

/// The place of a new element: `/cloths/-` becomes `/cloths/2`.
std::string place_after_append(const Document& document, const std::string& list);

/// A name that no cloth and no collider has: `ball`, `ball 2`, ….
std::string free_name(const Document& document, const std::string& wanted);

}  // namespace weft::editor
