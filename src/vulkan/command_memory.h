// Commands of several cloths in device memory. Shaders that run commands of more than one cloth read them there.
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
    Result<void> build(gpu::Device& device, const std::string& name);

    std::uint64_t address(std::uint32_t command) const;

  private:
    std::vector<std::byte> bytes_;
    Arena arena_;
    Slot slot_;
};

}  // namespace weft::vulkan
