// Translates GLFW's codes.
#pragma once

#include "render/window_events.h"

namespace weft::render {

/// The key that has this GLFW_KEY_….
Key key_of(int glfw_key);
/// The key whose label in the user's layout is that of this key: `key_of(glfw_key)` if it has no other.
Key label_of(int glfw_key, int scancode);
/// From GLFW's modifier bits, as they are after the change of `key`.
Modifiers modifiers_of(int bits, Key key = Key::none, bool down = false);

}  // namespace weft::render
