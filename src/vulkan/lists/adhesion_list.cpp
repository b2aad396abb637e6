#include "vulkan/lists/adhesion_list.h"

#include "solver/model/constraint_table.h"
#include "vulkan/make_command.h"
#include "vulkan/primitives/scan.h"

#include <cassert>

namespace weft::vulkan {
namespace {

constexpr std::uint64_t size_of_word = sizeof(std::uint32_t);

// Sizes of the GLSL layout.
static_assert(sizeof(ListMemberIn) == 32 && sizeof(ListArgs) == 112);

}  // namespace

Result<std::unique_ptr<AdhesionList>> AdhesionList::create(gpu::Device& device, Programs& programs,
                                                           const WorldPlan& plan, std::span<const Member> members,
                                                           std::uint64_t position, std::uint64_t limits,
                                                           std::uint32_t capacity, const std::string& name) {
    auto self = std::unique_ptr<AdhesionList>(new AdhesionList(device, programs, plan));
    std::vector<ListMemberIn> list;
    std::uint64_t items = 0;
    for (const Member& member : members) {
        list.push_back({.frame = member.frame,
                        .colliders = member.colliders,
                        .report = member.report,
                        .base = member.base,
                        .first = static_cast<std::uint32_t>(items)});
        self->first_item_.push_back(static_cast<std::uint32_t>(items));
        items += member.particles;
    }
    self->first_item_.push_back(static_cast<std::uint32_t>(items));
    if (items > most_elements) return too_many(items, "particles that may stick");
    const auto& info = constraint_info(ConstraintKind::adhesion);
    const std::uint64_t stride = padded(capacity);
    Arena& arena = self->arena_;
    const Slot table = arena.add_array(list), places = arena.reserve((items + 1) * size_of_word),
               particles = arena.reserve(stride * size_of_word),
               fields = arena.reserve(info.fields.size() * stride * size_of_word),
               share = arena.reserve(stride * size_of_word), targets = arena.reserve(stride * sizeof(Vec4)),
               corrections = arena.reserve(stride * sizeof(Vec4)),
               lambda = arena.reserve(info.lambdas * stride * size_of_word),
               scratch = arena.reserve(scan_scratch(static_cast<std::uint32_t>(items)));
    self->head_ = arena.reserve(WEFT_LIST_HEAD_WORDS * size_of_word);
    if (auto built = arena.build(device, "list of " + name, VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT); !built)
        return built.errors();
    auto back = device.memory().buffer(size_of_word, gpu::MemoryKind::readback, "length of the list of " + name);
    if (!back) return back.errors();
    self->back_ = std::move(*back);
    self->scratch_ = arena.address(scratch);
    auto rows = programs.get("side_by_side_adhesion");
    if (!rows) return rows.errors();
    self->args_ = {.members = arena.address(table),
                   .position = position,
                   .places = arena.address(places),
                   .particles = arena.address(particles),
                   .fields = arena.address(fields),
                   .share = arena.address(share),
                   .targets = arena.address(targets),
                   .corrections = arena.address(corrections),
                   .head = arena.address(self->head_),
                   .member_count = static_cast<std::uint32_t>(list.size()),
                   .items = static_cast<std::uint32_t>(items),
                   .capacity = capacity,
                   .stride = static_cast<std::uint32_t>(stride),
                   .substep = 0,
                   .mean = plan.method == Method::pbd ? 1u : 0u,
                   .group = (*rows)->workgroup(),
                   .widest = device.limits().workgroup_count[0],
                   .first = 0,
                   .end = static_cast<std::uint32_t>(items)};
    // Adhesion has no fabric that scales it as a plain constraint, so it is corrected fully.
    self->rows_ = {.position = position,
                   .moves = 0,
                   .particles = self->args_.particles,
                   .fields = self->args_.fields,
                   .lambda = arena.address(lambda),
                   .corrections = self->args_.corrections,
                   .sums = 0,
                   .share = plan.method == Method::pbd ? 0 : self->args_.share,
                   .blocks = 0,
                   .frame = members.front().frame,
                   .limits = limits,
                   .shifts = {},
                   .plain_positive = 1,
                   .plain_negative = 1,
                   .stride = self->args_.stride,
                   .begin = 0,
                   .count = capacity,
                   .modes = WEFT_LAMBDA_DISCARD | WEFT_ROWS_SINGLE};
    return self;
}

Result<void> AdhesionList::run(gpu::Commands& commands, std::string_view program, const ListArgs& args,
                               std::uint32_t items) const {
    auto pipeline = programs_.get(program);
    if (!pipeline) return pipeline.errors();
    items > 0 ? commands.barrier() : commands.indirect_barrier();
    commands.bind(**pipeline);
    commands.push(std::as_bytes(std::span(&args, 1)));
    if (items > 0) {
        dispatch_groups(commands, groups_of(items, (*pipeline)->workgroup()), device_.limits());
    } else {
        assert((*pipeline)->workgroup() == args.group);
        commands.dispatch_indirect(arena_.buffer(), head_.offset);
    }
    return {};
}

Result<void> AdhesionList::record_rows(gpu::Commands& commands, const Pass& pass, std::uint32_t substep) const {
    Errors errors;
    RowArgs args = rows_;
    if (plan_.method != Method::pbd) args.modes |= number_of(lambda_use(plan_, pass, substep, rounds_of_links(plan_)));
    const Command command = make_command(programs_, errors, "side_by_side_adhesion", args, args.count);
    if (!errors.empty()) return errors;
    commands.barrier();  // aim() has made the number of workgroups visible
    bind(commands, command, substep);
    commands.dispatch_indirect(arena_.buffer(), head_.offset);
    return {};
}

Result<void> AdhesionList::record(gpu::Commands& commands, const Pass& pass, std::uint32_t substep,
                                  std::uint32_t member) const {
    ListArgs args = args_;
    args.substep = substep;
    if (member != none) args.first = first_item_[member], args.end = first_item_[member + 1];
    switch (pass.kind) {
        case PassKind::find:
            return run(commands, "find_adhesion", args, args.items);
        case PassKind::place: {
            Recorder recorder(device_, programs_, commands);
            const std::uint64_t second = args.places + size_of_word;  // the first place stays 0
            record_scan(recorder, second, second, args.items, scratch_, true);
            if (auto recorded = recorder.end(); !recorded) return recorded;
            return run(commands, "list_size", args, 1);
        }
        case PassKind::list:
            return run(commands, "list_adhesion", args, args.items);
        case PassKind::aim:
            return run(commands, "aim_adhesion", args, 0);
        case PassKind::correct:
            return record_rows(commands, pass, substep);
        default:
            return run(commands, "list_gather", args, args.end - args.first);
    }
}

void AdhesionList::record_end(gpu::Commands& commands) const {
    commands.copy(arena_.buffer(), back_, size_of_word, head_.offset + WEFT_LIST_WANTED * size_of_word, 0);
}

}  // namespace weft::vulkan
