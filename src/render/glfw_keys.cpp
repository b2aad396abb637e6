#include "render/glfw_keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>
#include <string_view>

namespace weft::render {
namespace {

constexpr Key after(Key first, int steps) {
    return static_cast<Key>(static_cast<int>(first) + steps);
}

struct Pair {
    int glfw;
    Key key;
};

// All keys but those in rows.
constexpr std::array single_keys = {Pair{GLFW_KEY_APOSTROPHE, Key::apostrophe},
                                    Pair{GLFW_KEY_COMMA, Key::comma},
                                    Pair{GLFW_KEY_MINUS, Key::minus},
                                    Pair{GLFW_KEY_PERIOD, Key::period},
                                    Pair{GLFW_KEY_SLASH, Key::slash},
                                    Pair{GLFW_KEY_SEMICOLON, Key::semicolon},
                                    Pair{GLFW_KEY_EQUAL, Key::equal},
                                    Pair{GLFW_KEY_LEFT_BRACKET, Key::left_bracket},
                                    Pair{GLFW_KEY_BACKSLASH, Key::backslash},
                                    Pair{GLFW_KEY_RIGHT_BRACKET, Key::right_bracket},
                                    Pair{GLFW_KEY_GRAVE_ACCENT, Key::grave_accent},
                                    Pair{GLFW_KEY_KP_DECIMAL, Key::pad_decimal},
                                    Pair{GLFW_KEY_KP_DIVIDE, Key::pad_divide},
                                    Pair{GLFW_KEY_KP_MULTIPLY, Key::pad_multiply},
                                    Pair{GLFW_KEY_KP_SUBTRACT, Key::pad_subtract},
                                    Pair{GLFW_KEY_KP_ADD, Key::pad_add},
                                    Pair{GLFW_KEY_KP_EQUAL, Key::pad_equal},
                                    Pair{GLFW_KEY_SPACE, Key::space},
                                    Pair{GLFW_KEY_KP_ENTER, Key::pad_enter},
                                    Pair{GLFW_KEY_ENTER, Key::enter},
                                    Pair{GLFW_KEY_ESCAPE, Key::escape},
                                    Pair{GLFW_KEY_TAB, Key::tab},
                                    Pair{GLFW_KEY_BACKSPACE, Key::backspace},
                                    Pair{GLFW_KEY_INSERT, Key::insert},
                                    Pair{GLFW_KEY_DELETE, Key::delete_key},
                                    Pair{GLFW_KEY_LEFT, Key::left},
                                    Pair{GLFW_KEY_RIGHT, Key::right},
                                    Pair{GLFW_KEY_UP, Key::up},
                                    Pair{GLFW_KEY_DOWN, Key::down},
                                    Pair{GLFW_KEY_PAGE_UP, Key::page_up},
                                    Pair{GLFW_KEY_PAGE_DOWN, Key::page_down},
                                    Pair{GLFW_KEY_HOME, Key::home},
                                    Pair{GLFW_KEY_END, Key::end},
                                    Pair{GLFW_KEY_CAPS_LOCK, Key::caps_lock},
                                    Pair{GLFW_KEY_SCROLL_LOCK, Key::scroll_lock},
                                    Pair{GLFW_KEY_NUM_LOCK, Key::num_lock},
                                    Pair{GLFW_KEY_PRINT_SCREEN, Key::print_screen},
                                    Pair{GLFW_KEY_PAUSE, Key::pause},
                                    Pair{GLFW_KEY_MENU, Key::menu}};

// The key that types this character on an American keyboard.
Key key_of_character(char character) {
    if (character >= 'a' && character <= 'z') return after(Key::a, character - 'a');
    if (character >= 'A' && character <= 'Z') return after(Key::a, character - 'A');
    if (character >= '0' && character <= '9') return after(Key::digit_0, character - '0');
    // GLFW's codes of punctuation are the characters themselves.
    for (const Pair& one : single_keys)
        if (one.glfw == character && is_printable(one.key)) return one.key;
    return Key::none;
}

}  // namespace

Key key_of(int glfw_key) {
    const auto in_row = [&](int first, int last) { return glfw_key >= first && glfw_key <= last; };
    if (in_row(GLFW_KEY_A, GLFW_KEY_Z)) return after(Key::a, glfw_key - GLFW_KEY_A);
    if (in_row(GLFW_KEY_0, GLFW_KEY_9)) return after(Key::digit_0, glfw_key - GLFW_KEY_0);
    if (in_row(GLFW_KEY_F1, GLFW_KEY_F12)) return after(Key::f1, glfw_key - GLFW_KEY_F1);
    if (in_row(GLFW_KEY_KP_0, GLFW_KEY_KP_9)) return after(Key::pad_0, glfw_key - GLFW_KEY_KP_0);
    if (in_row(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SUPER))
        return after(Key::left_shift, glfw_key - GLFW_KEY_LEFT_SHIFT);
    for (const Pair& one : single_keys)
        if (one.glfw == glfw_key) return one.key;
    return Key::none;
}

Key label_of(int glfw_key, int scancode) {
    const Key key = key_of(glfw_key);
    const bool has_label = glfw_key == GLFW_KEY_UNKNOWN || (is_printable(key) && key < Key::pad_0);
    if (!has_label) return key;
    const char* name = glfwGetKeyName(glfw_key, scancode);
    if (!name || std::string_view(name).size() != 1) return key;  // a letter of another script: shortcuts by place
    const Key label = key_of_character(name[0]);
    return label == Key::none ? key : label;
}

Modifiers modifiers_of(int bits, Key key, bool down) {
    Modifiers now{(bits & GLFW_MOD_SHIFT) != 0, (bits & GLFW_MOD_CONTROL) != 0, (bits & GLFW_MOD_ALT) != 0,
                  (bits & GLFW_MOD_SUPER) != 0};
    // X11 reports the modifiers as they were before the key.
    if (key == Key::left_shift || key == Key::right_shift) now.shift = down;
    if (key == Key::left_control || key == Key::right_control) now.control = down;
    if (key == Key::left_alt || key == Key::right_alt) now.alt = down;
    if (key == Key::left_super || key == Key::right_super) now.super = down;
    return now;
}

}  // namespace weft::render
