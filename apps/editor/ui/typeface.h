// The typeface that is part of the program: Inter, by The Inter Project Authors, SIL Open Font License 1.1.
#pragma once

#include <cstddef>
#include <span>

namespace weft::editor {

inline constexpr const char* typeface_notice =
    "Inter, copyright The Inter Project Authors (https://github.com/rsms/inter), SIL Open Font License 1.1";

enum class TypefaceStyle { regular, strong };

/// An OpenType file.
std::span<const std::byte> typeface(TypefaceStyle style);

/// Lengths of a typeface in ems.
struct TypefaceMetrics {
    float line = 1.2f;       ///< from the highest to the lowest point of a line
    float x_height = 0.55f;  ///< height of small letters
};
TypefaceMetrics metrics_of(std::span<const std::byte> file);

}  // namespace weft::editor
