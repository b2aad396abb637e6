// Cache files that are kept from run to run. A file has a hash that detects damaged data.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace weft {

/// The folder for caches: $WEFT_CACHE, or $XDG_CACHE_HOME/weft, or $HOME/.cache/weft. Empty if nothing is to be kept:
/// if WEFT_CACHE is set to nothing, or no variable names a folder.
std::filesystem::path cache_folder();

/// Eight characters at the start of a file. They change with the format of the data.
using CacheFormat = std::string_view;

/// Returns nothing if the file does not exist, has another format or is damaged.
std::vector<char> read_cache_file(const std::filesystem::path& file, CacheFormat format);

/// Writes the file atomically, because another process may read or write it at the same time. Creates its folder.
/// Returns false on failure.
bool write_cache_file(const std::filesystem::path& file, CacheFormat format, std::span<const char> data);

}  // namespace weft
