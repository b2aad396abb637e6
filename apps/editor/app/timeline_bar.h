// The bar of recorded frames below the view.
#pragma once

#include "editor/app/session.h"

namespace weft::editor {

/// Height in pixels.
float timeline_height(const Ui& ui);

/// Draws the bar. Dragging over it shows recorded frames; frames that a change has made stale are hatched.
void show_timeline(Ui& ui, Session& session);

}  // namespace weft::editor
