// Size and conflicts of the exports of a run, computed before the run.
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

/// From this size on, `weft run` prints the size of the exports before the run. 1 GiB takes some seconds on a common
/// disk and is large for a file that is meant to be sent.
inline constexpr std::uint64_t large_export_bytes = std::uint64_t{1} << 30;

/// The file system of a folder and its free bytes.
struct FreeSpace {
    std::uint64_t file_system = 0;
    std::uint64_t bytes = 0;
};
/// Nothing where the system does not report it.
std::optional<FreeSpace> free_space(const std::filesystem::path& folder);
using FreeSpaceOf = std::optional<FreeSpace> (*)(const std::filesystem::path& folder);

/// The estimates of all exporters. Fails if a format cannot hold the run, if two exports write the same file, or if the
/// exports to one file system need more than its free space.
Result<std::vector<ExportEstimate>> plan_exports(std::span<const std::unique_ptr<Exporter>> exporters,
                                                 const ExportInfo& info, const ExportFrame& start,
                                                 FreeSpaceOf free_space_of = free_space);

/// A line for the user, if the estimates add up to large_export_bytes or more.
std::optional<std::string> large_export_note(std::span<const ExportEstimate> estimates);

/// "1.5 GiB", "640 KiB".
std::string bytes_text(std::uint64_t bytes);

}  // namespace weft
