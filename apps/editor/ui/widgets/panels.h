// Splitters between panels, and plots.
#pragma once

#include "editor/ui/ui.h"

#include <span>
#include <string_view>

namespace weft::editor {

enum class SplitAxis {
    x,  ///< panels side by side
    y,  ///< one above the other
};

/// A bar between two panels, at ImGui's cursor. `size`: of the panel before it, in pixels at 100 %; `after`: the panel
/// behind it has that size. Drag it, or move it by arrow keys. Returns whether the size has changed.
bool splitter(Ui& ui, std::string_view name, SplitAxis axis, float length, float& size, float least, float most,
              bool after = false);
/// Its thickness in pixels.
float splitter_width(const Ui& ui);

struct PlotStyle {
    std::string_view label = {}, unit = {};
    float height = 48;   ///< pixels at 100 %
    double seconds = 0;  ///< that the values span; 0: not told
    bool from_zero = true;
};
/// A line through values over time, the newest at the right, with the last value and the extremes as text. Values that
/// are not finite are gaps.
void plot(Ui& ui, std::string_view name, std::span<const float> values, const PlotStyle& style);

}  // namespace weft::editor
