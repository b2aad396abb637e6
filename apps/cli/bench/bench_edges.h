// Times the search for the edges and hinges of a mesh, on the CPU and on a Vulkan device.
#pragma once

#include "cli/bench/bench_measure.h"

#include <cstdint>
#include <string>
#include <vector>

namespace weft::cli {

struct EdgeFigures {
    std::string name;
    std::uint64_t triangles = 0;
    double cpu_ms = 0;     ///< on one thread; all times are medians
    double wall_ms = 0;    ///< on the device, including transfers
    double device_ms = 0;  ///< of that, the device's own time; 0 if it has no clock
};

/// For the sheets of --build, after a first run that is not counted. Fails if device and CPU find different edges or
/// hinges. Empty in a build without Vulkan.
Result<std::vector<EdgeFigures>> measure_edges(const std::vector<std::uint32_t>& sides, const BenchSettings& settings);

std::string edges_table(const std::vector<EdgeFigures>& figures);

}  // namespace weft::cli
