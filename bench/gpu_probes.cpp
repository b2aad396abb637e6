#include "gpu_probes.h"

#include "gpu/commands.h"

#include <array>
#include <functional>
#include <string_view>

namespace weft::bench {
namespace {

#include <bench_shaders.inc>

constexpr std::uint32_t workgroup = 128;

Result<gpu::Pipeline> make_pipeline(const gpu::Device& device, std::string_view name, std::uint32_t invocations) {
    const auto shader = std::ranges::find(bench_shaders, name, &gpu::Shader::name);
    return gpu::Pipeline::create(device, *shader, std::array{invocations});
}

template <class Args>
void push(gpu::Commands& commands, const gpu::Pipeline& pipeline, const Args& args) {
    commands.push(std::as_bytes(std::span(&args, 1)).first(pipeline.push_constants()));
}

// Milliseconds that the commands recorded by `work` take.
Result<double> time_of(gpu::Device& device, unsigned runs, const std::function<void(gpu::Commands&)>& work) {
    auto commands = gpu::Commands::create(device, 2);
    if (!commands) return commands.errors();
    if (auto begun = commands->begin(); !begun) return begun.errors();
    commands->stamp();
    work(*commands);
    commands->stamp();
    if (auto ended = commands->end(); !ended) return ended.errors();
    constexpr unsigned warmup = 2;
    std::vector<double> times;
    for (unsigned run = 0; run < warmup + runs; ++run) {
        const auto value = commands->submit();
        if (!value) return value.errors();
        if (auto done = device.wait(*value); !done) return done.errors();
        const std::vector<double> intervals = commands->intervals();
        if (intervals.empty()) return Error::of_machine(device.info().name, "has no clock");
        if (run >= warmup) times.push_back(intervals[0]);
    }
    return median(std::move(times));
}

Result<void> probe_dispatch(gpu::Device& device, bool quick, Probes& out) {
    auto empty = make_pipeline(device, "empty", workgroup);
    if (!empty) return empty.errors();
    const unsigned dispatches = 300, runs = quick ? 5 : 25;
    for (const bool ordered : {true, false}) {
        const auto ms = time_of(device, runs, [&](gpu::Commands& commands) {
            commands.bind(*empty);
            for (unsigned i = 0; i < dispatches; ++i) {
                commands.dispatch(1);
                if (ordered) commands.barrier();
            }
        });
        if (!ms) return ms.errors();
        (ordered ? out.dispatch_us : out.unordered_us) = *ms * 1e3 / dispatches;
    }
    return {};
}

Result<void> probe_barrier(gpu::Device& device, bool quick, Probes& out) {
    struct Args {
        std::uint64_t to;
        std::uint32_t rounds, unused;
    };
    const gpu::DeviceLimits& limits = device.limits();
    const std::uint32_t invocations = std::min({1024u, limits.workgroup_invocations, limits.workgroup_size[0]});
    auto pipeline = make_pipeline(device, "barriers", invocations);
    if (!pipeline) return pipeline.errors();
    auto result =
        device.memory().buffer(invocations * sizeof(std::uint32_t), gpu::MemoryKind::readback, "result of barriers");
    if (!result) return result.errors();
    // Both measurements contain the cost of the dispatch itself, which the difference removes.
    const std::array<std::uint32_t, 2> rounds = {quick ? 10u : 500u, quick ? 60u : 5500u};
    std::array<double, 2> ms{};
    for (unsigned i = 0; i < 2; ++i) {
        const auto time = time_of(device, quick ? 3 : 15, [&](gpu::Commands& commands) {
            commands.bind(*pipeline);
            push(commands, *pipeline, Args{result->address(), rounds[i], 0});
            commands.dispatch(1);
            commands.host_barrier();
        });
        if (!time) return time.errors();
        ms[i] = *time;
        for (std::uint32_t k = 0; k < invocations; ++k) {
            if (result->as<std::uint32_t>()[k] != (k + rounds[i]) % invocations + rounds[i])
                return Error::of_machine(device.info().name, "computes something else than it was told at barriers");
        }
    }
    out.invocations = invocations;
    out.barrier_us = (ms[1] - ms[0]) * 1e3 / (2.0 * (rounds[1] - rounds[0]));
    return {};
}

Result<void> probe_copy(gpu::Device& device, bool quick, Probes& out) {
    struct Args {
        std::uint64_t from, to;
        std::uint32_t count, unused;
    };
    constexpr std::uint64_t mebibyte = std::uint64_t{1} << 20;
    const std::uint64_t room = std::min(device.info().memory / 8, device.limits().largest_allocation);
    const std::uint64_t bytes = std::min((quick ? 32 : 512) * mebibyte, room) / 16 * 16;
    auto from = device.memory().buffer(bytes, gpu::MemoryKind::device, "copy from");
    if (!from) return from.errors();
    auto to = device.memory().buffer(bytes, gpu::MemoryKind::device, "copy to");
    if (!to) return to.errors();
    if (auto filled = gpu::run_once(device, [&](gpu::Commands& commands) { commands.fill(*from, 1); }); !filled)
        return filled;
    auto stream = make_pipeline(device, "stream", workgroup);
    if (!stream) return stream.errors();

    const unsigned copies = 4, runs = quick ? 3 : 9;
    const auto count = static_cast<std::uint32_t>(bytes / 16);
    const std::uint32_t groups = (count + workgroup - 1) / workgroup,
                        wide = std::min(groups, device.limits().workgroup_count[0]);
    for (const bool command : {true, false}) {
        const auto ms = time_of(device, runs, [&](gpu::Commands& commands) {
            for (unsigned i = 0; i < copies; ++i) {
                if (command) {
                    commands.copy(*from, *to, bytes);
                } else {
                    commands.bind(*stream);
                    push(commands, *stream, Args{from->address(), to->address(), count, 0});
                    commands.dispatch(wide, (groups + wide - 1) / wide);
                }
                commands.barrier();
            }
        });
        if (!ms) return ms.errors();
        (command ? out.copy_rate : out.stream_rate) = 2.0 * static_cast<double>(bytes) * copies / (*ms * 1e-3);
    }
    out.copied_bytes = bytes;
    return {};
}

}  // namespace

Result<Probes> probe(gpu::Device& device, bool quick) {
    if (device.limits().timestamp_bits == 0) return Error::of_machine(device.info().name, "has no clock");
    Probes probes;
    if (auto done = probe_copy(device, quick, probes); !done) return done.errors();  // also warms up the device
    if (auto done = probe_dispatch(device, quick, probes); !done) return done.errors();
    if (auto done = probe_barrier(device, quick, probes); !done) return done.errors();
    return probes;
}

}  // namespace weft::bench
