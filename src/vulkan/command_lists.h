// Lists of commands that one dispatch runs from the first to the last, a list to a workgroup.
#pragma once

#include "vulkan/compiled_plan.h"

#include <span>
#include <vector>

namespace weft::vulkan {

/// Particles that a workgroup keeps in its shared memory while it runs a list.
struct PointsAtHand {
    std::uint64_t position = 0;  ///< where they live
    std::uint32_t count = 0;     ///< 0: they stay there
};

class CommandLists {
  public:
    /// Commands without anything to do are left out. Returns the list's number.
    std::uint32_t add(std::span<const Command> commands, const PointsAtHand& points = {});
    Result<Done> build(gpu::Device& device, Programs& programs, const std::string& name);

    /// `count` lists from `first` on, side by side.
    void record(gpu::Commands& commands, std::uint32_t first, std::uint32_t count) const;
    bool empty() const { return lists_.empty(); }

  private:
    struct List {
        std::vector<std::byte> commands;
        std::uint32_t count = 0, widest = 0;  ///< invocations of the widest command
        PointsAtHand points;
    };
    Result<Done> choose_pipeline(const gpu::Device& device, Programs& programs);

    std::vector<List> lists_;
    std::uint64_t used_ = 0;  ///< a bit for each shader
    Arena arena_;
    Slot table_;
    const gpu::Pipeline* pipeline_ = nullptr;
};

/// Whether a device can keep so many particles at hand, beside what else a workgroup needs.
bool fits_at_hand(const gpu::Device& device, std::uint32_t points);

}  // namespace weft::vulkan
