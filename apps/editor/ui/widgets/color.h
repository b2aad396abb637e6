// A color: swatch, value and a picker.
#pragma once

#include "editor/ui/widgets/field.h"

#include <weft/vector.h>

#include <optional>
#include <string>
#include <string_view>

namespace weft::editor {

/// `linear`: linear RGB, 0…1, as scenes have it. The user sees and types sRGB: #c04020.
Change color(Ui& ui, const Field& field, Vec3& linear, std::optional<Vec3> usual = {});

/// "#c04020" of a linear color, and back. Also knows "c04020" and "#c42".
std::string hex_of(Vec3 linear);
std::optional<Vec3> color_of(std::string_view hex);

}  // namespace weft::editor
