// Buttons, flags, choices, texts, sections and notes.
#pragma once

#include "editor/ui/widgets/field.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace weft::editor {

struct ButtonStyle {
    Icon icon = Icon::none;
    std::string_view text = {};      ///< empty: only the icon
    std::string_view what = {};      ///< for the tooltip
    std::string_view shortcut = {};  ///< for the tooltip: "Ctrl+Z"
    bool chosen = false;             ///< what it stands for is on: filled, and with a line below
    bool primary = false;            ///< the action that most users want
    bool flat = false;               ///< no background until the pointer is on it
    bool left = false;               ///< content at the left end: a row of a list
    bool enabled = true;
    float width = 0;  ///< pixels; 0: as the content needs
};
/// Whether it was pressed: by the mouse, Space or Enter.
bool button(Ui& ui, std::string_view name, const ButtonStyle& style);
/// An area without content that can be pressed like a button; what is drawn over it afterwards is its content.
bool area_button(Ui& ui, std::string_view name, ImVec2 size, std::string_view value, std::string_view what);
/// The width of such a button in pixels.
float button_width(const Ui& ui, const ButtonStyle& style);

/// On or off. Space, Enter and a click change it.
Change flag(Ui& ui, const Field& field, bool& value, std::optional<bool> usual = {});

/// A set of numbers from 0 to 31 as the bits of a number, shown as boxes. A click on a box changes it. Arrow keys move
/// between boxes, Space and Enter change one.
Change bits(Ui& ui, const Field& field, std::uint32_t& value, std::optional<std::uint32_t> usual = {});

/// One of several names. Opens a list; the arrow keys left and right change it at once. `whats`: one line about each
/// name, beside it in the list and in the tooltip; empty or as many.
Change choice(Ui& ui, const Field& field, std::size_t& value, std::span<const std::string_view> names,
              std::optional<std::size_t> usual = {}, std::span<const std::string_view> whats = {});

/// A line of text. `finished` at Enter, Tab or a click elsewhere; Esc takes the typing back. `hint`: shown while it is
/// empty.
Change text(Ui& ui, const Field& field, std::string& value, std::string_view hint = {});

/// A heading that opens and closes what follows. Returns whether that is open.
bool section(Ui& ui, std::string_view name, std::string_view label, bool& open, Icon icon = Icon::none);

enum class Note { info, good, warning, error };
/// A message with an icon, wrapped.
void note(Ui& ui, std::string_view name, Note kind, std::string_view text);

/// A bar from 0 to 1; below 0: how much is left is not known. Returns whether the user pressed its cancel button.
bool progress(Ui& ui, std::string_view name, float done, std::string_view text, bool can_cancel = true);

}  // namespace weft::editor
