// Where the named widgets are, for tests that drive the window by mouse and keys: they aim at names and wait until the
// counter of settled frames has grown.
#pragma once

#include "editor/ui/dear_imgui.h"

#include <weft/result.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace weft::editor {

struct ProbedWidget {
    float x = 0, y = 0, width = 0, height = 0;  ///< pixels from the window's upper left corner; the visible part
    bool visible = false;                       ///< not scrolled out of sight
    bool enabled = true;
    bool focused = false;  ///< has the keyboard
    std::string value;     ///< as shown
};

class Probe {
  public:
    void begin_frame();
    /// Adds a widget of this frame under the current scopes. `box` and `clip`: in pixels.
    void add(std::string_view name, const ImRect& box, const ImRect& clip, bool enabled, bool focused,
             std::string_view value);
    void push(std::string_view scope) { scopes_.emplace_back(scope); }
    void pop() { scopes_.pop_back(); }
    /// "properties/fabric/density"
    std::string path(std::string_view name) const;

    const std::map<std::string, ProbedWidget>& widgets() const { return widgets_; }
    /// The widget of the last frame; null if there is none.
    const ProbedWidget* find(std::string_view path) const;

    std::uint64_t frames = 0;   ///< drawn
    std::uint64_t settled = 0;  ///< of these, frames after which nothing was left to do: no input, no animation
    bool idle = false;          ///< this frame is one of them
    std::uint64_t changes = 0;  ///< of keys and buttons, up to this frame
    float pointer_x = 0, pointer_y = 0;  ///< pixels; -1 while it is outside the window
    float width = 0, height = 0, scale = 1;

    std::string json() const;
    /// Replaces the file at once, so that a reader finds the old or the new content.
    Result<void> write(const std::filesystem::path& file) const;

  private:
    std::map<std::string, ProbedWidget> widgets_;
    std::vector<std::string> scopes_;
};

}  // namespace weft::editor
