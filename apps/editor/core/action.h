// What a user does, as data. The same list is undo history, autosave, recorded session and script.
#pragma once

#include "editor/core/document.h"

#include <weft/result.h>
#include <weft/scene.h>
#include <weft/vector.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace weft::editor {

/// Changes the document. The running cloth goes on with the new values; what must be built again starts again.
struct ChangeScene {
    std::string label = {};  ///< of the undo step, such as `Density of sheet`
    std::vector<Edit> edits = {};
    /// Changes with the same number, other than 0, that follow one another are one undo step: a drag of a slider.
    std::uint64_t gesture = 0;
    friend bool operator==(const ChangeScene&, const ChangeScene&) = default;
};
/// Renames a cloth or a collider and what refers to it. It keeps moving.
struct Rename {
    std::string place = {};  ///< `/cloths/0` or `/colliders/2`
    std::string name = {};
    friend bool operator==(const Rename&, const Rename&) = default;
};
/// Cuts a cloth along a path on it. Part of the state, not of the document.
struct Cut {
    std::string cloth = {};
    std::vector<Vec3> points = {};  ///< m
    bool at_start = false;          ///< the path lies on the cloth as it starts; false: as it is now
    friend bool operator==(const Cut&, const Cut&) = default;
};
/// Begins to pull a point of a cloth.
struct Grab {
    std::string cloth = {};
    MeshPoint point = {};
    Vec3 to = {};         ///< m
    float max_force = 0;  ///< N
    friend bool operator==(const Grab&, const Grab&) = default;
};
struct MoveGrab {
    Vec3 to = {};  ///< m
    friend bool operator==(const MoveGrab&, const MoveGrab&) = default;
};
struct Release {
    friend bool operator==(const Release&, const Release&) = default;
};
/// Goes to frame 0 of the document as it is now.
struct Reset {
    friend bool operator==(const Reset&, const Reset&) = default;
};
/// Goes to a recorded frame.
struct Seek {
    std::uint64_t frame = 0;
    friend bool operator==(const Seek&, const Seek&) = default;
};
struct Undo {
    friend bool operator==(const Undo&, const Undo&) = default;
};
struct Redo {
    friend bool operator==(const Redo&, const Redo&) = default;
};
/// Takes back the settings of one undo step and leaves the cloth and later settings.
struct UndoSetting {
    std::uint64_t step = 0;  ///< number of the step (History)
    friend bool operator==(const UndoSetting&, const UndoSetting&) = default;
};
/// Goes on with the same state on another backend.
struct UseBackend {
    std::string backend = "cpu";
    std::uint32_t threads = 1;
    friend bool operator==(const UseBackend&, const UseBackend&) = default;
};
/// The document as it is now has been written to a file, which holds the text. Not an undo step.
struct Saved {
    std::string file = {};  ///< an absolute path
    std::string text = {};
    friend bool operator==(const Saved&, const Saved&) = default;
};
/// Advances by frames. In a log the frames between two actions follow from `at`.
struct Advance {
    std::uint64_t frames = 1;
    friend bool operator==(const Advance&, const Advance&) = default;
};

using Action = std::variant<ChangeScene, Rename, Cut, Grab, MoveGrab, Release, Reset, Seek, Undo, Redo, UndoSetting,
                            UseBackend, Saved, Advance>;

/// An action and the frame at which it acts: before the next frame, when so many frames are done.
struct TimedAction {
    std::uint64_t at = 0;
    Action action;
    friend bool operator==(const TimedAction&, const TimedAction&) = default;
};

/// One line of a log, without the line's end: `{"at":80,"do":"change","edits":[…]}`.
std::string to_line(const TimedAction& action);
/// `at` is empty if the line does not give it. Errors name the key.
Result<std::pair<std::optional<std::uint64_t>, Action>> action_from(const Json& line);

/// The name of the action's kind in a log: `change`, `cut`, `undo`.
std::string_view kind_of(const Action& action);

}  // namespace weft::editor
