// The frame of a row in a panel of properties: label, place of the control, mark of a changed value, tooltip.
#pragma once

#include "editor/ui/ui.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace weft::editor {

struct Field {
    std::string_view name;        ///< for tests, unique within its scope
    std::string_view label = {};  ///< empty: the control takes the whole row
    std::string_view what = {};   ///< one line for the tooltip
    std::string range = {};       ///< for the tooltip: "0 … 1000 N/m"
    std::string usual = {};       ///< for the tooltip: the default value as text; empty: there is none
    bool differs = false;         ///< the value is not the default: the row has a mark, which resets it
};

/// A row that has begun.
struct Row {
    ImRect control;
    bool reset = false;  ///< the user wants the default back
};

/// Draws the label and the mark at ImGui's cursor, and moves the cursor below the row.
Row begin_row(Ui& ui, const Field& field);

/// The tooltip of a row's control. `with_label`: where the label is cut off.
void field_tooltip(Ui& ui, const Item& item, const Field& field, bool with_label = false);

/// Text that ends in … where it does not fit.
void clipped_text(const ImRect& box, std::string_view text, ImU32 color, float align = 0);

/// An icon in the middle of the box.
void draw_icon(const Theme& theme, Icon icon, const ImRect& box, ImU32 color);

/// The background of something that can be edited or pressed, brighter under the pointer.
void draw_field(const Ui& ui, const Item& item, bool active);

/// A line of the tooltip in the color of hints.
void muted_text(const Ui& ui, std::string_view text);

// --- Typing into a field

struct Typed {
    bool active = false;     ///< goes on
    bool done = false;       ///< Enter, Tab, or a click elsewhere
    bool entered = false;    ///< by Enter
    bool edited = false;     ///< in this frame
    bool cancelled = false;  ///< Esc
    std::string text;
};
/// Opens the item for typing; type_into() must follow in the same frame. `at_end`: does not select the text.
void begin_typing(Ui& ui, const Item& item, std::string text, bool at_end = false);
/// The same with what was typed in this frame as text.
void begin_typing_over(Ui& ui, const Item& item);
bool is_typing(const Ui& ui, const Item& item);
/// The field while it is typed into. On Tab, moves on to the next widget.
Typed type_into(Ui& ui, const Item& item, std::string_view name, const ImRect& box, std::string_view hint = {});

}  // namespace weft::editor
