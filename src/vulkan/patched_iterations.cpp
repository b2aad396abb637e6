#include "vulkan/patched_iterations.h"

#include "vulkan/args.data.h"
#include "vulkan/make_command.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>

namespace weft::vulkan {
namespace {

/// What each iteration of a plan does.
struct Iteration {
    std::vector<ConstraintKind> corrects;
    bool contact = false;
    friend bool operator==(const Iteration&, const Iteration&) = default;
};

// Nothing if the plan's iterations differ, or have more in them.
std::optional<Iteration> iteration_of(const StepPlan& plan) {
    if (plan.projection != Projection::jacobi) return std::nullopt;
    std::vector<Iteration> iterations;
    bool over = true;  // the last one has begun with what a next one does not begin with
    for (const Pass& pass : plan.substep) {
        if (pass.kind == PassKind::correct) {
            if (over) iterations.emplace_back();
            over = false;
            iterations.back().corrects.push_back(pass.constraint);
        } else if (PatchedIterations::covers(pass)) {
            if (iterations.empty()) return std::nullopt;
            over = true;
            if (pass.kind == PassKind::contact) iterations.back().contact = true;
        } else if (!iterations.empty() && pass.kind != PassKind::velocities) {
            return std::nullopt;
        }
    }
    if (iterations.size() != plan.iterations || iterations.empty()) return std::nullopt;
    if (std::ranges::any_of(iterations, [&](const Iteration& one) { return one != iterations.front(); }))
        return std::nullopt;
    return iterations.front();
}

// Iterations of each dispatch: an even number of those, as positions go to a second place and back.
std::vector<std::uint32_t> divide(std::uint32_t iterations, std::uint32_t most) {
    std::uint32_t count = (iterations + most - 1) / most;
    count += count % 2;
    std::vector<std::uint32_t> sizes(count, iterations / count);
    for (std::uint32_t i = 0; i < iterations % count; ++i) ++sizes[i];
    return sizes;
}

// Bytes of shared memory that a particle takes: its position and, in fixed point, its sum.
std::uint32_t most_points(const gpu::Device& device, const StepPlan& plan) {
    std::uint32_t points = 0;
    const bool sums = plan.accumulate == Accumulate::fixed_point;
    for (std::uint32_t step = 1u << 14; step > 0; step /= 2)
        if (fits_at_hand(device, points + step, sums)) points += step;
    return points;
}

struct RowPlaces {
    std::uint64_t particles = 0, fields = 0, rows = 0, share = 0, lambda = 0;
};

struct Places {
    std::uint64_t points = 0, offsets = 0, items = 0, corrections = 0, contact_sums = 0;
    std::array<RowPlaces, constraint_kind_count> rows;
};

}  // namespace

/// Lays patches out on the device, then makes the lists.
class PatchBuilder {
  public:
    PatchBuilder(gpu::Device& device, Programs& programs, const ClothState& cloth, const WorkBuffers& work,
                 const FrameInput& input, const InputShape& shape, const StepPlan& plan, Iteration iteration)
        : device_(device),
          programs_(programs),
          cloth_(cloth),
          model_(cloth.model()),
          work_(work),
          input_(input),
          shape_(shape),
          plan_(plan),
          iteration_(std::move(iteration)) {}

    Result<std::optional<PatchedIterations>> run(CommandLists& lists) {
        std::optional<PatchedIterations> none_fits;
        if (!cut()) return none_fits;
        PatchedIterations out;
        if (auto done = lay_out(out.arena_); !done) return done.errors();
        out.patches_ = static_cast<std::uint32_t>(patches_.size());
        add_lists(out, lists);
        if (!errors_.empty()) return errors_;
        return std::optional<PatchedIterations>(std::move(out));
    }

  private:
    /// Which of a substep's dispatches: those alike share their lists.
    struct Dispatch {
        std::uint32_t iterations = 0;
        bool first = false;  ///< of the substep
        bool back = false;   ///< from the second place to the first
        auto operator<=>(const Dispatch&) const = default;
    };

    bool plain() const { return plan_.method == Method::pbd; }
    std::uint32_t lambda_use(bool first) const {
        if (plain()) return WEFT_LAMBDA_DISCARD;
        return first ? WEFT_LAMBDA_STORE : WEFT_LAMBDA_ACCUMULATE;
    }
    bool fixed() const { return plan_.accumulate == Accumulate::fixed_point; }
    const ConstraintTable& table(ConstraintKind kind) const { return model_.table(kind); }

    // Some patches have more around them than the one that the shape was chosen by: then smaller ones.
    bool cut() {
        const std::uint32_t room = most_points(device_, plan_);
        gather_ = build_gather(model_);
        for (std::uint32_t aim = room;; aim -= aim / 4) {
            const auto shape = choose_patch_shape(model_, gather_, plan_.iterations, aim);
            if (!shape) return false;
            patches_ = cut_into_patches(model_, gather_, *shape);
            rings_ = shape->rings;
            for (const Patch& patch : patches_)
                while (rings_ > 1 && patch.within[rings_] > room) --rings_;
            if (rings_ > 1) return true;
        }
    }

    template <class T, class Range>
    static std::uint64_t append(std::vector<T>& to, const Range& values) {
        const std::uint64_t at = to.size() * sizeof(T);
        to.insert(to.end(), values.begin(), values.end());
        return at;
    }

    Result<Done> lay_out(Arena& arena) {
        std::vector<std::uint32_t> uints;
        std::vector<float> floats;
        std::uint64_t lambdas = 0, blocks = 0;
        for (const Patch& patch : patches_) {
            Places& at = places_.emplace_back();
            at.points = append(uints, patch.points);
            at.offsets = append(uints, patch.offsets);
            at.items = append(uints, patch.items);
            at.corrections = blocks * sizeof(Vec4);
            if (!fixed()) blocks += patch.blocks;
            at.contact_sums = blocks * sizeof(Vec4);
            if (iteration_.contact) blocks += std::uint64_t{shape_.colliders} * patch.points.size();
            for (const ConstraintKind kind : iteration_.corrects) {
                const PatchRows& rows = patch.tables[static_cast<std::uint32_t>(kind)];
                RowPlaces& of = at.rows[static_cast<std::uint32_t>(kind)];
                of.particles = append(uints, rows.particles);
                of.rows = append(uints, rows.rows);
                of.fields = append(floats, fields_of(kind, rows));
                of.share = append(floats, shares_of(kind, rows));
                of.lambda = lambdas * sizeof(float);
                lambdas += constraint_info(kind).lambdas * rows.rows.size();
            }
        }
        const Slot uint_slot = arena.add_array(uints), float_slot = arena.add_array(floats);
        const Slot lambda_slot = arena.reserve(plain() ? 0 : lambdas * sizeof(float));
        const Slot block_slot = arena.reserve(blocks * sizeof(Vec4));
        const Slot position = arena.reserve(std::uint64_t{model_.capacity()} * sizeof(Vec4));
        const Slot sums = arena.reserve(work_.contact_sums.bytes);
        std::array<Slot, constraint_kind_count> lambda;
        for (const ConstraintKind kind : iteration_.corrects)
            lambda[static_cast<std::uint32_t>(kind)] =
                arena.reserve(plain() ? 0 : table(kind).lambda_count() * sizeof(float));
        if (auto built = arena.build(device_, "patches of " + model_.name); !built) return built;

        second_.points = arena.address(position);
        second_.contact_sums = arena.address(sums);
        for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind)
            second_.rows[kind].lambda = arena.address(lambda[kind]);
        for (Places& at : places_) {
            for (std::uint64_t* place : {&at.points, &at.offsets, &at.items}) *place += arena.address(uint_slot);
            for (std::uint64_t* place : {&at.corrections, &at.contact_sums}) *place += arena.address(block_slot);
            for (RowPlaces& of : at.rows) {
                for (std::uint64_t* place : {&of.particles, &of.rows}) *place += arena.address(uint_slot);
                for (std::uint64_t* place : {&of.fields, &of.share}) *place += arena.address(float_slot);
                of.lambda += arena.address(lambda_slot);
            }
        }
        return Done{};
    }

    std::vector<float> fields_of(ConstraintKind kind, const PatchRows& rows) const {
        std::vector<float> fields;
        fields.reserve(table(kind).field_count * rows.rows.size());
        for (std::uint32_t field = 0; field < table(kind).field_count; ++field)
            for (const std::uint32_t row : rows.rows)
                fields.push_back(table(kind).fields[std::size_t{field} * table(kind).stride + row]);
        return fields;
    }

    std::vector<float> shares_of(ConstraintKind kind, const PatchRows& rows) const {
        std::vector<float> shares;
        if (plain()) return shares;
        for (const std::uint32_t row : rows.rows)
            shares.push_back(gather_.share[static_cast<std::uint32_t>(kind)][row]);
        return shares;
    }

    void add_lists(PatchedIterations& out, CommandLists& lists) {
        std::map<Dispatch, std::uint32_t> made;
        const std::vector<std::uint32_t> sizes = divide(plan_.iterations, rings_);
        for (std::size_t d = 0; d < sizes.size(); ++d) {
            const Dispatch dispatch{sizes[d], d == 0, d % 2 == 1};
            const auto [at, is_new] = made.try_emplace(dispatch, 0);
            if (is_new) at->second = add_lists(dispatch, lists);
            out.dispatches_.push_back(at->second);
        }
    }

    std::uint32_t add_lists(const Dispatch& dispatch, CommandLists& lists) {
        std::uint32_t first = none;
        for (std::size_t i = 0; i < patches_.size(); ++i) {
            const Patch& patch = patches_[i];
            const std::uint64_t position = cloth_.address(cloth_.position);
            const PointsAtHand points{.position = dispatch.back ? second_.points : position,
                                      .count = patch.within[dispatch.iterations],
                                      .to = dispatch.back ? position : second_.points,
                                      .owned = patch.within[0],
                                      .indices = places_[i].points,
                                      .sums = fixed() ? work_.arena.address(work_.sums) : 0};
            const std::uint32_t list = lists.add(commands_of(patch, places_[i], dispatch, points.position), points);
            first = std::min(first, list);
        }
        return first;
    }

    template <class Args>
    Command& add(std::vector<Command>& list, std::string_view program, const Args& args, std::uint32_t invocations) {
        list.push_back(make_command(programs_, errors_, program, args, invocations));
        return list.back();
    }

    std::vector<Command> commands_of(const Patch& patch, const Places& at, const Dispatch& dispatch,
                                     std::uint64_t position) {
        std::vector<Command> list;
        if (!dispatch.first) carry_over(list, patch, at, dispatch, false);
        for (std::uint32_t i = 0; i < dispatch.iterations; ++i) {
            const std::uint32_t ring = dispatch.iterations - 1 - i;
            const bool first = dispatch.first && i == 0;
            for (const ConstraintKind kind : iteration_.corrects)
                add_correct(list, kind, patch, at, ring, first, position);
            const AverageArgs average{.position = position,
                                      .corrections = at.corrections,
                                      .sums = work_.arena.address(work_.sums),
                                      .offsets = at.offsets,
                                      .items = at.items,
                                      .count = patch.within[ring],
                                      .mean = plain() ? 1u : 0u};
            add(list, "average", average, average.count);
            if (iteration_.contact && shape_.colliders > 0) add_contact(list, patch, at, ring, first, position);
        }
        carry_over(list, patch, at, dispatch, true);
        return list;
    }

    void add_correct(std::vector<Command>& list, ConstraintKind kind, const Patch& patch, const Places& at,
                     std::uint32_t ring, bool first, std::uint64_t position) {
        const auto index = static_cast<std::uint32_t>(kind);
        const PatchRows& rows = patch.tables[index];
        const RowPlaces& of = at.rows[index];
        const RowArgs args{.position = position,
                           .velocity = 0,
                           .particles = of.particles,
                           .fields = of.fields,
                           .lambda = of.lambda,
                           .corrections = at.corrections + std::uint64_t{patch.first[index]} * sizeof(Vec4),
                           .sums = work_.arena.address(work_.sums),
                           .share = plain() ? 0 : of.share,
                           .blocks = 0,
                           .frame = input_.frame(),
                           .limits = cloth_.address(cloth_.limits),
                           .plain_positive = plan_.stiffness[index][0],
                           .plain_negative = plan_.stiffness[index][1],
                           .stride = static_cast<std::uint32_t>(rows.rows.size()),
                           .begin = 0,
                           .count = rows.within[ring],
                           .lambda_use = lambda_use(first),
                           .hand_out = WEFT_ROWS_SINGLE,
                           .unused = 0};
        const bool again = kind != iteration_.corrects.front();
        add(list, "side_by_side_" + std::string(constraint_info(kind).name), args, args.count).needs_barrier = !again;
    }

    void add_contact(std::vector<Command>& list, const Patch& patch, const Places& at, std::uint32_t ring, bool first,
                     std::uint64_t position) {
        const ContactArgs args{.position = position,
                               .start = cloth_.address(cloth_.start),
                               .sums = at.contact_sums,
                               .particles = at.points,
                               .felt = work_.arena.address(work_.felt),
                               .frame = input_.frame(),
                               .colliders = input_.colliders(),
                               .poses = input_.poses(),
                               .count = patch.within[ring],
                               .capacity = static_cast<std::uint32_t>(patch.points.size()),
                               .substep = 0,
                               .first_iteration = first ? 1u : 0u,
                               .felt_capacity = model_.capacity(),
                               .owned = patch.within[0]};
        add(list, "contact", args, args.count);
    }

    // What later iterations go on from, besides positions: to the patch as the others left it, or back from it.
    void carry_over(std::vector<Command>& list, const Patch& patch, const Places& at, const Dispatch& dispatch,
                    bool back) {
        const bool from_second = dispatch.back, to_second = !dispatch.back;
        const std::uint32_t ring = dispatch.iterations - 1;
        bool again = false;
        const auto copy = [&](std::uint64_t whole, std::uint64_t mine, std::uint64_t index, std::uint32_t count,
                              std::uint32_t whole_stride, std::uint32_t stride, std::uint32_t planes,
                              std::uint32_t width) {
            if (planes == 0) return;
            const CopyArgs args{.whole = whole,
                                .part = mine,
                                .index = index,
                                .whole_stride = whole_stride,
                                .part_stride = stride,
                                .planes = planes,
                                .width = width,
                                .count = count,
                                .back = back ? 1u : 0u};
            add(list, "copy", args, count).needs_barrier = !again;
            again = true;
        };
        const bool second = back ? to_second : from_second;
        for (const ConstraintKind kind : iteration_.corrects) {
            if (plain()) break;
            const auto index = static_cast<std::uint32_t>(kind);
            const PatchRows& rows = patch.tables[index];
            const std::uint64_t first = kind == ConstraintKind::stretch ? cloth_.address(cloth_.lambda)
                                                                        : work_.arena.address(work_.lambda[index]);
            copy(second ? second_.rows[index].lambda : first, at.rows[index].lambda, at.rows[index].rows,
                 back ? rows.owned : rows.within[ring], table(kind).stride,
                 static_cast<std::uint32_t>(rows.rows.size()), constraint_info(kind).lambdas, 1);
        }
        if (!iteration_.contact) return;
        copy(second ? second_.contact_sums : work_.arena.address(work_.contact_sums), at.contact_sums, at.points,
             back ? patch.within[0] : patch.within[ring], model_.capacity(),
             static_cast<std::uint32_t>(patch.points.size()), shape_.colliders, 4);
    }

    gpu::Device& device_;
    Programs& programs_;
    const ClothState& cloth_;
    const ClothModel& model_;
    const WorkBuffers& work_;
    const FrameInput& input_;
    const InputShape& shape_;
    const StepPlan& plan_;
    Iteration iteration_;
    JacobiGather gather_;
    std::vector<Patch> patches_;
    std::uint32_t rings_ = 0;
    std::vector<Places> places_;
    Places second_;  ///< where what a dispatch leaves lies, every other time
    Errors errors_;
};

Result<std::optional<PatchedIterations>> PatchedIterations::create(gpu::Device& device, Programs& programs,
                                                                   const ClothState& cloth, const WorkBuffers& work,
                                                                   const FrameInput& input, const InputShape& shape,
                                                                   const StepPlan& plan, CommandLists& lists) {
    auto iteration = iteration_of(plan);
    if (!iteration) return std::optional<PatchedIterations>();
    return PatchBuilder(device, programs, cloth, work, input, shape, plan, std::move(*iteration)).run(lists);
}

void PatchedIterations::record(gpu::Commands& commands, const CommandLists& lists, std::uint32_t substep) const {
    for (const std::uint32_t first : dispatches_) {
        commands.barrier();
        lists.record(commands, first, patches_, substep);
    }
}

}  // namespace weft::vulkan
