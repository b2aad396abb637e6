// What hands did to a window since it was last asked. Plain values, for whatever makes something of them.
#pragma once

#include <weft/vector.h>

#include <bitset>

namespace weft::render {

/// Keys by what stands on them on an American keyboard, letters as capitals: held['W'].
using Keys = std::bitset<128>;
inline constexpr char escape_key = 27;

struct WindowInput {
    // Lengths in the window system's own units, which are pixels on most; x to the right, y down.
    Vec2 pointer;              ///< from the window's upper left corner
    Vec2 left, middle, right;  ///< how far the pointer went while that button was held
    float width = 1, height = 1;
    float scroll = 0;  ///< turns of the wheel by one notch, away from the hand
    bool shift = false;
    Keys held;          ///< at this moment
    Keys pressed;       ///< since it was last asked, even if not any more
    float seconds = 0;  ///< since it was last asked
};

}  // namespace weft::render
