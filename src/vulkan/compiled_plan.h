// A StepPlan as a device runs it: dispatches with what each is told.
#pragma once

#include "vulkan/cloth_state.h"
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
    std::uint32_t groups = 0;   ///< workgroups; 0: as many as the invocations fill
    bool needs_barrier = true;  ///< reads or writes what the command before it writes
    Pass pass{};                ///< what it comes from, or is part of
    std::uint32_t substep = 0;
    std::uint32_t arg_bytes = 0;
    alignas(8) std::array<std::byte, 128> args{};
};

/// Commands [begin, end) are those of a substep; as many follow, alike but for the substep's number, for each further
/// one.
struct Repeat {
    std::size_t begin = 0, end = 0;
    std::uint32_t times = 1;
};

/// What a frame does, in order.
struct CompiledPlan {
    std::vector<Command> commands;
    Repeat repeat;
    std::size_t check = 0;  ///< from here on: whether all is finite, back if not, and the surface
    Command roll_back;      ///< one of those
};

Result<CompiledPlan> compile(Programs& programs, const ClothState& cloth, const WorkBuffers& work,
                             const FrameInput& input, const InputShape& shape, const StepPlan& plan);

/// Normals for the state as it is.
Result<std::vector<Command>> compile_surface(Programs& programs, const ClothState& cloth);

void record(gpu::Commands& commands, const Command& command, const gpu::DeviceLimits& limits);

}  // namespace weft::vulkan
