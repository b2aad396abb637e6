#include "gpu_pipelines.h"

#include "gpu/device.h"
#include "gpu/pipeline.h"
#include "vulkan/shaders.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace weft::bench {
namespace {

using Clock = std::chrono::steady_clock;

struct Compiled {
    std::string name;
    double ms = 0;
};

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// The times of all shaders, in their order, or the first error.
Result<std::vector<Compiled>> compile_all(const gpu::Device& device, unsigned threads) {
    const auto shaders = vulkan::shaders();
    std::vector<Compiled> compiled(shaders.size());
    std::atomic<std::size_t> next = 0;
    std::mutex mutex;
    Errors errors;
    const auto work = [&] {
        for (std::size_t i = next++; i < shaders.size(); i = next++) {
            const auto start = Clock::now();
            const std::array constants = {std::min(128u, device.limits().workgroup_size[0])};
            auto pipeline = gpu::Pipeline::create(device, shaders[i], constants);
            compiled[i] = {std::string(shaders[i].name), ms_since(start)};
            const std::lock_guard lock(mutex);
            if (!pipeline) errors.insert(errors.end(), pipeline.errors().begin(), pipeline.errors().end());
        }
    };
    std::vector<std::thread> others;
    for (unsigned i = 1; i < threads; ++i) others.emplace_back(work);
    work();
    for (std::thread& other : others) other.join();
    if (!errors.empty()) return errors;
    return compiled;
}

}  // namespace

Result<void> print_pipelines(const std::shared_ptr<const gpu::Instance>& instance, const gpu::DeviceInfo& info) {
    const unsigned all = std::max(1u, std::thread::hardware_concurrency());
    for (const unsigned threads : {1u, all}) {
        auto device = gpu::Device::create(instance, info);  // one of its own, with an empty cache
        if (!device) return device.errors();
        const auto start = Clock::now();
        auto compiled = compile_all(**device, threads);
        if (!compiled) return compiled.errors();
        const double ms = ms_since(start);
        std::printf("%zu pipelines, %u thread%s  %.0f ms\n", compiled->size(), threads, threads == 1 ? "" : "s", ms);
        if (threads != 1) continue;
        std::ranges::sort(*compiled, std::greater(), &Compiled::ms);
        for (std::size_t i = 0; i < std::min<std::size_t>(compiled->size(), 40); ++i)
            std::printf("  %-28s %8.1f ms\n", (*compiled)[i].name.c_str(), (*compiled)[i].ms);
    }
    return {};
}

}  // namespace weft::bench
