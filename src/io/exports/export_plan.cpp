#include "io/exports/export_plan.h"

#include "io/files/atomic_file.h"

#include <sys/stat.h>

#include <array>
#include <cstdio>
#include <map>
#include <system_error>
#include <utility>

namespace weft {
namespace fs = std::filesystem;
namespace {

fs::path same_for_all_spellings(const fs::path& path) {
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(path, error);
    return error ? path.lexically_normal() : whole;
}

void find_shared_files(std::span<const ExportEstimate> estimates, Errors& errors) {
    std::map<fs::path, fs::path> writer;  // file -> first file of the export that writes it
    for (const ExportEstimate& estimate : estimates) {
        for (const fs::path& file : estimate.files) {
            const auto [other, is_new] = writer.emplace(same_for_all_spellings(file), estimate.files.front());
            if (is_new) continue;
            errors.push_back({estimate.files.front().string(),
                              "would write " + file.string() + ", and so would " + other->second.string()});
        }
    }
}

void find_full_disks(std::span<const ExportEstimate> estimates, FreeSpaceOf free_space_of, Errors& errors) {
    struct Demand {
        std::uint64_t needed = 0, free = 0;
        std::string files;
    };
    std::map<std::uint64_t, Demand> demands;
    for (const ExportEstimate& estimate : estimates) {
        const std::optional<FreeSpace> space = free_space_of(folder_of(estimate.files.front()));
        if (!space) continue;
        Demand& demand = demands[space->file_system];
        demand.free = space->bytes;
        demand.needed += estimate.bytes;
        demand.files += (demand.files.empty() ? "" : ", ") + estimate.files.front().string();
    }
    for (const auto& [file_system, demand] : demands) {
        if (demand.needed <= demand.free) continue;
        errors.push_back({demand.files, "would take up to " + bytes_text(demand.needed) + ", and only " +
                                            bytes_text(demand.free) + " are free there"});
    }
}

}  // namespace

std::optional<FreeSpace> free_space(const fs::path& folder) {
    std::error_code error;
    const fs::space_info space = fs::space(folder, error);
    struct stat status = {};
    // Some network and virtual file systems report a capacity of 0.
    if (error || space.capacity == 0 || ::stat(folder.c_str(), &status) != 0) return std::nullopt;
    return FreeSpace{status.st_dev, space.available};
}

Result<std::vector<ExportEstimate>> plan_exports(std::span<const std::unique_ptr<Exporter>> exporters,
                                                 const ExportInfo& info, const ExportFrame& start,
                                                 FreeSpaceOf free_space_of) {
    std::vector<ExportEstimate> estimates;
    Errors errors;
    for (const auto& exporter : exporters) {
        Result<ExportEstimate> estimate = exporter->estimate(info, start);
        if (estimate) {
            estimates.push_back(*std::move(estimate));
        } else {
            errors.insert(errors.end(), estimate.errors().begin(), estimate.errors().end());
        }
    }
    find_shared_files(estimates, errors);
    find_full_disks(estimates, free_space_of, errors);
    if (!errors.empty()) return errors;
    return estimates;
}

std::optional<std::string> large_export_note(std::span<const ExportEstimate> estimates) {
    std::uint64_t total = 0;
    std::string parts;
    for (const ExportEstimate& estimate : estimates) {
        total += estimate.bytes;
        parts += (parts.empty() ? "" : ", ") + estimate.files.front().string() + " " + bytes_text(estimate.bytes);
    }
    if (total < large_export_bytes) return std::nullopt;
    return "the exports will take up to " + bytes_text(total) + ": " + parts;
}

std::string bytes_text(std::uint64_t bytes) {
    constexpr std::array units = {"bytes", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
    double value = static_cast<double>(bytes);
    std::size_t unit = 0;
    for (; value >= 1023.5 && unit + 1 < units.size(); ++unit) value /= 1024;
    char text[40];
    std::snprintf(text, sizeof text, unit > 0 && value < 9.95 ? "%.1f %s" : "%.0f %s", value, units[unit]);
    return text;
}

}  // namespace weft
