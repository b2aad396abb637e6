#include "editor/ui/palette.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace weft::editor {
namespace {

ImVec4 hex(std::uint32_t rgb) {
    return ImVec4(static_cast<float>(rgb >> 16 & 255) / 255, static_cast<float>(rgb >> 8 & 255) / 255,
                  static_cast<float>(rgb & 255) / 255, 1);
}

const Palette dark_palette{
    .background = hex(0x17181b),
    .panel = hex(0x212327),
    .header = hex(0x2a2d32),
    .popup = hex(0x2a2d32),
    .field = hex(0x33373e),
    .field_hovered = hex(0x3d424a),
    .field_active = hex(0x454b55),
    .fill = hex(0x294d75),
    .border = hex(0x34373d),
    .line = hex(0x7d838d),
    .text = hex(0xe8eaed),
    .muted = hex(0xbfc4cc),
    .accent = hex(0x2f6fc4),
    .on_accent = hex(0xffffff),
    .accent_text = hex(0x79b4f5),
    .focus = hex(0x79b4f5),
    .good = hex(0x6fcf8b),
    .warning = hex(0xf2b84b),
    .error = hex(0xff8a80),
};

const Palette light_palette{
    .background = hex(0xd9dce1),
    .panel = hex(0xf6f7f9),
    .header = hex(0xe8eaee),
    .popup = hex(0xffffff),
    .field = hex(0xe3e6eb),
    .field_hovered = hex(0xd8dce3),
    .field_active = hex(0xcbd1da),
    .fill = hex(0xb3d0f2),
    .border = hex(0xcdd1d8),
    .line = hex(0x767c87),
    .text = hex(0x1a1c20),
    .muted = hex(0x4d535d),
    .accent = hex(0x1c5fb8),
    .on_accent = hex(0xffffff),
    .accent_text = hex(0x1a58ab),
    .focus = hex(0x1c5fb8),
    .good = hex(0x1b6b36),
    .warning = hex(0x7d5200),
    .error = hex(0xb3261e),
};

float luminance(ImVec4 color) {
    const auto linear = [](float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); };
    return 0.2126f * linear(color.x) + 0.7152f * linear(color.y) + 0.0722f * linear(color.z);
}

}  // namespace

const Palette& palette(Appearance appearance) {
    return appearance == Appearance::dark ? dark_palette : light_palette;
}

float contrast(ImVec4 a, ImVec4 b) {
    const float one = luminance(a), other = luminance(b);
    return (std::max(one, other) + 0.05f) / (std::min(one, other) + 0.05f);
}

ImVec4 with_alpha(ImVec4 color, float alpha) {
    return ImVec4(color.x, color.y, color.z, alpha);
}

ImVec4 between(ImVec4 a, ImVec4 b, float t) {
    return ImVec4(a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t, a.w + (b.w - a.w) * t);
}

}  // namespace weft::editor
