// The list of objects: select, rename, hide, lock, and buttons that add objects.
#pragma once

#include "editor/app/session.h"

#include <functional>
#include <set>
#include <string>
#include <string_view>

namespace weft::editor {

/// Objects that the view does not draw, and that the pointer does not pick. Not part of the scene.
struct ViewMarks {
    std::set<std::string> hidden, locked;  ///< names of cloths and colliders
};

class Cards {
  public:
    /// `add`: called with the name of an addable object.
    void show(Ui& ui, Session& session, ViewMarks& marks, const std::function<void(std::string_view)>& add);
    /// Opens the name of the selected object for typing.
    void rename_selected() { rename_ = true; }

  private:
    void add_buttons(Ui& ui, const std::function<void(std::string_view)>& add);
    void group(Ui& ui, Session& session, ViewMarks& marks, const char* label, const std::string& list);
    void card(Ui& ui, Session& session, ViewMarks* marks, const std::string& place);

    bool rename_ = false, more_ = false;
    std::string renaming_, name_;  ///< place, and the text so far
};

}  // namespace weft::editor
