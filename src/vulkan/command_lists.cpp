#include "vulkan/command_lists.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>

namespace weft::vulkan {
namespace {

// As fused.comp has them.
struct ListIn {
    std::uint64_t commands;
    std::uint32_t count, points;
    std::uint64_t position, sums;
    std::uint32_t repeat_begin, repeat_end, times, unused;
};
constexpr std::size_t head_bytes = 16, command_bytes = head_bytes + 128;

// Of shared memory: bins in which tensions are counted, and a few numbers.
constexpr std::uint32_t shared_besides = 512;
constexpr std::uint32_t quanta_per_point = 3;

}  // namespace

bool fits_at_hand(const gpu::Device& device, std::uint32_t points, bool sums) {
    const std::uint64_t each = sizeof(Vec4) + (sums ? quanta_per_point * sizeof(std::uint32_t) : 0);
    return points * each + shared_besides <= device.limits().shared_memory;
}

std::uint32_t line_rows_at_hand(const gpu::Device& device, const LineRows& rows, std::uint64_t other_bytes) {
    constexpr std::uint64_t each = sizeof(Vec4) + sizeof(float);
    const std::uint64_t shared = device.limits().shared_memory;
    const std::uint64_t room = shared > other_bytes ? (shared - other_bytes) / each : 0;
    if (rows.of_block == 0 || room < rows.of_block) return 1;
    // Round numbers: pipelines differ by them.
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

std::uint32_t CommandLists::add(std::span<const Command> commands, const PointsAtHand& points, const LineRows& lines,
                                const Repeat& repeat) {
    List& list = lists_.emplace_back();
    list.times = repeat.times;
    const std::size_t again = repeat.end + (repeat.end - repeat.begin) * (repeat.times - 1);
    list.points = points;
    list.lines = lines;
    for (std::size_t i = 0; i < commands.size(); ++i) {
        if (i == repeat.begin) list.repeat_begin = list.count;
        if (i == repeat.end) list.repeat_end = list.count, i = again;
        const Command& command = commands[i];
        if (command.invocations == 0) continue;
        std::array<std::byte, command_bytes> bytes{};
        const std::array head = {command.program, command.invocations, command.needs_barrier ? 1u : 0u};
        std::memcpy(bytes.data(), head.data(), sizeof head);
        std::memcpy(bytes.data() + head_bytes, command.args.data(), command.arg_bytes);
        list.commands.insert(list.commands.end(), bytes.begin(), bytes.end());
        list.widest = std::max(list.widest, command.invocations);
        ++list.count;
        assert(command.program < 64);
        used_ |= std::uint64_t{1} << command.program;
    }
    return static_cast<std::uint32_t>(lists_.size() - 1);
}

Result<Done> CommandLists::build(gpu::Device& device, Programs& programs, const std::string& name) {
    if (lists_.empty()) return Done{};
    std::vector<Slot> slots;
    for (const List& list : lists_) slots.push_back(arena_.add_array(list.commands));
    table_ = arena_.reserve(lists_.size() * sizeof(ListIn));
    if (auto built = arena_.build(device, "commands of " + name); !built) return built;
    std::vector<ListIn> table;
    for (std::size_t i = 0; i < lists_.size(); ++i) {
        table.push_back({.commands = arena_.address(slots[i]),
                         .count = lists_[i].count,
                         .points = lists_[i].points.count,
                         .position = lists_[i].points.position,
                         .sums = lists_[i].points.sums,
                         .repeat_begin = lists_[i].repeat_begin,
                         .repeat_end = lists_[i].repeat_end,
                         .times = lists_[i].times,
                         .unused = 0});
    }
    if (auto done = upload(device, arena_, table_, std::as_bytes(std::span(table))); !done) return done;
    return choose_pipeline(device, programs);
}

Result<Done> CommandLists::choose_pipeline(const gpu::Device& device, Programs& programs) {
    std::uint32_t widest = 0, points = 1, quanta = 1;
    LineRows lines;
    for (const List& list : lists_) {
        widest = std::max(widest, list.widest);
        points = std::max(points, list.points.count);
        lines.of_block = std::max(lines.of_block, list.lines.of_block);
        lines.of_batch = std::max(lines.of_batch, list.lines.of_batch);
        if (list.points.sums != 0) quanta = std::max(quanta, list.points.count * quanta_per_point);
    }
    const std::uint32_t most = std::min(device.limits().workgroup_invocations, device.limits().workgroup_size[0]);
    const std::uint32_t least = std::max(1u, std::min(64u, most));
    const std::uint64_t taken = shared_besides + points * sizeof(Vec4) + quanta * sizeof(std::uint32_t);
    const std::array constants = {std::clamp(std::bit_ceil(std::max(1u, widest)), least, std::bit_floor(most)),
                                  static_cast<std::uint32_t>(used_),
                                  static_cast<std::uint32_t>(used_ >> 32),
                                  points,
                                  quanta,
                                  line_rows_at_hand(device, lines, taken)};
    auto pipeline = programs.get("fused", constants);
    if (!pipeline) return pipeline.errors();
    pipeline_ = *pipeline;
    for (List& list : lists_) list.commands = {};
    return Done{};
}

void CommandLists::record(gpu::Commands& commands, std::uint32_t first, std::uint32_t count) const {
    struct {
        std::uint64_t lists;
        std::uint32_t first, unused;
    } const args{arena_.address(table_), first, 0};
    commands.bind(*pipeline_);
    commands.push(std::as_bytes(std::span(&args, 1)));
    commands.dispatch(count);
}

}  // namespace weft::vulkan
