// The handles of the selected object in the view: drags of the pointer, and numbers that are typed instead.
#pragma once

#include "editor/app/session.h"
#include "editor/tools/gizmo.h"

#include <optional>
#include <string>
#include <vector>

namespace weft::editor {

class GizmoTool {
  public:
    /// Nothing: the tool has no handles.
    std::optional<GizmoKind> kind;
    GizmoAxes axes = GizmoAxes::world;

    /// Whether a handle is dragged, or has been chosen and waits for a number.
    bool active() const { return drag_.has_value(); }
    bool dragged() const { return drag_ && held_; }

    /// Begins a drag if the pointer is on a handle. Ends a number that is being typed.
    bool press(Session& session, const Projection& view, Vec2 pointer);
    void move(Session& session, Vec2 pointer, bool snap);
    /// The button is up. A handle that was clicked and not moved waits for a number.
    void release(Session& session, Vec2 pointer, bool snap, bool clicked);
    /// Takes the drag or the number back. Whether there was one.
    bool cancel(Session& session);
    /// Keeps what is shown.
    void finish(Session& session);

    /// Chooses a handle without the pointer: of the x axis, or the center.
    void choose(Session& session, const Projection& view);
    /// Takes the keys of this frame: numbers, Backspace, Enter, and before a number X, Y or Z for another axis.
    /// Returns whether one of them was of use.
    bool type(const Ui& ui, Session& session);

    /// Draws the handles and the amount. `origin`: of the view in the window, pixels. `pointer`: nothing if it is not
    /// over the view.
    void draw(Ui& ui, const Session& session, const Projection& view, Vec2 origin, std::optional<Vec2> pointer);

  private:
    std::optional<GizmoPlace> place_of_selected(const Session& session) const;
    std::optional<Gizmo> handles(const Session& session, const Projection& view) const;
    void start(const Gizmo& gizmo, GizmoHandle handle, Vec2 pointer, Session& session, bool held);
    void change(Session& session, const GizmoChange& change, Change phase);
    void add_scales(const Session& session, const GizmoChange& change, std::vector<Edit>& edits) const;
    GizmoChange unchanged() const;
    void follow_text(Session& session);
    std::string label() const;
    void draw_label(Ui& ui, ImVec2 at) const;

    std::optional<GizmoDrag> drag_;
    std::optional<Gizmo> gizmo_;  ///< at the start
    std::string place_;           ///< of the object
    GizmoChange shown_;           ///< that the object has now
    GizmoPlace drag_place_;       ///< of the object at the start
    bool held_ = false, snap_ = false;
    bool touched_ = false;  ///< the object was changed since the start
    Vec2 pointer_;
    std::string text_;         ///< that is typed
    bool understood_ = false;  ///< whether the text is as many numbers as the handle needs
};

/// The numbers in a text such as `0.25`, `5 mm`, `0.1, 0.2` or `1; 2; 3`; empty if it is not `count` numbers.
std::vector<double> typed_numbers(const std::string& text, std::string_view unit, std::size_t count);

}  // namespace weft::editor
