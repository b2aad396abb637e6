#include "vulkan/compiled_plan.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace weft::vulkan {

std::uint32_t workgroups_of(const Command& command) {
    if (command.groups > 0) return command.groups;
    const std::uint32_t size = command.pipeline->workgroup();
    return (command.invocations + size - 1) / size;
}

void dispatch_groups(gpu::Commands& commands, std::uint32_t groups, const gpu::DeviceLimits& limits) {
    const std::uint32_t wide = std::min(groups, limits.workgroup_count[0]);
    commands.dispatch(wide, (groups + wide - 1) / wide);
}

std::uint32_t number_of(LambdaUse use) {
    switch (use) {
        case LambdaUse::discard:
            return WEFT_LAMBDA_DISCARD;
        case LambdaUse::store:
            return WEFT_LAMBDA_STORE;
        case LambdaUse::accumulate:
            break;
    }
    return WEFT_LAMBDA_ACCUMULATE;
}

void bind(gpu::Commands& commands, const Command& command, std::uint32_t substep) {
    std::array<std::byte, sizeof command.args> constants = command.args;
    const std::array behind = {substep, command.invocations};  // layout of dispatch.glsl
    std::memcpy(constants.data() + command.arg_bytes, behind.data(), sizeof behind);
    assert(command.arg_bytes + sizeof behind == command.pipeline->push_constants());
    commands.bind(*command.pipeline);
    commands.push(std::span(constants).first(command.pipeline->push_constants()));
}

void record(gpu::Commands& commands, const Command& command, std::uint32_t substep, const gpu::DeviceLimits& limits) {
    if (command.needs_barrier) commands.barrier();
    bind(commands, command, substep);
    dispatch_groups(commands, workgroups_of(command), limits);
}

}  // namespace weft::vulkan
