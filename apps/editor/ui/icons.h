// Icons: characters of the private use area, which Fonts draws into the atlas.
#pragma once

#include "base/image.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace weft::editor {

enum class Icon : std::uint16_t {
    none,
#define WEFT_ICON(name, path) name,
#include "editor/ui/icons.def"
#undef WEFT_ICON
    count
};

/// The character that shows the icon.
constexpr char16_t character_of(Icon icon) {
    return static_cast<char16_t>(0xE000 + static_cast<int>(icon));
}
/// The same as UTF-8; empty for `none`.
std::string text_of(Icon icon);
std::string_view name_of(Icon icon);

/// Coverage of an icon drawn on a square of `side` pixels, row by row from the top.
std::vector<std::uint8_t> draw_icon(Icon icon, std::uint32_t side);

}  // namespace weft::editor
