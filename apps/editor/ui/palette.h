// Colors of the user interface, sRGB-encoded.
#pragma once

#include "editor/ui/dear_imgui.h"

namespace weft::editor {

enum class Appearance { dark, light };

struct Palette {
    ImVec4 background;  ///< around panels
    ImVec4 panel, header, popup;
    ImVec4 field, field_hovered, field_active;  ///< what can be edited or pressed
    ImVec4 fill;                                ///< the part of a field that shows its value
    ImVec4 border, line;                        ///< of panels; of fields and focus-independent marks
    ImVec4 text, muted;                         ///< muted: labels, units, hints
    ImVec4 accent, on_accent;                   ///< chosen things, and text on them
    ImVec4 accent_text;                         ///< marks in the accent's color on a panel
    ImVec4 focus;                               ///< ring around what has the keyboard
    ImVec4 good, warning, error;                ///< text and icons on a panel
};

const Palette& palette(Appearance appearance);

/// Contrast ratio of WCAG 2.1, 1…21, of opaque colors.
float contrast(ImVec4 a, ImVec4 b);

ImVec4 with_alpha(ImVec4 color, float alpha);
/// A color between two.
ImVec4 between(ImVec4 a, ImVec4 b, float t);

}  // namespace weft::editor
