// A cloth's part of the world's plan, compiled into commands for the device.
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
    std::uint32_t line_rows = 0;  ///< lines only: constraints of the largest block
    std::uint32_t nodes = 0;      ///< level_limits only: nodes of the level
    bool needs_barrier = true;    ///< reads or writes data that the command before it writes
    Pass pass{};                  ///< the pass that the command belongs to
    bool single = false;          ///< small enough for one workgroup
    std::uint32_t substep = 0;
    std::uint32_t arg_bytes = 0;
    alignas(8) std::array<std::byte, 128> args{};
};

/// Commands [begin, end) are those of one substep. They run `times` times, each time for the next substep.
struct Repeat {
    std::size_t begin = 0, end = 0;
    std::uint32_t times = 1;
};

/// Calls `f(i, substeps before)` for the commands 0 … `count` - 1 in order of execution, until `f` returns false.
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

/// The commands of a frame, in order.
struct CompiledPlan {
    std::vector<Command> commands;
    Repeat repeat;
    std::size_t check = 0;      ///< first of the commands that check for finite numbers, roll back and make normals
    std::size_t roll_back = 0;  ///< the command that rolls back
};

/// Data of the island that a cloth belongs to, and of the world.
struct IslandPart {
    std::uint64_t report = 0;            ///< address of the report of the island's first cloth
    const LinkTables* tables = nullptr;  ///< only for the first of several cloths that are stitched together
    const LinkBuffers* links = nullptr;  ///< likewise
    std::uint64_t colliders = 0;         ///< address of the world's colliders
    std::uint64_t bodies = 0;            ///< that of its bodies
};

Result<CompiledPlan> compile(Programs& programs, const ClothState& cloth, const WorkBuffers& work,
                             const FrameInput& input, const InputShape& shape, const WorldPlan& plan,
                             const PlainStiffness& stiffness, const IslandPart& island);

/// Commands that compute normals of the current state.
Result<std::vector<Command>> compile_surface(Programs& programs, const ClothState& cloth);

/// One of WEFT_LAMBDA_… for a pass.
std::uint32_t number_of(LambdaUse use);

/// Whether a pass is recorded once for all cloths of a frame.
inline bool is_for_all(const Pass& pass) {
    return pass.source == RowSource::dynamic || is_cloth_contact(pass.kind) || is_particle_contact(pass.kind) ||
           is_body_pass(pass.kind) || pass.kind == PassKind::watch_tears || pass.kind == PassKind::tear;
}

/// Workgroups that a command fills.
std::uint32_t workgroups_of(const Command& command);
/// Dispatches `groups` workgroups, along a second axis if the limit of the first is exceeded.
void dispatch_groups(gpu::Commands& commands, std::uint32_t groups, const gpu::DeviceLimits& limits);
/// Binds the command's pipeline and pushes its arguments. `substep` is added to its own.
void bind(gpu::Commands& commands, const Command& command, std::uint32_t substep);
/// Records the command, after a barrier if it needs one. `substep` is added to its own.
void record(gpu::Commands& commands, const Command& command, std::uint32_t substep, const gpu::DeviceLimits& limits);

}  // namespace weft::vulkan
