// Reads a whole file at once.
#pragma once

#include <weft/result.h>

#include <filesystem>
#include <string>

namespace weft {

/// Why the path cannot be opened as a file, or an empty string.
std::string problem_of_path(const std::filesystem::path& path);

/// Fails, naming the file, if it cannot be opened or read, or is empty.
Result<std::string> read_whole_file(const std::filesystem::path& path);

}  // namespace weft
