// The 3-D view: camera, picking, and the tools of the pointer.
#pragma once

#include "editor/app/anchor_tool.h"
#include "editor/app/brush_tool.h"
#include "editor/app/gizmo_tool.h"
#include "editor/app/pick_trees.h"
#include "editor/app/session.h"
#include "editor/app/vertex_selector.h"
#include "editor/app/view_input.h"
#include "editor/tools/camera_moves.h"
#include "editor/tools/drag_plane.h"
#include "editor/ui/ui_renderer.h"

#include <bitset>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace weft::editor {

/// What the left button does in the view.
enum class Tool : std::uint8_t {
    hand,    ///< pulls cloth and moves colliders
    select,  ///< chooses vertices by click and box
    move,
    turn,
    scale,
    cut,
    lasso,    ///< chooses vertices
    brush,    ///< paints pins, groups and factors
    anchors,  ///< pins that are applied together
};

struct ViewSettings {
    Tool tool = Tool::hand;
    GizmoAxes axes = GizmoAxes::world;
    FlyKeys keys = FlyKeys::usual;
    bool fly_always = false;  ///< also while the right button is up
    float pull_force = 5;     ///< N, largest
};

class ViewPanel {
  public:
    ViewSettings settings;
    Camera camera;
    VertexSelector selector;
    BrushTool brush;
    AnchorTool anchors;
    bool has_keys = true;  ///< false while a dialog has the keyboard

    /// Draws the view's image over the rest of the current window and reacts to the pointer. `image_size`: pixels of
    /// the image; zero: there is none yet.
    void show(Ui& ui, Session& session, const ViewMarks& marks, UiImage image, Vec2 image_size);

    Vec2 size() const { return size_; }  ///< pixels
    /// Whether the camera or something under the pointer moves.
    bool moving() const { return moving_; }

    void frame_all(const Picture& picture);
    void frame_selected(const Picture& picture, const Session& session);
    void look_from(ViewFrom side);

    /// Colors of painted values, while the brush is the tool.
    std::shared_ptr<const ClothPaint> paint(const Session& session, const Picture& picture) {
        return settings.tool == Tool::brush ? brush.colors(session, picture) : nullptr;
    }
    /// Ends what the pointer does, as Esc does. Whether there was something.
    bool cancel(Session& session);
    /// Chooses a handle of the selected object, for an amount that is typed.
    void choose_handle(Session& session);
    /// Gives the keys of this frame to the handle that is dragged or chosen. Returns whether it has used them.
    bool type(const Ui& ui, Session& session);

  private:
    enum class Gesture : std::uint8_t { none, orbit, look, pan, pull, carry, gizmo, box, lasso, paint, stroke };
    using Input = ViewInput;
    void move_camera(Ui& ui, const Picture& picture, const ViewMarks& marks, const Input& input);
    void fly(Ui& ui, const Picture& picture, const Input& input);
    void begin_left(Session& session, const ViewMarks& marks, const Input& input);
    void drag(Session& session, const Input& input);
    void end(Session& session, const ViewMarks& marks, const Input& input);
    bool end_touch(const ToolInput& in);
    void cut(Session& session, const ViewMarks& marks, const Input& input);
    void note_camera(Ui& ui, const ImRect& box) const;
    void set_gizmo();
    void draw_marks(Ui& ui, const Session& session, const Input& input);
    void draw_touch(Ui& ui, Session& session, const ViewMarks& marks, const Input& input);
    Bounds bounds_of_selected(const Picture& picture, const Session& session) const;
    void go_to(const Camera& to);
    std::optional<std::size_t> selected_cloth(const Picture& picture, const Session& session) const;

    PickTrees trees_;
    Vec2 origin_, size_{1, 1};  // pixels
    Gesture gesture_ = Gesture::none;
    bool moving_ = false, clicked_ = false;
    Vec2 start_, last_;  // of the pointer, in the view
    Pick pick_;          // where the gesture began
    std::string picked_place_;
    std::optional<DragPlane> plane_;
    std::bitset<static_cast<std::size_t>(Key::count)> fly_keys_;  // pressed without Control and the like
    std::optional<double> pan_depth_;                             // m, of what is under the pointer
    Vec3 carried_from_;
    GizmoTool gizmo_;
    std::vector<Vec2> stroke_;
    std::optional<CameraTransition> transition_;
    double transition_since_ = 0;
    double time_ = 0;
};

std::string_view name_of(Tool tool);

}  // namespace weft::editor
