#include "vulkan/dispatches.h"

#include "vulkan/command_lists.h"
#include "vulkan/shaders.h"

#include <algorithm>
#include <cassert>

namespace weft::vulkan {
namespace {

// Same layout as in dispatch.glsl.
struct MemberIn {
    std::uint64_t command;
    std::uint32_t first_group, unused;
};
static_assert(sizeof(MemberIn) == 16);

// The pass that begins at command `begin` of the plan, and where it ends.
SharedPass next_pass(const CompiledPlan& plan, std::size_t begin, std::size_t end, bool grouped) {
    const Command& first = plan.commands[begin];
    SharedPass pass{.pass = first.pass, .program = first.program, .needs_barrier = first.needs_barrier, .parts = {}};
    std::size_t last = begin + 1;
    if (grouped && first.single)
        while (last < end && plan.commands[last].single) ++last;
    pass.is_list = last - begin > 1;
    pass.parts = {{0, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(last)}};
    return pass;
}

bool go_together(const SharedPass& a, const SharedPass& b) {
    if (a.is_list || b.is_list) return a.is_list && b.is_list;
    return a.program == b.program && a.pass == b.pass;
}

// Merges commands [begin, end) of a plan into `passes`: each command joins the next equal pass. If there is none, the
// command becomes a pass of its own at this point.
void join(std::vector<SharedPass>& passes, const CompiledPlan& plan, std::uint32_t member, std::size_t begin,
          std::size_t end, bool grouped) {
    std::size_t at = 0;
    while (begin < end) {
        SharedPass pass = next_pass(plan, begin, end, grouped);
        pass.parts.front().member = member;
        begin = pass.parts.front().end;
        const auto from = passes.begin() + static_cast<std::ptrdiff_t>(at);
        const auto same = std::find_if(from, passes.end(), [&](const auto& one) { return go_together(one, pass); });
        if (same == passes.end()) {
            passes.insert(from, std::move(pass));
            ++at;
        } else {
            same->parts.push_back(pass.parts.front());
            same->needs_barrier = same->needs_barrier || pass.needs_barrier;
            at = static_cast<std::size_t>(same - passes.begin()) + 1;
        }
    }
}

const Command& command_of(std::span<const CompiledPlan> plans, const PlanPart& part) {
    return plans[part.member].commands[part.begin];
}

// The pipeline for many cloths. For lines, it has room for the largest block of all cloths; for a coarse level, for the
// largest level.
Result<const gpu::Pipeline*> pipeline_for_many(Programs& programs, std::span<const CompiledPlan> plans,
                                               const SharedPass& pass) {
    std::uint32_t line_rows = 0, nodes = 0, widest = 0;
    for (const PlanPart& part : pass.parts) {
        const Command& command = command_of(plans, part);
        line_rows = std::max(line_rows, command.line_rows);
        nodes = std::max(nodes, command.nodes);
        widest = std::max(widest, command.invocations);
    }
    const std::string name = std::string(shaders()[pass.program].name) + "_many";
    if (nodes > 0) return level_limits_pipeline(programs, name, widest, nodes);
    return line_rows > 0 ? lines_pipeline(programs, name, line_rows) : programs.get(name);
}

}  // namespace

SharedPlan share_passes(std::span<const CompiledPlan> plans, bool grouped) {
    SharedPlan shared;
    const auto append = [&](auto begin_of, auto end_of) {
        std::vector<SharedPass> passes;
        for (std::uint32_t m = 0; m < plans.size(); ++m)
            join(passes, plans[m], m, begin_of(plans[m]), end_of(plans[m]), grouped);
        std::ranges::move(passes, std::back_inserter(shared.passes));
    };
    const auto start = [](const CompiledPlan&) { return std::size_t{0}; };
    const auto repeat_begin = [](const CompiledPlan& plan) { return plan.repeat.begin; };
    const auto repeat_end = [](const CompiledPlan& plan) { return plan.repeat.end; };
    const auto end = [](const CompiledPlan& plan) { return plan.commands.size(); };
    append(start, repeat_begin);
    shared.repeat = {shared.passes.size(), 0, plans.front().repeat.times};
    append(repeat_begin, repeat_end);
    shared.repeat.end = shared.passes.size();
    append(repeat_end, end);
    assert(std::ranges::all_of(plans, [&](const auto& plan) { return plan.repeat.times == shared.repeat.times; }));
    return shared;
}

Result<void> Dispatches::build(gpu::Device& device, Programs& programs, const SharedPlan& shared,
                               std::span<const CompiledPlan> plans, const CommandMemory& memory,
                               std::span<const std::uint32_t> first, const std::string& name) {
    std::vector<MemberIn> table;
    std::vector<std::size_t> in_table;  // per pass: index of its first entry
    for (const SharedPass& pass : shared.passes) {
        Dispatch& dispatch = dispatches_.emplace_back();
        dispatch.needs_barrier = pass.needs_barrier;
        in_table.push_back(table.size());
        if (pass.is_list || is_for_all(pass.pass)) continue;
        const Command& one = command_of(plans, pass.parts.front());
        if (pass.parts.size() == 1) {
            dispatch.single = &one;
            continue;
        }
        auto pipeline = pipeline_for_many(programs, plans, pass);
        if (!pipeline) return pipeline.errors();
        dispatch.pipeline = *pipeline;
        ManyArgs& args = dispatch.args;
        args.members = static_cast<std::uint32_t>(pass.parts.size());
        args.groups_each = workgroups_of(one);
        for (const PlanPart& part : pass.parts) {
            const std::uint32_t groups = workgroups_of(command_of(plans, part));
            table.push_back({memory.address(first[part.member] + part.begin), args.groups, 0});
            if (groups != args.groups_each) args.groups_each = 0;
            args.groups += groups;
        }
    }
    if (table.empty()) return {};
    const Slot slot = arena_.add_array(table);
    if (auto built = arena_.build(device, "dispatches of " + name); !built) return built;
    for (std::size_t i = 0; i < dispatches_.size(); ++i)
        dispatches_[i].args.table = arena_.address(slot) + in_table[i] * sizeof(MemberIn);
    return {};
}

void Dispatches::record(gpu::Commands& commands, std::size_t pass, std::uint32_t substep,
                        const gpu::DeviceLimits& limits) const {
    const Dispatch& dispatch = dispatches_[pass];
    if (dispatch.single) return vulkan::record(commands, *dispatch.single, substep, limits);
    if (dispatch.needs_barrier) commands.barrier();
    ManyArgs args = dispatch.args;
    args.substep = substep;
    assert(sizeof args == dispatch.pipeline->push_constants());
    commands.bind(*dispatch.pipeline);
    commands.push(std::as_bytes(std::span(&args, 1)));
    dispatch_groups(commands, args.groups, limits);
}

}  // namespace weft::vulkan
