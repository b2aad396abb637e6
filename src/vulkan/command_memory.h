// Commands of some cloths in the device's memory, where shaders read what they are told.
#pragma once

#include "vulkan/compiled_plan.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace weft::vulkan {

class CommandMemory {
  public:
    /// Returns the number of the first one; the others follow.
    std::uint32_t add(std::span<const Command> commands);
    Result<Done> build(gpu::Device& device, const std::string& name);

    std::uint64_t address(std::uint32_t command) const;

  private:
    std::vector<std::byte> bytes_;
    Arena arena_;
    Slot slot_;
};

/// So many workgroups, along more than one axis if one has no room for them.
void dispatch_groups(gpu::Commands& commands, std::uint32_t groups, const gpu::DeviceLimits& limits);

/// One command by itself, which lies at `address`. `substep` is added to its own.
void record(gpu::Commands& commands, const Command& command, std::uint64_t address, std::uint32_t substep,
            const gpu::DeviceLimits& limits);

}  // namespace weft::vulkan
