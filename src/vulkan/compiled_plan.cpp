#include "vulkan/compiled_plan.h"

#include "solver/plan/frame_numbers.h"
#include "vulkan/cloth_args.h"
#include "vulkan/command_lists.h"
#include "vulkan/make_command.h"

#include <algorithm>
#include <cassert>
#include <string>

namespace weft::vulkan {
namespace {

class Compiler : ClothArgs {
  public:
    Compiler(Programs& programs, const ClothState& cloth, const WorkBuffers& work, const FrameInput& input,
             const InputShape& shape, const WorldPlan& plan, const PlainStiffness& stiffness, const IslandPart& island)
        : ClothArgs(cloth, work, input, shape, plan, stiffness, island), programs_(programs) {
        const PlannedCloth single_cloth{&model_, shape.targets > 0, shape.grabs > 0, shape.attached};
        const std::span<const LinkTables* const> links(&island_.tables, island_.tables ? 1 : 0);
        passes_ = IslandPlan(plan, {&single_cloth, 1}, links, Sharing::free);
    }

    Result<CompiledPlan> run() {
        CompiledPlan out;
        begin_frame(out.commands);
        add_substeps(out);
        add_frame_end(out);
        if (!errors_.empty()) return errors_;
        return out;
    }

    Result<std::vector<Command>> surface() {
        std::vector<Command> out;
        add_pass(out, {.kind = PassKind::faces}, 0);
        add_pass(out, {.kind = PassKind::normals}, 0);
        add_pass(out, {.kind = PassKind::smooth_faces}, 0);
        add_pass(out, {.kind = PassKind::normals}, 0);
        if (!errors_.empty()) return errors_;
        return out;
    }

  private:
    using List = std::vector<Command>;

    // Leaves out commands without invocations.
    template <class Args>
    Command& add(List& list, std::string_view program, const Args& args, std::uint32_t invocations, const Pass& pass,
                 std::uint32_t substep = 0) {
        Command& command = invocations > 0 ? list.emplace_back() : nothing_;
        command = make_command(programs_, errors_, program, args, invocations);
        command.pass = pass;
        command.substep = substep;
        return command;
    }

    // In place of the usual one of the shader.
    void set_pipeline(Command& command, const Result<const gpu::Pipeline*>& pipeline) {
        if (pipeline) command.pipeline = *pipeline;
        if (!pipeline) errors_.insert(errors_.end(), pipeline.errors().begin(), pipeline.errors().end());
    }

    void begin_frame(List& list) {
        const Pass like_predict{.kind = PassKind::predict};
        const KeepArgs args = keep_args();
        add(list, "keep", args, args.good_kept == 0 ? args.count : std::max(args.count, args.kept_count), like_predict);
        if (has_limits(model_, plan_))
            add(list, "limits", limit_args(), 1, {.kind = PassKind::prolongation}).needs_barrier = false;
        add_passes(list, passes_.frame_begin(), 0);
    }

    void add_passes(List& list, std::span<const IslandPass> passes, std::uint32_t substep) {
        for (const auto& [pass, barrier, single, all] : passes) {
            const std::size_t before = list.size();
            add_pass(list, pass, substep);
            for (std::size_t i = before; i < list.size(); ++i) {
                list[i].single = single && !is_for_all(pass) && !is_grab(pass.kind);
                // The commands before the first pass are not in the plan, so the plan has no barrier after them.
                list[i].needs_barrier = barrier || first_pass_ || i > before;
                first_pass_ = false;
            }
        }
    }

    void add_substeps(CompiledPlan& out) {
        List& list = out.commands;
        // The first and the last substep have passes of their own. Those between differ only by their number.
        if (plan_.substeps > 0) add_substep(list, 0);
        out.repeat = {list.size(), list.size(), 1};
        if (plan_.substeps > 2) {
            add_substep(list, 1);
            out.repeat.end = list.size();
            out.repeat.times = plan_.substeps - 2;
        }
        if (plan_.substeps > 1) add_substep(list, plan_.substeps - 1);
    }

    void add_substep(List& list, std::uint32_t substep) { add_passes(list, passes_.substep(substep), substep); }

    // Normals come after the check for finite numbers, because it may roll the state back.
    void add_frame_end(CompiledPlan& out) {
        const auto is_surface = [](const Pass& pass) { return pass_info(pass.kind).stage == stage_surface; };
        for (const IslandPass& one : passes_.frame_end()) {
            if (!is_surface(one.pass)) add_passes(out.commands, std::span(&one, 1), plan_.substeps - 1);
        }
        const Pass like_velocities{.kind = PassKind::velocities};
        const KeepArgs args = keep_args();
        out.check = out.commands.size();
        add(out.commands, "check", args, args.count, like_velocities);
        out.roll_back = out.commands.size();
        add(out.commands, "roll_back", args, std::max(args.count, args.kept_count), like_velocities);
        for (const IslandPass& one : passes_.frame_end()) {
            if (is_surface(one.pass)) add_pass(out.commands, one.pass, plan_.substeps - 1);
        }
    }

    // Placeholder that marks the time of the pass. FrameRun runs it once for all cloths.
    void add_for_all(List& list, const Pass& pass, std::uint32_t substep) {
        Command& command = list.emplace_back();
        command.groups = 1;
        command.pass = pass;
        command.substep = substep;
    }

    void add_pass(List& list, const Pass& pass, std::uint32_t substep) {
        if (is_for_all(pass)) return add_for_all(list, pass, substep);
        const std::uint32_t points = model_.point_count();
        switch (pass.kind) {
            case PassKind::predict:
                add(list, "predict", particle_args(), points, pass, substep);
                break;
            case PassKind::velocities:
                add(list, "velocities", particle_args(), points, pass, substep);
                break;
            case PassKind::advance:
                add(list, "advance", particle_args(), points, pass, substep);
                break;
            case PassKind::find:
            case PassKind::place:
            case PassKind::list:
            case PassKind::aim:
            case PassKind::detect:
            case PassKind::cloth_contact:
            case PassKind::limit:
            case PassKind::separate:
            case PassKind::track_particles:
            case PassKind::search_particles:
            case PassKind::list_particles:
            case PassKind::overlap_particles:
            case PassKind::push_particles:
            case PassKind::move_particles:
            case PassKind::hold_particles:
            case PassKind::settle_particles:
            case PassKind::watch_tears:
            case PassKind::tear:
            case PassKind::predict_bodies:
            case PassKind::move_bodies:
            case PassKind::finish_bodies:
                break;  // for all cloths only, or never
            case PassKind::couple: {
                const CoupleArgs args = couple_args(pass.constraint);
                add(list, "couple", args, args.count, pass, substep);
                break;
            }
            case PassKind::steady:
            case PassKind::release:
                add(list, std::string(pass_info(pass.kind).name), steady_args(), points, pass, substep);
                break;
            case PassKind::weigh_taut:
                add_taut_weights(list, pass, substep);
                break;
            case PassKind::take_taut:
            case PassKind::free_taut:
                add(list, std::string(pass_info(pass.kind).name), taut_args(), points, pass, substep);
                break;
            case PassKind::targets:
            case PassKind::weigh_attached:
            case PassKind::pull_bodies:
                add_targets(list, pass, substep);
                break;
            case PassKind::hide_grabs:
            case PassKind::hold_grabs:
            case PassKind::grab:
            case PassKind::free_grabs:
                add_grabs(list, pass, substep);
                break;
            case PassKind::project:
            case PassKind::damp:
                pass.source == RowSource::links ? add_links(list, pass, substep) : add_rows(list, pass, substep);
                break;
            case PassKind::correct:
                add_corrections(list, pass, substep);
                break;
            case PassKind::average:
                add_average(list, pass, substep);
                break;
            case PassKind::count_touches:
            case PassKind::touch_bodies:
            case PassKind::contact:
                add_contacts(list, pass, substep);
                break;
            case PassKind::longest_edge:
            case PassKind::find_faces:
            case PassKind::push_faces:
            case PassKind::move_faces:
            case PassKind::hold_faces:
            case PassKind::settle_faces:
            case PassKind::finish_holds:
                add_face_contact(list, pass, substep);
                break;
            case PassKind::restriction:
            case PassKind::interpolation:
            case PassKind::node_correction:
                add_level(list, pass, substep);
                break;
            case PassKind::coarse_limit:
                add_reach(list, pass, substep);
                break;
            case PassKind::prolongation:
                add_prolongation(list, pass, substep);
                break;
            case PassKind::wind:
                add(list, "wind", face_args(), model_.face_stride, pass, substep);
                break;
            case PassKind::air:
                add(list, "air", face_args(), model_.face_stride, pass, substep);
                break;
            case PassKind::faces:
                add(list, "faces", face_args(), model_.face_stride, pass, substep);
                break;
            case PassKind::smooth_faces:
                add(list, "smooth_faces", face_args(), model_.face_stride, pass, substep);
                break;
            case PassKind::push:
                add(list, "push", around_args(), model_.particle_count, pass, substep);
                break;
            case PassKind::normals:
                add(list, "normals", around_args(), model_.particle_count, pass, substep);
                break;
        }
    }

    void add_rows(List& list, const Pass& pass, std::uint32_t substep) {
        const ConstraintTable& table = model_.table(pass.constraint);
        const Batch& batch = table.batches[pass.batch];
        const TableBuffers& buffers = buffers_.tables[static_cast<std::uint32_t>(pass.constraint)];
        const bool plain = plan_.method == Method::pbd;
        if (pass.kind == PassKind::project && !plain && batch.blocks > 0 && plan_.projection == Projection::lines)
            return add_lines(list, pass, substep);
        RowArgs args = row_args(pass.constraint);
        const std::uint32_t invocations = hand_out(args, batch, of_model(buffers.blocks));
        std::string program = pass.kind == PassKind::damp ? "damp_" : plain ? "plain_" : "project_";
        if (pass.kind == PassKind::damp) args.moves = state(PointArray::velocity);
        if (pass.kind == PassKind::project && !plain) args.modes |= use_of_lambda(pass, substep);
        add(list, program + std::string(constraint_info(pass.constraint).name), args, invocations, pass, substep);
    }

    void add_taut_weights(List& list, const Pass& pass, std::uint32_t substep) {
        const TableBuffers& buffers = buffers_.tables[static_cast<std::uint32_t>(pass.constraint)];
        RowArgs args = row_args(pass.constraint);
        args.moves = state(PointArray::velocity);
        args.corrections = work(work_.taut);
        const Batch& batch = model_.table(pass.constraint).batches[pass.batch];
        const std::uint32_t invocations = hand_out(args, batch, of_model(buffers.blocks));
        add(list, "weigh_taut", args, invocations, pass, substep);
    }

    // Links refer to particles by their numbers in the world.
    void add_links(List& list, const Pass& pass, std::uint32_t substep) {
        const LinkBuffers::Table& table = island_.links->table(pass.constraint);
        const bool plain = plan_.method == Method::pbd;
        RowArgs args = row_args(pass.constraint);
        args.position = cloth_.world().address(PointArray::position, 0);
        args.moves = 0;
        args.particles = island_.links->address(table.particles);
        args.fields = island_.links->address(table.fields);
        args.lambda = island_.links->address(table.lambda);
        args.shifts = 0;
        args.plain_positive = args.plain_negative = 1;  // links have no fabric that scales them
        args.stride = table.stride;
        args.modes |= plain ? WEFT_LAMBDA_DISCARD : use_of_lambda(pass, substep);
        const std::uint32_t invocations = hand_out(args, table.batches[pass.batch], 0);
        add(list, (plain ? "plain_" : "project_") + std::string(constraint_info(pass.constraint).name), args,
            invocations, pass, substep);
    }

    void add_lines(List& list, const Pass& pass, std::uint32_t substep) {
        const auto index = static_cast<std::uint32_t>(pass.constraint);
        const ConstraintTable& table = model_.constraints[index];
        const Batch& batch = table.batches[pass.batch];
        const TableBuffers& buffers = buffers_.tables[index];
        const LineArgs args{
            .position = state(PointArray::position),
            .particles = of_model(buffers.particles),
            .fields = of_model(buffers.fields),
            .lambda = state(cloth_.kept),
            .blocks = of_model(buffers.blocks) + std::uint64_t{batch.first_block} * 2 * sizeof(std::uint32_t),
            .scratch = work(work_.line_scratch),
            .remainder = remainder(),
            .frame = input_.frame(),
            .stride = table.stride,
            .count = batch.blocks,
            .lambda_use = use_of_lambda(pass, substep),
            .unused = 0};
        Command& command = add(list, "lines", args, batch.blocks * lane_padding, pass, substep);
        command.groups = batch.blocks;
        command.line_rows = largest_lines(table).of_block;
        set_pipeline(command, lines_pipeline(programs_, "lines", command.line_rows));
    }

    void add_corrections(List& list, const Pass& pass, std::uint32_t substep) {
        const auto index = static_cast<std::uint32_t>(pass.constraint);
        RowArgs args = row_args(pass.constraint);
        const bool plain = plan_.method == Method::pbd;
        args.corrections = work(work_.corrections_of[index]);
        args.sums = work(work_.sums);
        args.share = plain ? 0 : work(work_.share[index]);
        args.count = model_.constraints[index].stride;
        args.modes |= plain ? WEFT_LAMBDA_DISCARD : use_of_lambda(pass, substep);
        add(list, "side_by_side_" + std::string(constraint_info(pass.constraint).name), args, args.count, pass,
            substep);
    }

    void add_average(List& list, const Pass& pass, std::uint32_t substep) {
        const AverageArgs args{.position = state(PointArray::position),
                               .corrections = work(work_.corrections),
                               .sums = work(work_.sums),
                               .offsets = work(work_.gather_offsets),
                               .items = work(work_.gather_items),
                               .remainder = remainder(),
                               .count = model_.point_count(),
                               .mean = plan_.method == Method::pbd ? 1u : 0u};
        add(list, "average", args, args.count, pass, substep);
    }

    static std::uint32_t work_on_targets(const Pass& pass) {
        if (pass.kind == PassKind::pull_bodies) return WEFT_TARGETS_PULL;
        if (pass.kind == PassKind::weigh_attached)
            return pass.batch == weigh_for_levels ? WEFT_TARGETS_WEIGH_FOR_LEVELS : WEFT_TARGETS_WEIGH;
        return pass.batch == targets_all ? WEFT_TARGETS_ALL : WEFT_TARGETS_ON_BODIES;
    }

    void add_targets(List& list, const Pass& pass, std::uint32_t substep) {
        const bool pulls = pass.kind == PassKind::pull_bodies;
        const bool blown = pulls && pass.first_iteration && has_air(plan_);
        const TargetArgs args{.position = state(PointArray::position),
                              .targets = input_.targets(),
                              .poses = input_.motion_poses(),
                              .frame = input_.frame(),
                              .colliders = island_.colliders,
                              .by_face = blown ? state(cloth_.by_face) : 0,
                              .offsets = of_model(buffers_.around_offsets),
                              .items = of_model(buffers_.around_items),
                              .count = shape_.targets,
                              .substep = substep,
                              .pass = work_on_targets(pass),
                              .particles = model_.particle_count};
        if (args.count > 0) add(list, "targets", args, args.count, pass, substep);
    }

    void add_grabs(List& list, const Pass& pass, std::uint32_t substep) {
        const GrabArgs args{.position = state(PointArray::position),
                            .start = state(PointArray::start),
                            .weights = state(cloth_.weights),
                            .faces = of_model(buffers_.faces),
                            .grabs = input_.grabs(),
                            .pulls = input_.pulls(),
                            .frame = input_.frame(),
                            .stride = model_.face_stride,
                            .count = shape_.grabs,
                            .substep = substep,
                            .first_iteration = pass.first_iteration ? 1u : 0u,
                            .per_substep = 1.0f / static_cast<float>(plan_.substeps),
                            .reach = hand_reach_in_edges * model_.mean_edge};
        add(list, pass_info(pass.kind).name, args, 1, pass, substep);
    }

    // Contact with bodies comes before that with other colliders.
    std::uint32_t parts_of_contact(const Pass& pass) const {
        if (island_.bodies == 0) return pass.first_iteration ? WEFT_CONTACT_BEGINS : 0;
        return WEFT_CONTACT_BODIES | (pass.kind == PassKind::count_touches ? WEFT_CONTACT_BEGINS : 0) |
               (pass.kind == PassKind::contact ? WEFT_CONTACT_KEEPS_MARKS : 0);
    }

    void add_contacts(List& list, const Pass& pass, std::uint32_t substep) {
        const ContactArgs args{.position = state(PointArray::position),
                               .start = state(PointArray::start),
                               .velocity = state(PointArray::velocity),
                               .sums = work(work_.contact_sums),
                               .contact_log = work(work_.contact_log),
                               .frame = input_.frame(),
                               .colliders = island_.colliders,
                               .tiles = work(work_.near_tiles),
                               .slots = work(work_.near_slots),
                               .report = input_.report(),
                               .face_sums = work(work_.face_sums),
                               .supports = work(work_.supports),
                               .count = model_.point_count(),
                               .capacity = work_.slot_count,
                               .substep = substep,
                               .first_iteration = pass.first_iteration ? 1u : 0u,
                               .particles = model_.particle_count,
                               .parts = parts_of_contact(pass)};
        if (shape_.colliders == 0) return;
        add(list, "cover", args, near_tiles_of(model_), pass, substep);
        add(list, std::string(pass_info(pass.kind).name), args, args.count, pass, substep);
    }

    void add_face_contact(List& list, const Pass& pass, std::uint32_t substep) {
        if (shape_.colliders == 0) return;
        const FacesByTile& faces = *model_.faces_by_tile;
        const FaceContactArgs args{.position = state(PointArray::position),
                                   .start = state(PointArray::start),
                                   .faces = of_model(buffers_.faces_by_tile),
                                   .contacts = work(work_.face_contacts),
                                   .sums = work(work_.face_sums),
                                   .contact_log = work(work_.contact_log),
                                   .offsets = of_model(buffers_.around_offsets),
                                   .items = of_model(buffers_.around_items),
                                   .frame = input_.frame(),
                                   .colliders = island_.colliders,
                                   .tiles = work(work_.near_tiles),
                                   .slots = work(work_.near_slots),
                                   .stride = faces.stride,
                                   .faces_per_tile = faces.most_in_tile,
                                   .particles = model_.particle_count,
                                   .capacity = work_.slot_count,
                                   .substep = substep,
                                   .sweep = pass.batch};
        const bool by_particle = pass.kind == PassKind::move_faces || pass.kind == PassKind::settle_faces;
        Command& command = add(list, std::string(pass_info(pass.kind).name), args,
                               by_particle ? model_.particle_count : faces.begin.back(), pass, substep);
        if (pass.kind == PassKind::finish_holds) command.groups = 1;
    }

    void add_level(List& list, const Pass& pass, std::uint32_t substep) {
        const CoarseLevel& level = model_.hierarchy[pass.level];
        const WorkBuffers::Level& mine = work_.levels[pass.level];
        LevelArgs args{
            .position = work(mine.position),
            .origin = work(mine.origin),
            .displacement = work(mine.displacement),
            .finer = pass.level == 0 ? state(PointArray::position) : work(work_.levels[pass.level - 1].origin),
            .coarser = 0,
            .begin = of_model(buffers_.levels[pass.level].restriction_begin),
            .nodes = of_model(buffers_.levels[pass.level].restriction_node),
            .weights = of_model(buffers_.levels[pass.level].restriction_weight),
            .remainder = remainder_of_level(pass.level),
            .particles = state(PointArray::position),
            .pinned = shape_.attached ? of_model(buffers_.levels[pass.level].pinned) : 0,
            .node_weight = of_model(buffers_.levels[pass.level].weight),
            .particle_weight = plan_.weighs_taut && pass.level == 0 ? state(cloth_.weights) : 0,
            .stride = 0,
            .count = level.count,
            .heavy = plan_.weighs_taut ? 1u : 0u,
            .unused = 0};
        if (pass.kind == PassKind::interpolation) limits_follow_ = true;
        if (pass.kind == PassKind::restriction) {
            add(list, "restriction", args, level.count, pass, substep);
        } else if (pass.kind == PassKind::node_correction) {
            add(list, "node_correction", args, level.count, pass, substep);
        } else {
            if (pass.level + 1 < model_.hierarchy.size()) follow(args, pass.level + 1);
            add(list, "interpolation", args, level.count, pass, substep);
        }
    }

    // Prolongation of the displacements of `level` to the next finer level.
    void follow(LevelArgs& args, std::uint32_t level) const {
        args.coarser = work(work_.levels[level].displacement);
        args.nodes = of_model(buffers_.levels[level].prolongation_node);
        args.weights = of_model(buffers_.levels[level].prolongation_weight);
        args.stride = model_.hierarchy[level].prolongation.stride;
    }

    void add_prolongation(List& list, const Pass& pass, std::uint32_t substep) {
        LevelArgs args{};
        args.position = state(PointArray::position);
        args.remainder = remainder();
        args.count = model_.particle_count;
        follow(args, 0);
        add(list, "prolongation", args, args.count, pass, substep);
    }

    // One command for all batches and sweeps if one workgroup solves the level.
    void add_level_limits(List& list, const Pass& pass, std::uint32_t substep) {
        const CoarseLevel& level = model_.hierarchy[pass.level];
        const LevelBuffers& buffers = buffers_.levels[pass.level];
        const WorkBuffers::Level& mine = work_.levels[pass.level];
        const LevelLimitArgs args{.position = work(mine.position),
                                  .remainder = remainder_of_level(pass.level),
                                  .particles = of_model(buffers.limits.particles),
                                  .fields = of_model(buffers.limits.fields),
                                  .lambda = work(mine.lambda),
                                  .batches = of_model(buffers.batches),
                                  .frame = input_.frame(),
                                  .limits = state(cloth_.limits),
                                  .stride = level.limits.stride,
                                  .nodes = level.count,
                                  .batch_count = static_cast<std::uint32_t>(level.limits.batches.size()),
                                  .sweeps = coarse_sweeps,
                                  .lambda_use = use_of_lambda(pass, substep),
                                  .unused = 0};
        std::uint32_t widest = 0;
        for (const Batch& batch : level.limits.batches) widest = std::max(widest, batch.serial ? 1 : batch.rows);
        Command& command = add(list, "level_limits", args, widest, pass, substep);
        command.groups = 1;
        command.nodes = level.count;
        set_pipeline(command, level_limits_pipeline(programs_, "level_limits", widest, level.count));
    }

    void add_reach(List& list, const Pass& pass, std::uint32_t substep) {
        if (model_.hierarchy[pass.level].count < nodes_for_many_threads) {
            if (limits_follow_) add_level_limits(list, pass, substep);
            limits_follow_ = false;
            return;
        }
        const ConstraintTable& table = model_.hierarchy[pass.level].limits;
        const TableBuffers& rows = buffers_.levels[pass.level].limits;
        RowArgs args = row_args(ConstraintKind::coarse_limit);
        args.position = work(work_.levels[pass.level].position);
        args.moves = remainder_of_level(pass.level);
        args.particles = of_model(rows.particles);
        args.fields = of_model(rows.fields);
        args.lambda = work(work_.levels[pass.level].lambda);
        args.stride = table.stride;
        args.modes |= use_of_lambda(pass, substep);
        const std::uint32_t invocations = hand_out(args, table.batches[pass.batch], of_model(rows.blocks));
        add(list, "project_coarse_limit", args, invocations, pass, substep);
    }

    Programs& programs_;
    IslandPlan passes_;
    bool first_pass_ = true;
    bool limits_follow_ = false;  ///< the constraints of the level of the last interpolation have no command yet
    Errors errors_;
    Command nothing_;  ///< not in any list
};

}  // namespace

Result<CompiledPlan> compile(Programs& programs, const ClothState& cloth, const WorkBuffers& work,
                             const FrameInput& input, const InputShape& shape, const WorldPlan& plan,
                             const PlainStiffness& stiffness, const IslandPart& island) {
    return Compiler(programs, cloth, work, input, shape, plan, stiffness, island).run();
}

Result<std::vector<Command>> compile_surface(Programs& programs, const ClothState& cloth) {
    return Compiler(programs, cloth, {}, {}, {}, {}, {}, {}).surface();
}

}  // namespace weft::vulkan
