// The figures of `weft bench`: as JSON and back, as tables, and against former ones.
#pragma once

#include "cli/bench/bench_edges.h"
#include "cli/bench/bench_measure.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace weft::cli {

/// How fast the machine copies what no cache holds.
struct MemoryFigures {
    std::uint64_t threads = 0, bytes = 0;
    double bandwidth = 0;  ///< bytes a second, read ones and written ones together
};

struct BenchReport {
    std::string version, compiler, processor;
    std::uint64_t hardware_threads = 0;
    MemoryFigures memory = {};
    std::vector<SceneFigures> scenes;
    std::vector<EdgeFigures> edges;  ///< of --build on a device
};

/// Takes some tens of milliseconds.
MemoryFigures measure_memory(std::uint64_t threads);

/// This program on this machine, no scenes yet.
BenchReport empty_report();

nlohmann::ordered_json to_json(const BenchReport& report);
/// What to_json wrote. Errors name the file and the place in it.
Result<BenchReport> read_report(const std::filesystem::path& file);

/// Over what stretch, shear and residual are averages: "2.00 s", "0.50 s to 2.00 s".
std::string quality_window(const std::vector<SceneFigures>& scenes);

std::string spread_text(std::optional<double> spread);

/// Everything, for a human.
std::string tables(const BenchReport& report);

/// Ratios now / before, scene by scene, and what is not alike: below 1 is faster, or less stretch.
std::string comparison(const BenchReport& now, const BenchReport& before, const std::string& before_name);

}  // namespace weft::cli
