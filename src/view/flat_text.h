// Text as triangles.
#pragma once

#include "base/image.h"
#include "render/drawing.h"

#include <span>
#include <string_view>
#include <vector>

namespace weft {

/// Width of printable ASCII at size 1: a capital letter is 7 high, a line 12.
float text_width(std::string_view text);

/// `x`, `y`: the upper left corner, in pixels. `size` in pixels per unit; integers keep letters sharp. Other characters
/// than ASCII become '?'.
void draw_text(std::string_view text, float x, float y, float size, Vec4 color, std::vector<render::FlatVertex>& flat);

/// Corners from upper left to lower right.
void draw_rectangle(float left, float top, float right, float bottom, Vec4 color,
                    std::vector<render::FlatVertex>& flat);
/// From `first` at its left side to `last` at its right.
void draw_gradient(float left, float top, float right, float bottom, Vec4 first, Vec4 last,
                   std::vector<render::FlatVertex>& flat);

/// Draws triangles onto an opaque sRGB image. What lies outside it is left out.
void draw_onto(Image8& image, std::span<const render::FlatVertex> flat);

}  // namespace weft
