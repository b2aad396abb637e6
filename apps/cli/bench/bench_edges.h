// How long it takes to find the edges and hinges of a mesh, on the CPU and on a Vulkan device.
#pragma once

#include "cli/bench/bench_measure.h"

#include <cstdint>
#include <string>
#include <vector>

namespace weft::cli {

struct EdgeFigures {
    std::string name;
    std::uint64_t triangles = 0;
    double cpu_ms = 0;     ///< on one thread; medians all
    double wall_ms = 0;    ///< by the device, with the ways there and back
    double device_ms = 0;  ///< of that, its own work; 0 if it has no clock
};

/// Of the sheets of --build, after a first run that does not count. Fails where device and CPU find different ones.
/// Nothing in a build without Vulkan.
Result<std::vector<EdgeFigures>> measure_edges(const std::vector<std::uint32_t>& sides, const BenchSettings& settings);

std::string edges_table(const std::vector<EdgeFigures>& figures);

}  // namespace weft::cli
