// User input of a window as plain values, in the order in which it came.
#pragma once

#include <weft/vector.h>

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace weft::render {

/// A key, named after its label on an American keyboard.
enum class Key : std::uint8_t {
    none,  ///< a key without a name here
    // clang-format off
    a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z,
    digit_0, digit_1, digit_2, digit_3, digit_4, digit_5, digit_6, digit_7, digit_8, digit_9,
    f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12,
    apostrophe, comma, minus, period, slash, semicolon, equal, left_bracket, backslash, right_bracket, grave_accent,
    pad_0, pad_1, pad_2, pad_3, pad_4, pad_5, pad_6, pad_7, pad_8, pad_9,
    pad_decimal, pad_divide, pad_multiply, pad_subtract, pad_add, pad_equal, space,
    // Up to here: keys that type a character, and function keys.
    pad_enter, enter, escape, tab, backspace, insert, delete_key,
    left, right, up, down, page_up, page_down, home, end,
    caps_lock, scroll_lock, num_lock, print_screen, pause, menu,
    left_shift, left_control, left_alt, left_super, right_shift, right_control, right_alt, right_super,
    // clang-format on
    count
};

constexpr bool is_modifier(Key key) {
    return key >= Key::left_shift && key <= Key::right_super;
}
/// Whether the key types a character unless Ctrl, Alt or Super is held.
constexpr bool is_printable(Key key) {
    return (key >= Key::a && key <= Key::digit_9) || (key >= Key::apostrophe && key <= Key::space);
}

struct Modifiers {
    bool shift = false, control = false, alt = false, super = false;
    friend bool operator==(const Modifiers&, const Modifiers&) = default;
};

enum class PointerButton : std::uint8_t { left, right, middle, fourth, fifth };

// Lengths in units of the window system, usually pixels, from the window's upper left corner; x to the right, y down.

struct PointerMoved {
    Vec2 to;
};
/// The pointer has left the window. Another PointerMoved follows when it comes back.
struct PointerLeft {};
struct ButtonChanged {
    PointerButton button{};
    bool down = false;
    Vec2 at = {};
    Modifiers modifiers = {};
};
struct WheelTurned {
    Vec2 by;  ///< notches; y positive away from the user, x positive to the left
};
struct KeyChanged {
    Key key = Key::none;    ///< by its place on the keyboard: for keys that steer a camera
    Key label = Key::none;  ///< by its label in the user's layout: for shortcuts
    bool down = false;
    bool repeated = false;  ///< it was down already: the system repeats keys that are held
    Modifiers modifiers = {};
};
struct TextTyped {
    char32_t character = 0;
};
struct FocusChanged {
    bool focused = false;  ///< whether keys go to this window
};
struct FilesDropped {
    std::vector<std::string> paths;
};
/// The scale that the system asks for: 1 for 96 pixels per inch.
struct ScaleChanged {
    float scale = 1;
};
struct Resized {
    std::uint32_t width = 0, height = 0;  ///< pixels
    bool minimized = false;
};
/// The system has lost what was drawn in the window.
struct Exposed {};
struct CloseRequested {};

using WindowChange = std::variant<PointerMoved, PointerLeft, ButtonChanged, WheelTurned, KeyChanged, TextTyped,
                                  FocusChanged, FilesDropped, ScaleChanged, Resized, Exposed, CloseRequested>;

struct WindowEvent {
    double time = 0;  ///< s, when the program got it; on the clock of Display::now()
    WindowChange what;
};

enum class CursorShape : std::uint8_t { arrow, text, crosshair, hand, resize_x, resize_y, resize_both };

}  // namespace weft::render
