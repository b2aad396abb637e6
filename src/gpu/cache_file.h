// Cache files that are kept from run to run. Drivers check only the header of a pipeline cache, so the file has a hash
// that detects damaged data.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

namespace weft::gpu {

/// Returns nothing if the file does not exist or is damaged.
std::vector<char> read_cache_file(const std::filesystem::path& file);

/// Writes the file atomically, because another process may read or write it at the same time. Creates its folder.
/// Returns false on failure.
bool write_cache_file(const std::filesystem::path& file, std::span<const char> data);

}  // namespace weft::gpu
