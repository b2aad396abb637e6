// Legends of overlays over the view.
#pragma once

#include "editor/ui/ui.h"
#include "view/legend.h"

#include <span>

namespace weft::editor {

/// Draws the legends below one another on a dark backdrop, in the lower left corner of `view`. In the resolution of the
/// panels, so that they can be read while the view is drawn in a lower one. Leaves out the last ones if there is no
/// room.
void show_legends(Ui& ui, const ImRect& view, std::span<const Legend> legends);

}  // namespace weft::editor
