// Colors, fonts and lengths of the user interface at a scale.
#pragma once

#include "editor/ui/icons.h"
#include "editor/ui/palette.h"

namespace weft::editor {

inline constexpr float least_scale = 0.75f, most_scale = 3;

struct Theme {
    Appearance appearance = Appearance::dark;
    float scale = 1;  ///< least_scale…most_scale
    Palette colors;
    ImFont* body = nullptr;    ///< with icons
    ImFont* strong = nullptr;  ///< headings
    ImFont* small = nullptr;   ///< notes
    float icon_side = 18;      ///< pixels

    /// Pixels of a length at 100 %, rounded to whole ones but at least one.
    float px(float length) const;
    ImU32 color(ImVec4 of) const { return ImGui::GetColorU32(of); }
};

/// Draws the fonts for this scale into the atlas and sets ImGui's style. The atlas must then be uploaded again.
Theme make_theme(ImGuiContext& context, Appearance appearance, float scale);

}  // namespace weft::editor
