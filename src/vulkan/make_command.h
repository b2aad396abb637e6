// Makes a command from a shader and its arguments.
#pragma once

#include "vulkan/compiled_plan.h"
#include "vulkan/shaders.h"

#include <cstring>
#include <string_view>

namespace weft::vulkan {

/// Adds failures to `errors`.
template <class Args>
Command make_command(Programs& programs, Errors& errors, std::string_view program, const Args& args,
                     std::uint32_t invocations) {
    static_assert(sizeof(Args) + 2 * sizeof(std::uint32_t) <= sizeof(Command::args), "to be pushed with two numbers");
    auto pipeline = programs.get(program);
    if (!pipeline) errors.insert(errors.end(), pipeline.errors().begin(), pipeline.errors().end());
    Command command;
    command.pipeline = pipeline ? *pipeline : nullptr;
    command.program = shader_number(program);
    command.invocations = invocations;
    command.arg_bytes = sizeof args;
    std::memcpy(command.args.data(), &args, sizeof args);
    return command;
}

}  // namespace weft::vulkan
