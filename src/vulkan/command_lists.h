// Lists of commands. One dispatch runs them: each workgroup runs one list from the first command to the last.
#pragma once

#include "vulkan/command_memory.h"
#include "vulkan/compiled_plan.h"

#include <array>
#include <span>
#include <vector>

namespace weft::vulkan {

/// Particles that a workgroup keeps in shared memory while it runs a list. The list's commands refer to them by
/// `position`, their address in device memory.
struct SharedPoints {
    std::uint64_t position = 0;  ///< address of the first particle
    std::uint32_t count = 0;     ///< 0: they stay in device memory
    std::uint64_t sums = 0;      ///< fixed-point sums in shared memory, initially 0; 0: none, or in device memory
};

/// Numbers of constraints in the largest block of lines and in the largest batch of blocks.
struct LineRows {
    std::uint32_t of_block = 0, of_batch = 0;
};
LineRows largest_lines(const ConstraintTable& table);

/// Number of line constraints that a workgroup keeps in shared memory beside `other_bytes` of other data: those of a
/// whole batch if they fit, and at least those of a block. 1: none.
std::uint32_t shared_line_rows(const gpu::Device& device, const LineRows& rows, std::uint64_t other_bytes = 0);

/// The pipeline of the shader `name` that solves a coarse level with `nodes` nodes, whose largest batch has `widest`
/// constraints.
Result<const gpu::Pipeline*> level_limits_pipeline(Programs& programs, std::string_view name, std::uint32_t widest,
                                                   std::uint32_t nodes);

/// The pipeline of the shader `name` that solves lines, for blocks of at most `rows` constraints.
Result<const gpu::Pipeline*> lines_pipeline(Programs& programs, std::string_view name, std::uint32_t rows);

class CommandLists {
  public:
    /// `first` is the number of the first command in the memory that build() gets. Returns the list's number.
    std::uint32_t add(std::span<const Command> commands, std::uint32_t first, const SharedPoints& points = {},
                      const LineRows& lines = {}, const Repeat& repeat = {});
    /// The pipeline has this shader though no command uses it.
    void keep(std::uint32_t program) { used_[program / 32] |= 1u << program % 32; }
    Result<void> build(gpu::Device& device, Programs& programs, const CommandMemory& memory, const std::string& name);

    /// Runs `count` lists from `first` on in parallel. `substep` is added to that of each command.
    void record(gpu::Commands& commands, std::uint32_t first, std::uint32_t count, std::uint32_t substep = 0) const;
    bool empty() const { return lists_.empty(); }

  private:
    struct List {
        std::uint32_t first = 0, count = 0;
        Repeat repeat;
        SharedPoints points;
        LineRows lines;
    };
    Result<void> choose_pipeline(const gpu::Device& device, Programs& programs);

    std::vector<List> lists_;
    std::uint32_t widest_ = 0;             ///< invocations of the widest command
    std::uint32_t nodes_ = 0;              ///< of the largest coarse level
    std::array<std::uint32_t, 3> used_{};  ///< one bit per shader that a command uses
    Arena arena_;
    Slot table_;
    const gpu::Pipeline* pipeline_ = nullptr;
};

/// Whether shared memory has room for `points` particles, and with `sums` for their sums, beside a workgroup's other
/// data.
bool fits_shared_memory(const gpu::Device& device, std::uint32_t points, bool sums);

}  // namespace weft::vulkan
