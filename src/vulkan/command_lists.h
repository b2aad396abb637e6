// Lists of commands that one dispatch runs from the first to the last, a list to a workgroup.
#pragma once

#include "vulkan/command_memory.h"
#include "vulkan/compiled_plan.h"

#include <span>
#include <vector>

namespace weft::vulkan {

/// Particles that a workgroup keeps in its shared memory while it runs a list, whose commands go by that address.
struct PointsAtHand {
    std::uint64_t position = 0;  ///< where they are
    std::uint32_t count = 0;     ///< 0: they stay there
    std::uint64_t sums = 0;  ///< in fixed point, likewise at hand and 0 at first; 0: there are none, or they stay there
};

/// Rows along lines that the largest block has, and those of the largest batch.
struct LineRows {
    std::uint32_t of_block = 0, of_batch = 0;
};
LineRows largest_lines(const ConstraintTable& table);

/// Rows whose numbers a workgroup that solves lines has in its shared memory, beside so many bytes of something else: a
/// batch's if there is room, and not fewer than a block's. 1: none.
std::uint32_t line_rows_at_hand(const gpu::Device& device, const LineRows& rows, std::uint64_t other_bytes = 0);

/// The pipeline of that shader, which solves lines of blocks with so many rows.
Result<const gpu::Pipeline*> lines_pipeline(Programs& programs, std::string_view name, std::uint32_t rows);

class CommandLists {
  public:
    /// `first` is the number of the first command in the memory that the list is built with. Returns the list's number.
    std::uint32_t add(std::span<const Command> commands, std::uint32_t first, const PointsAtHand& points = {},
                      const LineRows& lines = {}, const Repeat& repeat = {});
    Result<Done> build(gpu::Device& device, Programs& programs, const CommandMemory& memory, const std::string& name);

    /// `count` lists from `first` on, side by side. `substep` is added to that of each command.
    void record(gpu::Commands& commands, std::uint32_t first, std::uint32_t count, std::uint32_t substep = 0) const;
    bool empty() const { return lists_.empty(); }

  private:
    struct List {
        std::uint32_t first = 0, count = 0;
        Repeat repeat;
        PointsAtHand points;
        LineRows lines;
    };
    Result<Done> choose_pipeline(const gpu::Device& device, Programs& programs);

    std::vector<List> lists_;
    std::uint32_t widest_ = 0;  ///< invocations of the widest command
    std::uint64_t used_ = 0;    ///< a bit for each shader
    Arena arena_;
    Slot table_;
    const gpu::Pipeline* pipeline_ = nullptr;
};

/// Whether a device can keep so many particles at hand, and their sums, beside what else a workgroup needs.
bool fits_at_hand(const gpu::Device& device, std::uint32_t points, bool sums);

}  // namespace weft::vulkan
