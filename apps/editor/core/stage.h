// Carries out actions on a scene and its world, one after another. Needs no window and no thread: the same actions give
// the same bits.
#pragma once

#include "editor/core/action.h"
#include "editor/core/history.h"
#include "editor/core/timeline.h"
#include "weft/scene_world.h"

#include <weft/ids.h>
#include <weft/simulation.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace weft::editor {

struct StageOptions {
    Options simulation = {};
    std::size_t undo_memory = std::size_t{512} << 20;  ///< bytes
    TimelineOptions timeline = {};
    bool record = true;  ///< keep frames for the timeline
};

class Stage {
  public:
    /// Builds the world of the document. Fails with all problems.
    static Result<Stage> open(DocumentPtr document, StageOptions options);
    Stage(Stage&&) noexcept = default;
    Stage& operator=(Stage&&) noexcept = default;

    /// Carries out an action between two frames. An action that fails changes nothing.
    Result<void> apply(const Action& action);
    /// Advances by a frame, with the document as it is now. If the device is lost, the last recorded frame goes on on
    /// the CPU, and notes() says so.
    Result<void> step();

    const DocumentPtr& document() const { return document_; }
    SceneWorld& world() { return *world_; }
    std::uint64_t frame() const { return world_->world().index(); }
    /// Of the document that the world follows; after a jump to an earlier frame it may be an earlier one.
    bool follows_document() const { return followed_ == document_; }
    const History& history() const { return history_; }
    const Timeline& timeline() const { return timeline_; }
    const Lineage& lineage() const { return lineage_; }
    const Options& options() const { return options_.simulation; }
    /// A hash of document and state: equal after an action was undone, or done, undone and redone.
    std::string hash();
    bool grabs() const { return grab_.has_value(); }

    /// What the user should know, one line each, since the last call.
    std::vector<std::string> take_notes();
    /// What was last written to a file, by the action Saved.
    struct SavedFile {
        std::filesystem::path file;
        FileTextPtr text;
        Json json;  ///< of the document at that time
    };
    const std::optional<SavedFile>& saved() const { return saved_; }

  private:
    Stage() = default;
    Result<void> act(const ChangeScene& action);
    Result<void> act(const Rename& action);
    Result<void> act(const Cut& action);
    Result<void> act(const Grab& action);
    Result<void> act(const MoveGrab& action);
    Result<void> act(const Release& action);
    Result<void> act(const Reset& action);
    Result<void> act(const Seek& action);
    Result<void> act(const Undo& action);
    Result<void> act(const Redo& action);
    Result<void> act(const UndoSetting& action);
    Result<void> act(const UseBackend& action);
    Result<void> act(const Saved& action);
    Result<void> act(const Advance& action);

    MomentPtr moment();
    /// Brings back document and world.
    Result<void> go_to(const Moment& moment);
    Result<void> go_back(const History::Return& back);
    /// Makes the world follow the document, and begins a branch if that changes it.
    Result<void> follow_document();
    Result<void> follow(DocumentPtr next);
    /// Carries out `change` as an undo step: keeps the moment before it, which is dropped if the change fails.
    Result<void> as_step(const std::string& label, std::uint64_t gesture, const std::function<Result<void>()>& change);
    /// A pull does not go on after a jump to another moment. The next step then begins a branch, because the recorded
    /// frames that follow were pulled.
    void let_go();
    Result<ClothId> cloth_called(const std::string& name) const;
    void begin_branch();
    void record();
    Result<void> recover();
    Result<void> move_to(const Options& options, const Checkpoint& state);

    StageOptions options_;
    DocumentPtr document_, followed_;
    std::unique_ptr<SceneWorld> world_;
    History history_;
    Timeline timeline_;
    Lineage lineage_;
    std::uint64_t next_branch_ = 1;
    std::optional<SavedFile> saved_;
    std::optional<GrabId> grab_;
    bool let_go_ = false;          ///< a jump has ended a pull
    std::size_t notes_taken_ = 0;  ///< of the world
    std::vector<std::string> notes_;
};

}  // namespace weft::editor
