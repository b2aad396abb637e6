#include "editor/ui/input_frames.h"

#include <algorithm>

namespace weft::editor {
namespace {

constexpr std::size_t index_of(Key key) {
    return static_cast<std::size_t>(key);
}

template <class... Functions>
struct Overloaded : Functions... {
    using Functions::operator()...;
};

}  // namespace

Modifiers InputFrame::modifiers() const {
    const auto either = [&](Key left, Key right) { return down[index_of(left)] || down[index_of(right)]; };
    return {either(Key::left_shift, Key::right_shift), either(Key::left_control, Key::right_control),
            either(Key::left_alt, Key::right_alt), either(Key::left_super, Key::right_super)};
}

/// What has changed in a frame so far.
struct InputFrames::Changes {
    bool moved = false, wheel = false, text = false;
    std::bitset<5> buttons;
    std::bitset<static_cast<std::size_t>(Key::count)> keys;
    bool pressed = false;  // a key other than a modifier or, in a text field, one that types a character
    bool any_key = false;  // a press of a key other than a modifier
    bool other = false;

    bool anything() const { return moved || wheel || text || buttons.any() || keys.any() || other; }
};

void InputFrames::add(const std::vector<render::WindowEvent>& events, float scale) {
    for (render::WindowEvent event : events) {
        const auto scaled = [&](Vec2 at) { return Vec2{at.x * scale, at.y * scale}; };
        if (auto* moved = std::get_if<render::PointerMoved>(&event.what)) moved->to = scaled(moved->to);
        if (auto* button = std::get_if<render::ButtonChanged>(&event.what)) button->at = scaled(button->at);
        waiting_.push_back(std::move(event));
    }
}

// Takes the event into the frame. False if it must wait for the next one.
bool InputFrames::take(const render::WindowChange& what, Changes& changes, bool typing) {
    InputFrame& now = state_;
    return std::visit(
        Overloaded{
            // Buttons, wheel and keys act at the place where the pointer was.
            [&](const render::PointerMoved& event) {
                if (changes.buttons.any() || changes.wheel || changes.any_key || changes.text) return false;
                changes.moved |= now.pointer != event.to;
                now.pointer = event.to;
                return true;
            },
            [&](const render::PointerLeft&) {
                if (changes.anything()) return false;
                if (now.buttons.any()) return true;  // a drag goes on outside
                changes.moved = true;
                now.pointer.reset();
                return true;
            },
            // In a frame of its own place: a press finds under the pointer what the last frame showed there, and a
            // release does not cut off the last part of a drag.
            [&](const render::ButtonChanged& event) {
                const auto button = static_cast<std::size_t>(event.button);
                if (now.buttons[button] == event.down) return true;
                if (now.pointer != event.at) {
                    if (changes.anything()) return false;
                    now.pointer = event.at;
                    changes.moved = true;
                    return false;
                }
                if (changes.moved || changes.buttons.any() || changes.wheel || changes.any_key) return false;
                changes.buttons.set(button);
                now.buttons.set(button, event.down);
                return true;
            },
            [&](const render::WheelTurned& event) {
                if (changes.moved || changes.buttons.any() || changes.any_key) return false;
                changes.wheel = true;
                now.wheel = {now.wheel.x + event.by.x, now.wheel.y + event.by.y};
                return true;
            },
            [&](const render::KeyChanged& event) {
                const std::size_t key = index_of(event.key);
                if (event.repeated) {
                    now.keys.push_back({event.key, event.label, true, true, event.modifiers});
                    return true;
                }
                if (event.key == Key::none || now.down[key] == event.down) return true;
                const Modifiers held = now.modifiers();
                // Text is all that such a key does, so down and up may fall into one frame.
                const bool types = typing && is_printable(event.key) && !held.control && !held.alt && !held.super;
                if ((changes.keys[key] && !types) || changes.buttons.any() || changes.wheel) return false;
                if (is_modifier(event.key)) {
                    // It must not change what an earlier key of this frame meant.
                    if (changes.any_key || changes.text) return false;
                } else {
                    if (event.down && !types && (changes.pressed || changes.text)) return false;
                    changes.any_key |= event.down;
                    changes.pressed |= event.down && !types;
                }
                changes.keys.set(key);
                now.down.set(key, event.down);
                now.label_down.set(index_of(event.label), event.down);
                now.keys.push_back({event.key, event.label, event.down, false, event.modifiers});
                return true;
            },
            // A field inserts text before it looks at keys, so text must not follow a key that edits.
            [&](const render::TextTyped& event) {
                const bool edited = std::ranges::any_of(now.keys, [](const InputFrame::Press& one) {
                    return one.down && !is_printable(one.key) && !is_modifier(one.key);
                });
                if (edited || changes.buttons.any()) return false;
                changes.text = true;
                now.text.push_back(event.character);
                return true;
            },
            [&](const render::FocusChanged& event) {
                if (changes.anything()) return false;
                changes.other = true;
                now.focused = event.focused;
                if (event.focused) return true;
                now.down.reset();
                now.label_down.reset();
                now.buttons.reset();
                return true;
            },
            [&](const render::FilesDropped& event) {
                if (changes.buttons.any() || changes.any_key) return false;
                changes.other = true;
                now.files.insert(now.files.end(), event.paths.begin(), event.paths.end());
                return true;
            },
            [](const auto&) { return true; }},  // the window itself
        what);
}

InputFrame InputFrames::next(double now, bool typing, bool hold) {
    state_.wheel = {};
    state_.keys.clear();
    state_.text.clear();
    state_.files.clear();
    Changes changes;
    double last = state_.time;
    while (!waiting_.empty() && !hold) {
        const double time = waiting_.front().time;
        if (!take(waiting_.front().what, changes, typing)) {
            if (changes.moved) last = std::max(last, time);
            break;
        }
        last = std::max(last, time);
        const auto* key = std::get_if<render::KeyChanged>(&waiting_.front().what);
        if ((key && !key->repeated) || std::holds_alternative<render::ButtonChanged>(waiting_.front().what))
            ++state_.changes;
        waiting_.pop_front();
    }
    state_.time = waiting_.empty() ? std::max(last, now) : last;
    return state_;
}

}  // namespace weft::editor
