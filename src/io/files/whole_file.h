// A file that is read from its beginning to its end at once.
#pragma once

#include <weft/result.h>

#include <filesystem>
#include <string>

namespace weft {

/// What keeps a path from being opened as a file, or an empty string.
std::string problem_of_path(const std::filesystem::path& path);

/// Fails, naming the file, where it cannot be opened or read, or is empty.
Result<std::string> read_whole_file(const std::filesystem::path& path);

}  // namespace weft
