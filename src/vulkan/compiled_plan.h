// The part of a cloth in the world's plan as a device runs it: commands with what each is told.
#pragma once

#include "vulkan/cloth_state.h"
#include "vulkan/links.h"
#include "vulkan/programs.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace weft::vulkan {

struct Command {
    const gpu::Pipeline* pipeline = nullptr;
    std::uint32_t program = 0;  ///< number of its shader
    std::uint32_t invocations = 0;
    std::uint32_t groups = 0;     ///< workgroups; 0: as many as the invocations fill
    std::uint32_t line_rows = 0;  ///< of lines: rows of the largest block
    bool needs_barrier = true;    ///< reads or writes what the command before it writes
    Pass pass{};                  ///< what it comes from, or is part of
    bool single = false;          ///< so little work that one workgroup does it
    std::uint32_t substep = 0;
    std::uint32_t arg_bytes = 0;
    alignas(8) std::array<std::byte, 128> args{};
};

/// Commands [begin, end) are those of a substep, and run so many times: each time for the next one.
struct Repeat {
    std::size_t begin = 0, end = 0;
    std::uint32_t times = 1;
};

/// Calls `f(i, substeps before)` for everything from 0 to `count` in the order in which it runs, as long as that is
/// true.
template <class F>
void run_through(std::size_t count, const Repeat& repeat, F&& f) {
    std::uint32_t round = 0;
    for (std::size_t i = 0; i < count;) {
        const bool repeated = i >= repeat.begin && i < repeat.end;
        if (!f(i, repeated ? round : 0)) return;
        if (++i == repeat.end && repeated && round + 1 < repeat.times) {
            i = repeat.begin;
            ++round;
        }
    }
}

/// What a frame does, in order.
struct CompiledPlan {
    std::vector<Command> commands;
    Repeat repeat;
    std::size_t check = 0;      ///< from here on: whether all is finite, back if not, and the surface
    std::size_t roll_back = 0;  ///< one of those
};

/// What a cloth does for its island.
struct IslandPart {
    std::uint64_t report = 0;            ///< address of that of the island's first cloth
    const LinkTables* tables = nullptr;  ///< of the first cloth alone, if the island has links
    const LinkBuffers* links = nullptr;  ///< likewise
};

Result<CompiledPlan> compile(Programs& programs, const ClothState& cloth, const WorkBuffers& work,
                             const FrameInput& input, const InputShape& shape, const WorldPlan& plan,
                             const PlainStiffness& stiffness, const IslandPart& island);

/// Normals for the state as it is.
Result<std::vector<Command>> compile_surface(Programs& programs, const ClothState& cloth);

/// WEFT_LAMBDA_… of a pass.
std::uint32_t use_of_lambda(const WorldPlan& plan, const Pass& pass, std::uint32_t substep);

/// Workgroups that a command fills.
std::uint32_t workgroups_of(const Command& command);
/// So many workgroups, along more than one axis if one has no room for them.
void dispatch_groups(gpu::Commands& commands, std::uint32_t groups, const gpu::DeviceLimits& limits);
/// Its pipeline with what it is told. `substep` is added to its own.
void bind(gpu::Commands& commands, const Command& command, std::uint32_t substep);
/// Behind a barrier if the command needs one. `substep` is added to its own.
void record(gpu::Commands& commands, const Command& command, std::uint32_t substep, const gpu::DeviceLimits& limits);

}  // namespace weft::vulkan
