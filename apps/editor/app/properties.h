// The panel of properties: every value that the parameter tables know about the selected object.
#pragma once

#include "editor/app/session.h"

#include <map>
#include <string>

namespace weft::editor {

class Properties {
  public:
    /// Draws the rows of the selected object into the current window.
    void show(Ui& ui, Session& session);

  private:
    void object(Ui& ui, Session& session, const std::string& place, int depth);
    void list(Ui& ui, Session& session, const std::string& place, const std::string& label, int depth);
    bool open(Ui& ui, const std::string& place, const std::string& label, bool at_first);

    std::map<std::string, bool> open_;  ///< sections, by the pattern of their place
};

}  // namespace weft::editor
