// Options of the present tool, above the properties.
#pragma once

#include "editor/app/view_panel.h"

#include <string>

namespace weft::editor {

class ToolPanel {
  public:
    /// Returns false, and draws nothing, for a tool without options.
    bool show(Ui& ui, Session& session, ViewPanel& view, const Picture& picture);

  private:
    static void hand(Ui& ui, ViewPanel& view);
    void selection(Ui& ui, Session& session, ViewPanel& view, const Picture& picture);
    void groups(Ui& ui, Session& session, ViewPanel& view);
    void group_buttons(Ui& ui, Session& session, ViewPanel& view, const std::string& cloth);
    void brush(Ui& ui, Session& session, ViewPanel& view);
    void brush_numbers(Ui& ui, BrushOptions& options, const PaintKind& kind);
    void anchors(Ui& ui, Session& session, ViewPanel& view);

    std::string group_;  ///< that the buttons act on
};

}  // namespace weft::editor
