#include "editor/ui/typeface.h"

#include <cstdint>
#include <cstring>
#include <string_view>

namespace weft::editor {
namespace {

constexpr std::uint64_t regular_words[] = {
#include "typeface_regular_table.inc"
};
constexpr std::uint64_t strong_words[] = {
#include "typeface_semibold_table.inc"
};

// OpenType stores numbers with the most significant byte first.
std::uint32_t number_at(std::span<const std::byte> file, std::size_t at, std::size_t bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < bytes && at + i < file.size(); ++i)
        value = value << 8 | std::to_integer<std::uint32_t>(file[at + i]);
    return value;
}

int signed_at(std::span<const std::byte> file, std::size_t at) {
    return static_cast<std::int16_t>(number_at(file, at, 2));
}

// Where the table begins; 0 if there is none.
std::size_t table_at(std::span<const std::byte> file, std::string_view tag) {
    const std::uint32_t tables = number_at(file, 4, 2);
    for (std::size_t i = 0; i < tables; ++i) {
        const std::size_t entry = 12 + 16 * i;
        if (entry + 16 <= file.size() && std::memcmp(&file[entry], tag.data(), 4) == 0)
            return number_at(file, entry + 8, 4);
    }
    return 0;
}

}  // namespace

std::span<const std::byte> typeface(TypefaceStyle style) {
    if (style == TypefaceStyle::strong) return std::as_bytes(std::span(strong_words));
    return std::as_bytes(std::span(regular_words));
}

TypefaceMetrics metrics_of(std::span<const std::byte> file) {
    TypefaceMetrics metrics;
    const std::size_t head = table_at(file, "head"), lines = table_at(file, "hhea"), os2 = table_at(file, "OS/2");
    const auto em = static_cast<float>(number_at(file, head + 18, 2));
    if (head == 0 || lines == 0 || em <= 0) return metrics;
    metrics.line = static_cast<float>(signed_at(file, lines + 4) - signed_at(file, lines + 6)) / em;
    if (os2 != 0) metrics.x_height = static_cast<float>(signed_at(file, os2 + 86)) / em;
    return metrics;
}

}  // namespace weft::editor
