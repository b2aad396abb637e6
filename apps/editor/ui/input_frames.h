// Divides a window's events into frames of the user interface, so that slow frames lose nothing.
//
// ImGui compares the state of buttons and keys from frame to frame. A button that went down and up between two frames
// would never have been pressed. So a frame gets at most one change of each button and key, and the rest waits for the
// next frames, which follow at once.
#pragma once

#include "render/window_events.h"

#include <bitset>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace weft::editor {

using render::Key;
using render::Modifiers;
using render::PointerButton;

/// The user input of one frame: the state at its end, and what happened in it.
struct InputFrame {
    double time = 0;              ///< s: when its last event came, or now if nothing is left
    std::optional<Vec2> pointer;  ///< pixels; nothing while it is outside the window
    std::bitset<5> buttons;       ///< down, by PointerButton
    Vec2 wheel;                   ///< notches in this frame
    bool focused = true;
    std::bitset<static_cast<std::size_t>(Key::count)> down;        ///< keys by their place
    std::bitset<static_cast<std::size_t>(Key::count)> label_down;  ///< keys by their label
    struct Press {
        Key key = Key::none, label = Key::none;
        bool down = false, repeated = false;
        Modifiers modifiers = {};
    };
    std::vector<Press> keys;              ///< changes of keys in this frame, in order
    std::u32string text;                  ///< typed in this frame
    std::vector<std::string> files = {};  ///< dropped in this frame, at the pointer
    std::uint64_t changes = 0;            ///< of keys and buttons so far, in all frames

    Modifiers modifiers() const;
};

class InputFrames {
  public:
    /// Appends events. `scale`: pixels per unit of their positions.
    void add(const std::vector<render::WindowEvent>& events, float scale = 1);
    bool pending() const { return !waiting_.empty(); }
    /// The next frame. `now`: s, on the clock of the events. `typing`: a text field has the keyboard, so that keys that
    /// type a character need no frame of their own. `hold`: takes nothing; keys would go to the wrong widget.
    InputFrame next(double now, bool typing = false, bool hold = false);

  private:
    struct Changes;
    bool take(const render::WindowChange& what, Changes& changes, bool typing);

    std::deque<render::WindowEvent> waiting_;
    InputFrame state_;
};

}  // namespace weft::editor
