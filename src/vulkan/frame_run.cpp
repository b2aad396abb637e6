#include "vulkan/frame_run.h"

#include "solver/measures/diagnosis.h"
#include "solver/plan/frame_numbers.h"
#include "vulkan/shaders.h"

#include <algorithm>

namespace weft::vulkan {

bool fits_fused(const gpu::Device& device, const ClothModel& model) {
    return fits_shared_memory(device, model.capacity(), false);
}

FrameRun::FrameRun(gpu::Device& device, Programs& programs, const WorldPlan& plan, std::uint64_t serial,
                   std::span<const Member> members, Execution execution)
    : device_(device),
      programs_(programs),
      plan_(plan),
      serial_(serial),
      members_(members.begin(), members.end()),
      execution_(execution) {}

Result<std::unique_ptr<FrameRun>> FrameRun::create(gpu::Device& device, Programs& programs, const WorldPlan& plan,
                                                   std::uint64_t serial, std::span<const Member> members,
                                                   Execution execution, bool timings, const Lists& lists) {
    auto self = std::unique_ptr<FrameRun>(new FrameRun(device, programs, plan, serial, members, execution));
    if (auto compiled = self->compile_members(lists); !compiled) return compiled.errors();
    if (auto made = self->make_lists(lists); !made) return made.errors();
    for (Member& member : self->members_) member.seams = nullptr;  // valid only during create()
    auto recorded = execution == Execution::fused ? self->record_fused(timings) : self->record_passes(timings);
    if (!recorded) return recorded.errors();
    if (auto prepared = self->prepare_contact_forces(); !prepared) return prepared.errors();
    return self;
}

// All cloths of a frame have the same colliders, so the first member decides for all. Surfaces of colliders have none.
Result<void> FrameRun::prepare_contact_forces() {
    if (!members_.front().shape.contact_forces) return {};
    std::vector<ContactReadback::Member> members;
    for (std::size_t i = 0; i < members_.size(); ++i) {
        const ClothState& cloth = members_[i].cloth->state();
        const Arena& work = work_[i].arena;
        const std::uint32_t colliders = members_[i].shape.colliders;
        const std::uint64_t contact_log = work.address(work_[i].contact_log);
        members.push_back({.account = {.position = cloth.address(PointArray::position),
                                       .moved = contact_log,
                                       .turned = contact_log + work_[i].contact_log.bytes / 2,
                                       .report = buffers_.input(first_of_island(i)).report(),
                                       .frame = buffers_.input(i).frame(),
                                       .sums = 0,
                                       .tiles = work.address(work_[i].near_tiles),
                                       .slots = work.address(work_[i].near_slots),
                                       .tile_count = colliders > 0 ? near_tiles_of(cloth.model()) : 0,
                                       .particles = cloth.model().particle_count,
                                       .first_slot = 0,
                                       .first_pair = 0},
                           .colliders = colliders,
                           .slots = work_[i].slot_count});
    }
    auto contacts = ContactReadback::create(device_, programs_, members, name());
    if (!contacts) return contacts.errors();
    contacts_ = std::move(*contacts);
    return {};
}

std::uint32_t FrameRun::read_contact_forces(std::size_t member, ClothContactLog& to) {
    return contacts_ ? contacts_->read(member, to) : std::uint32_t{report_none};
}

void FrameRun::add_contact_marks(const Cloth& cloth, std::span<std::uint32_t> marks) const {
    const std::uint32_t base = cloth.state().base();
    if (cloth_contact_ && cloth.model().tiles) cloth_contact_->add_marks(base, marks);
    if (particle_contact_ && cloth.model().along_curve) particle_contact_->add_marks(base, marks);
}

Result<void> FrameRun::compile_members(const Lists& lists) {
    std::vector<InputShape> shapes;
    for (const Member& member : members_) shapes.push_back(member.shape);
    auto buffers = FrameBuffers::create(device_, shapes, name());
    if (!buffers) return buffers.errors();
    buffers_ = std::move(*buffers);
    work_.reserve(members_.size());
    links_.reserve(members_.size());
    for (std::size_t i = 0; i < members_.size(); ++i) {
        const Member& member = members_[i];
        const std::uint32_t slots =
            std::max(member.cloth->state().near_slots,
                     first_near_slots(member.cloth->model(), member.shape.colliders, lists.first_capacity));
        auto work = WorkBuffers::create(device_, member.cloth->model(), plan_, member.shape, slots);
        if (!work) return work.errors();
        work_.push_back(std::move(*work));
        IslandPart island{.report = buffers_.input(first_of_island(i)).report(),
                          .colliders = lists.colliders,
                          .bodies = lists.bodies ? lists.bodies->address() : 0};
        if (member.links) {
            auto links = LinkBuffers::create(device_, *member.links, plan_);
            if (!links) return links.errors();
            links_.push_back(std::move(*links));
            island.tables = member.links;
            island.links = &links_.back();
        }
        auto plan = compile(programs_, member.cloth->state(), work_.back(), buffers_.input(i), member.shape, plan_,
                            member.stiffness, island);
        if (!plan) return plan.errors();
        plans_.push_back(std::move(*plan));
        first_command_.push_back(memory_.add(plans_.back().commands));
    }
    for (Member& member : members_) member.links = nullptr;  // valid only during create()
    return memory_.build(device_, name());
}

Result<void> FrameRun::make_lists(const Lists& lists) {
    if (auto made = make_adhesion(lists); !made) return made;
    if (auto made = make_cloth_contact(lists); !made) return made;
    if (auto made = make_particle_contact(lists); !made) return made;
    if (auto made = make_bodies(lists); !made) return made;
    return make_tearing();
}

Result<void> FrameRun::make_bodies(const Lists& lists) {
    if (!lists.bodies || lists.bodies->empty()) return {};
    bodies_ = lists.bodies;
    bodies_serial_ = bodies_->serial();
    colliders_ = lists.colliders;
    std::vector<std::uint64_t> reports;
    for (std::size_t i = 0; i < members_.size(); ++i) reports.push_back(buffers_.input(i).report());
    return bodies_->set_reports(device_, reports);
}

Result<void> FrameRun::make_tearing() {
    std::vector<const ClothState*> cloths;
    for (const Member& member : members_) cloths.push_back(&member.cloth->state());
    auto made = Tearing::create(device_, programs_, cloths, name());
    if (!made) return made.errors();
    tearing_ = std::move(*made);
    return {};
}

Result<void> FrameRun::make_cloth_contact(const Lists& lists) {
    std::vector<ClothContact::Member> members;
    bool any = false;
    for (std::size_t i = 0; i < members_.size(); ++i) {
        const FrameInput& input = buffers_.input(i);
        const bool moves = members_[i].cloth->model().collision.surface && members_[i].shape.targets > 0;
        members.push_back({&members_[i].cloth->state(), input.frame(), input.report(), moves ? input.motion_poses() : 0,
                           members_[i].seams});
        any = any || members_[i].cloth->model().tiles;
    }
    if (!any) return {};
    auto made = ClothContact::create(device_, programs_, members, lists.cloth_contact, lists.first_capacity,
                                     lists.search_always, lists.records_marks, name());
    if (!made) return made.errors();
    cloth_contact_ = std::move(*made);
    return {};
}

Result<void> FrameRun::make_particle_contact(const Lists& lists) {
    if (!has_particle_contact(plan_)) return {};
    std::vector<ParticleContact::Member> members;
    bool any = false;
    for (std::size_t i = 0; i < members_.size(); ++i) {
        const FrameInput& input = buffers_.input(i);
        members.push_back({&members_[i].cloth->state(), input.frame(), input.report(), members_[i].seams});
        any = any || members_[i].cloth->model().along_curve;
    }
    if (!any) return {};
    auto made = ParticleContact::create(device_, programs_, members, lists.particle_pairs, lists.first_capacity,
                                        lists.search_always, lists.records_marks, name());
    if (!made) return made.errors();
    particle_contact_ = std::move(*made);
    return {};
}

Result<void> FrameRun::record_for_all(gpu::Commands& commands, const Pass& pass, std::uint32_t substep,
                                      std::uint32_t member) const {
    if (pass.source == RowSource::dynamic) return adhesion_->record(commands, pass, substep, member);
    // A replay of one cloth alone leaves contact out, whose results are always finite for finite positions.
    if (member != none) return {};
    if (is_body_pass(pass.kind)) return bodies_->record(device_, programs_, commands, colliders_, pass, substep);
    if (is_particle_contact(pass.kind)) return particle_contact_->record(commands, pass, substep);
    if (!is_cloth_contact(pass.kind)) return tearing_->record(commands, pass);
    return cloth_contact_->record(commands, pass, substep);
}

Result<void> FrameRun::make_adhesion(const Lists& lists) {
    const auto& begin = plan_.frame_begin;
    if (std::ranges::find(begin, PassKind::find, &Pass::kind) == begin.end()) return {};
    std::vector<AdhesionList::Member> members;
    for (std::size_t i = 0; i < members_.size(); ++i) {
        const ClothState& cloth = members_[i].cloth->state();
        const FrameInput& input = buffers_.input(i);
        members.push_back({.frame = input.frame(),
                           .colliders = lists.colliders,
                           .report = input.report(),
                           .base = cloth.base(),
                           .particles = cloth.model().particle_count});
    }
    const ClothState& first = members_.front().cloth->state();
    auto made = AdhesionList::create(device_, programs_, plan_, members, first.world().address(PointArray::position, 0),
                                     first.address(first.limits), lists.adhesion, name());
    if (!made) return made.errors();
    adhesion_ = std::move(*made);
    return {};
}

std::size_t FrameRun::first_of_island(std::size_t member) const {
    while (member > 0 && members_[member - 1].island == members_[member].island) --member;
    return member;
}

std::uint32_t FrameRun::report(std::size_t member) const {
    return buffers_.report(member) | (buffers_.report(first_of_island(member)) & report_non_finite);
}

Result<void> FrameRun::begin_recording(bool timings, std::size_t stages) {
    auto commands = gpu::Commands::create(device_, timings ? static_cast<std::uint32_t>(stages + 1) : 0);
    if (!commands) return commands.errors();
    commands_ = std::move(*commands);
    if (auto begun = commands_->begin(); !begun) return begun;
    commands_->collect_uncompiled();
    buffers_.record_begin(*commands_);
    if (cloth_contact_) cloth_contact_->record_begin(*commands_);
    return bodies_ ? bodies_->record_begin(device_, programs_, *commands_, colliders_) : Result<void>();
}

Result<void> FrameRun::end_recording() {
    commands_->stamp();
    buffers_.record_end(*commands_);
    if (adhesion_) adhesion_->record_end(*commands_);
    if (cloth_contact_) {
        if (auto recorded = cloth_contact_->record_end(*commands_); !recorded) return recorded;
    }
    if (particle_contact_) particle_contact_->record_end(*commands_);
    if (tearing_) tearing_->record_end(*commands_);
    if (bodies_) bodies_->record_end(*commands_);
    if (adhesion_ || cloth_contact_ || particle_contact_ || tearing_) commands_->host_barrier();
    return commands_->end();
}

template <class Record>
Result<void> FrameRun::record_frame(bool timings, std::size_t stages, Record&& record) {
    for (bool compiled = false; true; compiled = true) {
        if (auto begun = begin_recording(timings, stages); !begun) return begun;
        if (auto recorded = record(); !recorded) return recorded;
        if (auto ended = end_recording(); !ended) return ended;
        if (compiled || commands_->uncompiled().empty()) return {};
        if (auto made = gpu::compile_together(commands_->uncompiled()); !made) return made;
    }
}

Result<void> FrameRun::record_fused(bool timings) {
    for (std::size_t i = 0; i < members_.size(); ++i) {
        const Cloth& cloth = *members_[i].cloth;
        SharedPoints points;
        // Padding of constraint tables acts on dummies, which are the last of the capacity.
        if (const std::uint32_t count = cloth.model().capacity(); fits_fused(device_, cloth.model())) {
            const std::uint64_t position = cloth.state().address(PointArray::position);
            points = {.position = position, .count = count};
            if (fits_shared_memory(device_, count, true)) points.sums = work_[i].arena.address(work_[i].sums);
        }
        const bool lines = plan_.projection == Projection::lines;
        lists_.add(plans_[i].commands, first_command_[i], points,
                   lines ? largest_lines(cloth.model().table(ConstraintKind::stretch)) : LineRows{}, plans_[i].repeat);
    }
    // So that the first grab needs no other pipeline, which takes some drivers seconds to compile.
    for (const char* const grab : {"hide_grabs", "hold_grabs", "grab", "free_grabs"}) lists_.keep(shader_number(grab));
    if (auto built = lists_.build(device_, programs_, memory_, name()); !built) return built;
    stages_ = {stage_fused};
    return record_frame(timings, 1, [&]() -> Result<void> {
        commands_->barrier();
        commands_->stamp();
        lists_.record(*commands_, 0, static_cast<std::uint32_t>(members_.size()));
        return {};
    });
}

Result<void> FrameRun::record_passes(bool timings) {
    const SharedPlan shared = share_passes(plans_, execution_ == Execution::grouped);
    std::vector<std::uint32_t> lists;  // per pass: its first list
    for (const SharedPass& pass : shared.passes) {
        std::uint32_t first = none;
        for (const PlanPart& part : pass.parts) {
            if (!pass.is_list) break;
            const std::span<const Command> commands(plans_[part.member].commands);
            const std::uint32_t list = lists_.add(commands.subspan(part.begin, part.end - part.begin),
                                                  first_command_[part.member] + part.begin);
            first = std::min(first, list);
        }
        lists.push_back(first);
    }
    if (auto built = lists_.build(device_, programs_, memory_, name()); !built) return built;
    auto built = dispatches_.build(device_, programs_, shared, plans_, memory_, first_command_, name());
    if (!built) return built;

    run_through(shared.passes.size(), shared.repeat, [&](std::size_t i, std::uint32_t) {
        const std::uint32_t stage = stage_of(shared.passes[i].pass);
        if (stages_.empty() || stages_.back() != stage) stages_.push_back(stage);
        return true;
    });
    return record_frame(timings, stages_.size(), [&] { return record_passes(shared, lists); });
}

Result<void> FrameRun::record_passes(const SharedPlan& shared, std::span<const std::uint32_t> lists) {
    std::uint32_t last = stage_count;
    Errors errors;
    run_through(shared.passes.size(), shared.repeat, [&](std::size_t i, std::uint32_t substep) {
        const SharedPass& pass = shared.passes[i];
        if (const std::uint32_t stage = stage_of(pass.pass); stage != last) commands_->stamp(), last = stage;
        if (is_for_all(pass.pass)) {
            const PlanPart& part = pass.parts.front();
            auto recorded =
                record_for_all(*commands_, pass.pass, plans_[part.member].commands[part.begin].substep + substep);
            if (!recorded) return errors = recorded.errors(), false;
        } else if (pass.is_list) {
            commands_->barrier();
            lists_.record(*commands_, lists[i], static_cast<std::uint32_t>(pass.parts.size()), substep);
        } else {
            dispatches_.record(*commands_, i, substep, device_.limits());
        }
        return true;
    });
    if (!errors.empty()) return errors;
    return {};
}

Result<std::uint64_t> FrameRun::submit(const StepInput& input, std::span<const ClothStep* const> steps, bool again) {
    if (contacts_) {
        if (auto prepared = contacts_->prepare(); !prepared) return prepared.errors();
    }
    if (cloth_contact_) cloth_contact_->set_tangle(input.tangle);
    seconds_.clear();
    for (std::size_t i = 0; i < members_.size(); ++i) {
        const Member& member = members_[i];
        const ClothState& cloth = member.cloth->state();
        const bool heavier = work_[i].taut.bytes > 0 || work_[i].steady_parts.bytes > 0;
        buffers_.input(i).write(cloth.model(), plan_, input, *steps[i], cloth.substep_seconds, again,
                                {.weights = heavier ? cloth.address(cloth.weights) : 0,
                                 .thickness = cloth.thickness.bytes > 0 ? cloth.address(cloth.thickness) : 0});
        seconds_.push_back(lambda_seconds(plan_, input.dt));
    }
    auto value = commands_->submit();
    return value && contacts_ ? contacts_->submit() : value;
}

bool FrameRun::near_list_was_full() const {
    for (std::size_t i = 0; i < members_.size(); ++i)
        if (buffers_.report(i) & report_near_full) return true;
    return false;
}

Result<void> FrameRun::roll_back_and_grow() {
    auto done = gpu::run_once(device_, [&](gpu::Commands& commands) {
        buffers_.record_reports(commands, report_list_full);
        commands.barrier();
        for (const CompiledPlan& plan : plans_) record(commands, plan.commands[plan.roll_back], 0, device_.limits());
    });
    if (!done) return done;
    for (std::size_t i = 0; i < members_.size(); ++i) {
        if (!(buffers_.report(i) & report_near_full)) continue;
        // The count of a tile that had no room leaves out what it would have found later in the frame.
        const std::uint64_t before = work_[i].slot_count, wanted = buffers_.near_slots(i);
        if (before == most_near_slots) return Error{"", "too many colliders near tiles of " + name()};
        members_[i].cloth->state().near_slots = static_cast<std::uint32_t>(
            std::min<std::uint64_t>(std::max(2 * before, wanted + wanted / 2), most_near_slots));
    }
    return {};
}

void FrameRun::finish(std::array<double, stage_count>& stage_ms) {
    for (std::size_t i = 0; i < members_.size(); ++i) members_[i].cloth->state().substep_seconds = seconds_[i];
    const std::vector<double> intervals = commands_->intervals();
    for (std::size_t i = 0; i < intervals.size(); ++i) stage_ms[stages_[i]] += intervals[i];
}

Result<FrameRun::Place> FrameRun::download_place(const Cloth& cloth) const {
    auto positions = cloth.state().download_points(device_, PointArray::position);
    if (!positions) return positions.errors();
    auto velocities = cloth.state().download_points(device_, PointArray::velocity);
    if (!velocities) return velocities.errors();
    return Place{std::move(*positions), std::move(*velocities)};
}

// Runs the cloth's frame again, command by command.
Result<std::string> FrameRun::replay(std::size_t member) {
    const Cloth& cloth = *members_[member].cloth;
    const CompiledPlan& plan = plans_[member];
    Result<std::string> found = std::string(late_non_finite);
    run_through(plan.check, plan.repeat, [&](std::size_t i, std::uint32_t substep) {
        const Command& command = plan.commands[i];
        if (auto done = run(command, substep, member); !done) return found = done.errors(), false;
        if (command.pass.kind == PassKind::damp) return true;
        const auto place = download_place(cloth);
        if (!place) return found = place.errors(), false;
        const std::uint32_t particle = first_non_finite(place->positions, place->velocities);
        if (particle == none) return true;
        found = name_pass(cloth.model(), command.pass, command.substep + substep, particle);
        return false;
    });
    return found;
}

// Submits a single command and waits for it.
Result<void> FrameRun::run(const Command& command, std::uint32_t substep, std::size_t member) {
    Result<void> recorded;
    auto done = gpu::run_once(device_, [&](gpu::Commands& now) {
        if (is_for_all(command.pass)) {
            recorded = record_for_all(now, command.pass, command.substep + substep, static_cast<std::uint32_t>(member));
        } else {
            record(now, command, substep, device_.limits());
        }
    });
    return recorded ? done : recorded;
}

Result<std::string> FrameRun::find_non_finite(std::size_t member, const StepInput& input, const ClothStep& step) {
    Cloth& cloth = *members_[member].cloth;
    const auto before = download_place(cloth);
    if (!before) return before.errors();
    if (std::string culprit = name_input(input, step.motion_poses, before->positions, before->velocities);
        !culprit.empty())
        return culprit;
    auto found = replay(member);
    // The report still has the non-finite flag, so this command restores the state.
    const CompiledPlan& plan = plans_[member];
    if (auto done = run(plan.commands[plan.roll_back], 0, member); !done) return done.errors();
    if (auto updated = cloth.update_normals(); !updated) return updated.errors();
    return found;
}

}  // namespace weft::vulkan
