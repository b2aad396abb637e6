// User input of a window since the last query, as plain values.
#pragma once

#include <weft/vector.h>

#include <bitset>

namespace weft::render {

/// Keys by their labels on an American keyboard, letters as capitals: held['W'].
using Keys = std::bitset<128>;
inline constexpr char escape_key = 27;

struct WindowInput {
    // Lengths in units of the window system, usually pixels; x to the right, y down.
    Vec2 pointer;              ///< from the window's upper left corner
    Vec2 left, middle, right;  ///< movement of the pointer while that button was held
    float width = 1, height = 1;
    float scroll = 0;  ///< notches of the wheel, positive away from the user
    bool shift = false;
    Keys held;          ///< down now
    Keys pressed;       ///< pressed since the last query, even if released again
    float seconds = 0;  ///< since the last query
};

}  // namespace weft::render
