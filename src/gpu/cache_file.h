// Bytes that can be made again, kept from run to run. Drivers look only at the head of a cache that they are given:
// what is behind it must be what they wrote.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

namespace weft::gpu {

/// Empty if there is no such file, or it is not as it was written.
std::vector<char> read_cache_file(const std::filesystem::path& file);

/// The whole, or nothing: another process may read or write the file at the same time. Makes its folder. False if it
/// cannot be written.
bool write_cache_file(const std::filesystem::path& file, std::span<const char> data);

}  // namespace weft::gpu
