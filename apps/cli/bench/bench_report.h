// The results of `weft bench`: to and from JSON, as tables, and compared with an earlier report.
#pragma once

#include "cli/bench/bench_edges.h"
#include "cli/bench/bench_measure.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace weft::cli {

/// The copy bandwidth of the main memory, beyond the caches.
struct MemoryFigures {
    std::uint64_t threads = 0, bytes = 0;
    double bandwidth = 0;  ///< bytes per second, reads plus writes
};

struct BenchReport {
    std::string version, compiler, processor;
    std::uint64_t hardware_threads = 0;
    MemoryFigures memory = {};
    std::vector<SceneFigures> scenes;
    std::vector<EdgeFigures> edges;  ///< for --build on a device
};

/// Takes some tens of milliseconds.
MemoryFigures measure_memory(std::uint64_t threads);

/// A report of this program on this machine, without scenes.
BenchReport empty_report();

nlohmann::ordered_json to_json(const BenchReport& report);
/// Reads what to_json wrote. Errors name the file and the place in it.
Result<BenchReport> read_report(const std::filesystem::path& file);

/// The time over which stretch, shear and residual are averaged: "2.00 s", "0.50 s to 2.00 s".
std::string quality_window(const std::vector<SceneFigures>& scenes);

std::string spread_text(std::optional<double> spread);

/// All results as tables for the terminal.
std::string tables(const BenchReport& report);

/// Ratios now / before by scene, and differences in settings: below 1 is faster, or less stretch.
std::string comparison(const BenchReport& now, const BenchReport& before, const std::string& before_name);

}  // namespace weft::cli
