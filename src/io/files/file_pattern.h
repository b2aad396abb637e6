// File names with a placeholder for a number: frames/%04d.obj.
#pragma once

#include <weft/result.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace weft {

/// A file name with a placeholder for the frame number, zero-padded to `width` digits.
struct FilePattern {
    std::string before, after;
    std::size_t width = 0;

    std::string name(std::uint64_t number) const;
};

/// Part of the error message for names that parse_pattern() rejects.
inline constexpr const char* pattern_rule =
    "a file name may contain only one '%', as %d or %04d, for the number of the frame";

/// Whether the file name contains a '%' and so must be a pattern.
bool has_pattern(const std::filesystem::path& path);
/// Parses one `%d` or `%0Nd`. The user's text is never passed to printf.
std::optional<FilePattern> parse_pattern(const std::string& file_name);

/// The ending in lower case, including the dot.
std::string ending_of(const std::filesystem::path& path);
/// The endings of formats as a list: ".glb, .obj".
template <class Formats>
std::string list_endings(const Formats& formats) {
    std::string list;
    for (const auto& format : formats) list += (list.empty() ? "" : ", ") + std::string(format.ending);
    return list;
}
/// The error for a file with an unknown ending. `known`: "known are .glb, .obj".
Error unknown_ending(const std::filesystem::path& path, const std::string& known);

}  // namespace weft
