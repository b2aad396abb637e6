// File names with a place for a number: frames/%04d.obj.
#pragma once

#include <weft/result.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace weft {

/// A file name with a place for the frame's number, zero-padded to `width` digits.
struct FilePattern {
    std::string before, after;
    std::size_t width = 0;

    std::string name(std::uint64_t number) const;
};

/// What is said of those that parse_pattern does not know.
inline constexpr const char* pattern_rule =
    "a '%' stands for the frame's number, once, as %d or %04d, and for nothing else";

/// Whether the name is meant as one.
bool has_pattern(const std::filesystem::path& path);
/// One `%d` or `%0Nd`. Reads the user's text as data: it never reaches a printf.
std::optional<FilePattern> parse_pattern(const std::string& file_name);

/// With the dot, in lower case.
std::string ending_of(const std::filesystem::path& path);
/// ".glb, .obj": of some formats.
template <class Formats>
std::string list_endings(const Formats& formats) {
    std::string list;
    for (const auto& format : formats) list += (list.empty() ? "" : ", ") + std::string(format.ending);
    return list;
}
/// Of a file whose ending is that of no format. `known`: "known are .glb, .obj".
Error unknown_ending(const std::filesystem::path& path, const std::string& known);

}  // namespace weft
