#include "vulkan/command_lists.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>

namespace weft::vulkan {
namespace {

// Same layout as in fused.comp.
struct ListIn {
    std::uint64_t commands;
    std::uint32_t count, points;
    std::uint64_t position, sums;
    std::uint32_t repeat_begin, repeat_end, times, unused;
};
// Bytes of shared memory for other purposes: the histogram of limits.glsl and a few numbers.
constexpr std::uint32_t shared_besides = 512;
constexpr std::uint32_t quanta_per_point = 3;
// Shared memory for a constraint of lines.glsl.
constexpr std::uint64_t line_row_bytes = sizeof(Vec4) + sizeof(float);

// A workgroup with an invocation per item, as far as the device can, and a power of two.
std::uint32_t workgroup_for(const gpu::Device& device, std::uint32_t items) {
    const std::uint32_t most = std::min(device.limits().workgroup_invocations, device.limits().workgroup_size[0]);
    const std::uint32_t least = std::max(1u, std::min(64u, most));
    return std::clamp(std::bit_ceil(std::max(1u, items)), least, std::bit_floor(most));
}

// Room for `nodes` in elements of `element` bytes beside other data, or 1 if there is not enough. Rounded up, because
// each different number needs its own pipeline.
std::uint32_t room_for_nodes(const gpu::Device& device, std::uint32_t nodes, std::uint64_t element,
                             std::uint64_t other_bytes) {
    constexpr std::uint32_t step = 256;
    const std::uint64_t shared = device.limits().shared_memory, rounded = (nodes + step - 1) / step * step;
    for (const std::uint64_t room : {rounded, std::uint64_t{nodes}})
        if (nodes > 0 && room * element + other_bytes <= shared) return static_cast<std::uint32_t>(room);
    return 1;
}

}  // namespace

bool fits_shared_memory(const gpu::Device& device, std::uint32_t points, bool sums) {
    const std::uint64_t each = sizeof(Vec4) + (sums ? quanta_per_point * sizeof(std::uint32_t) : 0);
    return points * each + shared_besides <= device.limits().shared_memory;
}

std::uint32_t shared_line_rows(const gpu::Device& device, const LineRows& rows, std::uint64_t other_bytes) {
    const std::uint64_t shared = device.limits().shared_memory;
    const std::uint64_t room = shared > other_bytes ? (shared - other_bytes) / line_row_bytes : 0;
    if (rows.of_block == 0 || room < rows.of_block) return 1;
    // Rounded up, because each different number needs its own pipeline.
    constexpr std::uint64_t step = 256;
    return static_cast<std::uint32_t>(std::min(room, (rows.of_batch + step - 1) / step * step));
}

LineRows largest_lines(const ConstraintTable& table) {
    LineRows largest;
    for (const LineBlock& block : table.blocks)
        largest.of_block = std::max(largest.of_block, block.length * lane_padding);
    for (const Batch& batch : table.batches) {
        if (batch.blocks == 0) continue;
        const LineBlock& last = table.blocks[batch.first_block + batch.blocks - 1];
        largest.of_batch = std::max(largest.of_batch, last.end() - table.blocks[batch.first_block].begin);
    }
    return largest;
}

Result<const gpu::Pipeline*> lines_pipeline(Programs& programs, std::string_view name, std::uint32_t rows) {
    const gpu::Device& device = programs.device();
    const std::array constants = {std::min(256u, device.limits().workgroup_size[0]),
                                  shared_line_rows(device, {rows, rows})};
    return programs.get(name, constants);
}

Result<const gpu::Pipeline*> level_limits_pipeline(Programs& programs, std::string_view name, std::uint32_t widest,
                                                   std::uint32_t nodes) {
    const gpu::Device& device = programs.device();
    const std::array constants = {workgroup_for(device, widest), room_for_nodes(device, nodes, sizeof(Vec4), 0)};
    return programs.get(name, constants);
}

std::uint32_t CommandLists::add(std::span<const Command> commands, std::uint32_t first, const SharedPoints& points,
                                const LineRows& lines, const Repeat& repeat) {
    lists_.push_back({.first = first,
                      .count = static_cast<std::uint32_t>(commands.size()),
                      .repeat = repeat,
                      .points = points,
                      .lines = lines});
    for (const Command& command : commands) {
        widest_ = std::max(widest_, command.invocations);
        nodes_ = std::max(nodes_, command.nodes);
        keep(command.program);
    }
    return static_cast<std::uint32_t>(lists_.size() - 1);
}

Result<void> CommandLists::build(gpu::Device& device, Programs& programs, const CommandMemory& memory,
                                 const std::string& name) {
    if (lists_.empty()) return {};
    std::vector<ListIn> table;
    for (const List& list : lists_) {
        table.push_back({.commands = memory.address(list.first),
                         .count = list.count,
                         .points = list.points.count,
                         .position = list.points.position,
                         .sums = list.points.sums,
                         .repeat_begin = static_cast<std::uint32_t>(list.repeat.begin),
                         .repeat_end = static_cast<std::uint32_t>(list.repeat.end),
                         .times = list.repeat.times,
                         .unused = 0});
    }
    table_ = arena_.add_array(table);
    if (auto built = arena_.build(device, "lists of " + name); !built) return built;
    return choose_pipeline(device, programs);
}

Result<void> CommandLists::choose_pipeline(const gpu::Device& device, Programs& programs) {
    std::uint32_t points = 1, quanta = 1;
    LineRows lines;
    for (const List& list : lists_) {
        points = std::max(points, list.points.count);
        lines.of_block = std::max(lines.of_block, list.lines.of_block);
        lines.of_batch = std::max(lines.of_batch, list.lines.of_batch);
        if (list.points.sums != 0) quanta = std::max(quanta, list.points.count * quanta_per_point);
    }
    const std::uint64_t taken = shared_besides + points * sizeof(Vec4) + quanta * sizeof(std::uint32_t);
    // Lines and coarse levels take turns in the same memory (level_limits.glsl). Lines without room need it to be 1.
    std::uint32_t line_rows = shared_line_rows(device, lines, taken);
    if (lines.of_block == 0 || line_rows > 1)
        line_rows = std::max(line_rows, room_for_nodes(device, nodes_, line_row_bytes, taken));
    const std::array constants = {
        workgroup_for(device, widest_), used_[0], used_[1], points, quanta, line_rows, used_[2]};
    auto pipeline = programs.get("fused", constants);
    if (!pipeline) return pipeline.errors();
    pipeline_ = *pipeline;
    return {};
}

void CommandLists::record(gpu::Commands& commands, std::uint32_t first, std::uint32_t count,
                          std::uint32_t substep) const {
    struct {
        std::uint64_t lists;
        std::uint32_t first, substep;
    } const args{arena_.address(table_), first, substep};
    commands.bind(*pipeline_);
    commands.push(std::as_bytes(std::span(&args, 1)));
    commands.dispatch(count);
}

}  // namespace weft::vulkan
