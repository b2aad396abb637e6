// What the exports of a run will take, known before the run.
#pragma once

#include "io/exports/exporter.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace weft {

/// From here on a run says beforehand how much it will write: 1 GiB takes some seconds of a common disk, and is more
/// than most people expect of a file that they meant to send to someone.
inline constexpr std::uint64_t large_export_bytes = std::uint64_t{1} << 30;

/// The file system that a folder is on: which one, and how many bytes it has left.
struct FreeSpace {
    std::uint64_t file_system = 0;
    std::uint64_t bytes = 0;
};
/// Nothing where the system does not tell.
std::optional<FreeSpace> free_space(const std::filesystem::path& folder);
using FreeSpaceOf = std::optional<FreeSpace> (*)(const std::filesystem::path& folder);

/// The estimate of every exporter. Fails where a format cannot hold the run, where two exports name the same file, and
/// where a file system has less space free than all that is to go there.
Result<std::vector<ExportEstimate>> plan_exports(std::span<const std::unique_ptr<Exporter>> exporters,
                                                 const ExportInfo& info, std::span<const ExportSurface> surfaces,
                                                 FreeSpaceOf free_space_of = free_space);

/// A line for the user if it is large_export_bytes or more that they come to.
std::optional<std::string> large_export_note(std::span<const ExportEstimate> estimates);

/// "1.5 GiB", "640 KiB".
std::string bytes_text(std::uint64_t bytes);

}  // namespace weft
