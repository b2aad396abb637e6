#include "cli/bench/bench_edges.h"

#include "cli/run/stats.h"
#include "cli/shell/table.h"

#ifdef WEFT_VULKAN
#include "gpu/device.h"
#include "mesh/procedural.h"
#include "vulkan/topology/find_edges.h"
#endif

#include <algorithm>
#include <chrono>

namespace weft::cli {

#ifdef WEFT_VULKAN
namespace {

using Clock = std::chrono::steady_clock;

Result<std::shared_ptr<gpu::Device>> open_device(const Options& options) {
    auto instance = gpu::Instance::create();
    if (!instance) return instance.errors();
    auto info = gpu::choose_device((*instance)->devices(), options.device, options.backend == "vulkan");
    if (!info) return info.errors();
    return gpu::Device::create(*instance, *info);
}

Result<EdgeFigures> measure(gpu::Device& device, vulkan::Programs& programs, std::uint32_t side, std::uint32_t repeat) {
    const std::string name = "build " + std::to_string(side);
    const std::vector<Triangle> triangles = make_grid({1, 1}, {side, side}, GridDesc{}.diagonal).triangles;
    std::vector<double> cpu_ms, wall_ms, device_ms;
    for (std::uint32_t run = 0; run <= repeat; ++run) {
        const auto begin = Clock::now();
        const EdgeList edges = build_edges(triangles, side * side);
        const HingeList hinges = build_hinges(edges, triangles);
        const std::chrono::duration<double, std::milli> taken = Clock::now() - begin;
        vulkan::EdgeTimes times;
        const auto found = vulkan::build_edges_and_hinges(device, programs, triangles, side * side, &times);
        if (!found) return found.errors();
        if (found->edges.edges != edges.edges || found->hinges.hinges != hinges.hinges)
            return Error::of_machine(name, "the device finds other edges and hinges than the CPU");
        if (run == 0) continue;  // the first run builds the pipelines
        cpu_ms.push_back(taken.count());
        wall_ms.push_back(times.wall_ms);
        device_ms.push_back(times.device_ms);
    }
    return EdgeFigures{name, triangles.size(), median_of(std::move(cpu_ms)), median_of(std::move(wall_ms)),
                       median_of(std::move(device_ms))};
}

}  // namespace

Result<std::vector<EdgeFigures>> measure_edges(const std::vector<std::uint32_t>& sides, const BenchSettings& settings) {
    std::vector<EdgeFigures> all;
    auto device = open_device(settings.common);
    if (!device) return device.errors();
    vulkan::Programs programs(**device);
    for (const std::uint32_t side : sides) {
        auto figures = measure(**device, programs, side, settings.repeat);
        if (!figures) return figures.errors();
        all.push_back(std::move(*figures));
    }
    return all;
}
#else
Result<std::vector<EdgeFigures>> measure_edges(const std::vector<std::uint32_t>&, const BenchSettings&) {
    return std::vector<EdgeFigures>{};
}
#endif

std::string edges_table(const std::vector<EdgeFigures>& figures) {
    Table table({"ms for edges and hinges", "triangles", "CPU", "device with transfers", "device only"});
    for (const EdgeFigures& one : figures) {
        table.add({one.name, std::to_string(one.triangles), fixed(one.cpu_ms, 2), fixed(one.wall_ms, 2),
                   one.device_ms > 0 ? fixed(one.device_ms, 2) : "?"});
    }
    return table.text();
}

}  // namespace weft::cli
