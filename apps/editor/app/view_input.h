// The pointer over the view in one frame, and what its tools work on.
#pragma once

#include "editor/app/pick_trees.h"
#include "editor/app/session.h"
#include "editor/tools/projection.h"
#include "editor/ui/ui.h"

#include <optional>

namespace weft::editor {

struct ViewInput {
    Vec2 pointer;  ///< pixels in the view
    Vec2 moved;
    bool hovered = false;
    float wheel = 0;
    Modifiers modifiers;
    Projection view;
};

/// For a tool while it acts.
struct ToolInput {
    Session& session;
    const Picture& picture;
    PickTrees& trees;
    const ViewMarks& marks;
    const ViewInput& input;

    Pick pick_at(Vec2 pixel) const { return editor::pick_at(input.view, pixel, trees.scene(picture, marks)); }
};

/// Draws over the view's image.
struct ViewCanvas {
    ImDrawList& draw;
    const Projection& view;
    Vec2 origin;  ///< of the view in the window, pixels
    const Theme& theme;

    ImVec2 at(Vec2 pixel) const { return {origin.x + pixel.x, origin.y + pixel.y}; }
    std::optional<ImVec2> at(Vec3 point) const {
        const auto seen = view.project(point);
        if (!seen) return {};
        return at(seen->pixel);
    }
};

}  // namespace weft::editor
