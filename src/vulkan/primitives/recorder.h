// Records a sequence of passes. Each pass may read what the one before it wrote.
#pragma once

#include "gpu/commands.h"
#include "vulkan/primitives/args.data.h"
#include "vulkan/programs.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace weft::vulkan {

/// Number of groups of `size` that hold `count` elements.
constexpr std::uint32_t groups_of(std::uint32_t count, std::uint32_t size) {
    return static_cast<std::uint32_t>((std::uint64_t{count} + size - 1) / size);
}
constexpr std::uint32_t tiles_of(std::uint32_t count) {
    return groups_of(count, WEFT_TILE);
}

/// Largest number of elements. The numbers of workgroups, and of elements past the last one, must fit into 32 bits.
constexpr std::uint64_t most_elements = std::uint64_t{1} << 31;

inline Error too_many(std::size_t count, const std::string& what) {
    return {"", "must be at most " + std::to_string(most_elements) + " " + what + ", got " + std::to_string(count)};
}

/// Collects failures and returns them from end().
class Recorder {
  public:
    Recorder(gpu::Device& device, Programs& programs, gpu::Commands& commands)
        : widest_(device.limits().workgroup_count[0]), programs_(programs), commands_(commands) {}

    template <class Args>
    void run(std::string_view program, const Args& args, std::uint32_t groups) {
        auto pipeline = programs_.get(program);
        if (!pipeline) {
            errors_.insert(errors_.end(), pipeline.errors().begin(), pipeline.errors().end());
            return;
        }
        commands_.barrier();
        commands_.bind(**pipeline);
        commands_.push(std::as_bytes(std::span(&args, 1)));
        const std::uint32_t wide = std::min(groups, widest_);
        commands_.dispatch(wide, groups_of(groups, wide));
    }
    Result<void> end() const {
        if (!errors_.empty()) return errors_;
        return {};
    }

  private:
    std::uint32_t widest_;
    Programs& programs_;
    gpu::Commands& commands_;
    Errors errors_;
};

/// Records the passes, runs them and waits. Adds their time on the device to `device_ms` if the device has a clock.
template <class Record>
Result<void> run_passes(gpu::Device& device, Programs& programs, Record&& record, double* device_ms = nullptr) {
    auto commands = gpu::Commands::create(device, 2);
    if (!commands) return commands.errors();
    if (auto begun = commands->begin(); !begun) return begun;
    Recorder recorder(device, programs, *commands);
    commands->stamp();
    record(recorder);
    commands->stamp();
    if (auto recorded = recorder.end(); !recorded) return recorded;
    if (auto ended = commands->end(); !ended) return ended;
    auto value = commands->submit();
    if (!value) return value.errors();
    if (auto waited = device.wait(*value); !waited) return waited;
    for (const double ms : commands->intervals())
        if (device_ms) *device_ms += ms;
    return {};
}

}  // namespace weft::vulkan
