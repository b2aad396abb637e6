// The part of Stage that pulls cloth.
#include "editor/core/stage.h"

namespace weft::editor {
Result<void> Stage::act(const Grab&) {
    return Error{"grab", "todo"};
}
Result<void> Stage::act(const MoveGrab&) {
    return Error{"grab", "todo"};
}
Result<void> Stage::act(const Release&) {
    return Error{"grab", "todo"};
}
}  // namespace weft::editor
