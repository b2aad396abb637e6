// The seams of all islands of a frame, as the shaders read them.
#pragma once

#include "collide/seams.h"

#include <cstdint>
#include <span>
#include <vector>

namespace weft::vulkan {

class SeamArrays {
  public:
    /// `seams`: of each member of the frame; null without. `end`: of the particles of the world that shaders ask for.
    SeamArrays(std::span<const Seams* const> seams, std::uint64_t end);

    bool empty() const { return entries_.empty(); }
    const std::vector<std::uint32_t>& first() const { return first_; }
    const std::vector<SeamEntry>& entries() const { return entries_; }

  private:
    std::vector<std::uint32_t> first_;  // by particle of the world
    std::vector<SeamEntry> entries_;
};

}  // namespace weft::vulkan
