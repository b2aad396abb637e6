#include "vulkan/command_memory.h"

#include <array>
#include <cassert>
#include <cstring>

namespace weft::vulkan {
namespace {

// Same sizes as in commands.glsl.
constexpr std::size_t head_bytes = 16, command_bytes = head_bytes + sizeof(Command::args);

}  // namespace

std::uint32_t CommandMemory::add(std::span<const Command> commands) {
    const std::size_t first = bytes_.size() / command_bytes;
    bytes_.resize(bytes_.size() + commands.size() * command_bytes);
    std::byte* to = bytes_.data() + first * command_bytes;
    for (const Command& command : commands) {
        const std::array head = {command.program, command.invocations, command.needs_barrier ? 1u : 0u};
        std::memcpy(to, head.data(), sizeof head);
        std::memcpy(to + head_bytes, command.args.data(), command.arg_bytes);
        to += command_bytes;
    }
    return static_cast<std::uint32_t>(first);
}

Result<void> CommandMemory::build(gpu::Device& device, const std::string& name) {
    if (bytes_.empty()) return {};
    slot_ = arena_.add_array(bytes_);
    auto built = arena_.build(device, "commands of " + name);
    bytes_ = {};
    return built;
}

std::uint64_t CommandMemory::address(std::uint32_t command) const {
    assert((command + std::uint64_t{1}) * command_bytes <= slot_.bytes);
    return arena_.address(slot_) + command * command_bytes;
}

}  // namespace weft::vulkan
