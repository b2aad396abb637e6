#include "solver/plan/step_plan.h"

#include <array>
#include <atomic>
#include <cmath>
#include <tuple>

namespace weft {
namespace {

template <class F>
void for_each_batch(const ClothModel& model, F&& f) {
    for (const ConstraintTable& table : model.constraints) {
        for (std::uint32_t batch = 0; batch < table.batches.size(); ++batch) f(table.kind, batch);
    }
}

}  // namespace

namespace {

// Undoing the part s of an error in k iterations takes the part 1 - (1 - s)^(1/k) in each (Müller et al. 2007,
// "Position Based Dynamics", section 3.3).
float per_iteration(float stiffness, std::uint32_t iterations) {
    return static_cast<float>(1 - std::pow(1 - static_cast<double>(stiffness), 1.0 / iterations));
}

template <class Material>
std::array<float, 2> plain_stiffness(const Fabric& fabric, std::uint32_t iterations) {
    const auto of = [&](int which) {
        return which < 0 ? 1.0f : per_iteration(fabric.body.stiffness[which], iterations);
    };
    return {of(Material::plain[0]), of(Material::plain[1])};
}

// Sweeps over the rows of a level. A level is small, and the more of its error is gone the less is left to the finer
// one.
constexpr std::uint32_t sweeps = 4;

// Nodes of a level that is worth sharing out: a sweep over its rows then takes longer than the barriers between them.
constexpr std::uint32_t nodes_for_many_threads = 2048;

void plan_hierarchy(const ClothModel& model, bool first, std::vector<Pass>& passes) {
    const auto add = [&](PassKind kind, std::uint32_t level, std::uint32_t batch = 0, bool first_sweep = true) {
        const bool alone = model.hierarchy[level].count < nodes_for_many_threads;
        passes.push_back(
            {.kind = kind, .batch = batch, .first_iteration = first && first_sweep, .level = level, .alone = alone});
    };
    for (std::uint32_t i = 0; i < model.hierarchy.size(); ++i) add(PassKind::collect, i);
    for (std::uint32_t i = static_cast<std::uint32_t>(model.hierarchy.size()); i-- > 0;) {
        const auto batches = static_cast<std::uint32_t>(model.hierarchy[i].reach.batches.size());
        add(PassKind::lift, i);
        for (std::uint32_t sweep = 0; sweep < sweeps; ++sweep)
            for (std::uint32_t batch = 0; batch < batches; ++batch) add(PassKind::reach, i, batch, sweep == 0);
        add(PassKind::settle, i);
    }
    if (!model.hierarchy.empty()) passes.push_back({.kind = PassKind::spread});
}

void plan_iteration(const ClothModel& model, const StepSettings& settings, bool first, std::vector<Pass>& passes) {
    if (settings.hierarchy) plan_hierarchy(model, first, passes);
    if (settings.projection == Projection::jacobi) {
        bool any = false;
        for (const ConstraintTable& table : model.constraints) {
            if (table.rows == 0) continue;
            passes.push_back({.kind = PassKind::correct, .constraint = table.kind, .first_iteration = first});
            any = true;
        }
        if (any) passes.push_back({.kind = PassKind::average});
    } else {
        for_each_batch(model, [&](ConstraintKind kind, std::uint32_t batch) {
            passes.push_back({PassKind::project, kind, batch, first});
        });
    }
    // Last, so that an iteration ends with nothing inside a collider.
    if (settings.contacts) passes.push_back({.kind = PassKind::contact, .first_iteration = first});
}

std::uint64_t next_serial() {
    static std::atomic<std::uint64_t> last = 0;
    return ++last;
}

// Once a frame: the cost of one substep's projection. It is implicit, so the longer step stays stable.
void plan_damping(const ClothModel& model, std::vector<Pass>& passes) {
    for_each_batch(model, [&](ConstraintKind kind, std::uint32_t batch) {
        const ConstraintInfo& info = constraint_info(kind);
        if (info.moved == info.arity) passes.push_back({.kind = PassKind::damp, .constraint = kind, .batch = batch});
    });
}

}  // namespace

bool same_plan(const StepPlan& a, const StepPlan& b) {
    if (a.serial != 0 && a.serial == b.serial) return true;
    const auto what = [](const StepPlan& plan) {
        return std::tie(plan.substeps, plan.iterations, plan.method, plan.projection, plan.accumulate, plan.stiffness,
                        plan.frame_begin, plan.substep, plan.frame_end);
    };
    return what(a) == what(b);
}

StepPlan plan_step(const ClothModel& model, const StepSettings& settings) {
    StepPlan plan{.substeps = settings.substeps,
                  .iterations = settings.iterations,
                  .method = settings.method,
                  .projection = resolve(settings.projection, settings.method),
                  .accumulate = settings.accumulate,
                  .frame_begin = {},
                  .substep = {},
                  .frame_end = {},
                  .serial = next_serial()};
#define WEFT_CONSTRAINT(name, Name, particles, moved, lambdas)         \
    plan.stiffness[static_cast<std::uint32_t>(ConstraintKind::name)] = \
        plain_stiffness<Name##Material>(model.fabric, settings.iterations);
#include "physics/constraints.def"
#undef WEFT_CONSTRAINT

    // The wind changes little within a frame; what the cloth makes of it does.
    if (settings.air && settings.wind) plan.frame_begin.push_back({.kind = PassKind::wind});

    if (settings.air) plan.substep.push_back({.kind = PassKind::air});
    if (settings.air) plan.substep.push_back({.kind = PassKind::push});
    plan.substep.push_back({.kind = PassKind::predict});
    if (settings.holds) plan.substep.push_back({.kind = PassKind::hold});
    for (std::uint32_t i = 0; i < settings.iterations; ++i) plan_iteration(model, settings, i == 0, plan.substep);
    plan.substep.push_back({.kind = PassKind::velocities});

    if (model.fabric.body.damping > 0) plan_damping(model, plan.frame_end);
    if (settings.surface) {
        plan.frame_end.push_back({.kind = PassKind::faces});
        plan.frame_end.push_back({.kind = PassKind::normals});
    }
    return plan;
}

bool needs_barrier(const Pass& first, const Pass& second) {
    if (first.alone && second.alone) return false;
    const PassKind before = first.kind, after = second.kind;
    // Work on one particle from what is already its own. Each thread owns the same particles in all of them.
    const auto own = [](PassKind kind) {
        return kind == PassKind::predict || kind == PassKind::hold || kind == PassKind::contact ||
               kind == PassKind::velocities;
    };
    // A sum over triangles or rows of others, into particles of one's own.
    const auto gathers = [](PassKind kind) { return kind == PassKind::push || kind == PassKind::average; };
    if (own(after)) return !own(before) && !gathers(before);
    // Rows side by side read positions and write to places of their own; so do triangles.
    if (after == PassKind::correct) return before != PassKind::correct;
    return !(before == PassKind::wind && after == PassKind::air);
}

namespace {

enum Stage : std::uint32_t {
    stage_air = constraint_kind_count,
    stage_predict,
    stage_hierarchy,
    stage_average,
    stage_contact,
    stage_velocities,
    stage_damp,
    stage_surface,
    stage_end,
};
static_assert(stage_end == stage_patched);

}  // namespace

std::uint32_t stage_of(const Pass& pass) {
    switch (pass.kind) {
        case PassKind::wind:
        case PassKind::air:
        case PassKind::push:
            return stage_air;
        case PassKind::predict:
        case PassKind::hold:
            return stage_predict;
        case PassKind::collect:
        case PassKind::lift:
        case PassKind::reach:
        case PassKind::settle:
        case PassKind::spread:
            return stage_hierarchy;
        case PassKind::project:
        case PassKind::correct:
            return static_cast<std::uint32_t>(pass.constraint);
        case PassKind::average:
            return stage_average;
        case PassKind::contact:
            return stage_contact;
        case PassKind::velocities:
            return stage_velocities;
        case PassKind::damp:
            return stage_damp;
        case PassKind::faces:
        case PassKind::normals:
            return stage_surface;
    }
    return stage_predict;
}

std::string_view stage_name(std::uint32_t stage) {
    constexpr std::array<std::string_view, stage_count - constraint_kind_count> others = {
        "air", "predict", "hierarchy", "average", "contact", "velocities", "damp", "surface", "patched", "fused"};
    return stage < constraint_kind_count ? constraint_info(static_cast<ConstraintKind>(stage)).name
                                         : others[stage - constraint_kind_count];
}

std::string describe(const StepPlan& plan) {
    std::string text;
    const auto list = [&](const std::vector<Pass>& passes) {
        for (std::size_t i = 0, end = 0; i < passes.size(); i = end) {
            const std::uint32_t stage = stage_of(passes[i]);
            for (end = i; end < passes.size() && stage_of(passes[end]) == stage;) ++end;
            text += "  " + std::string(stage_name(stage));
            if (end - i > 1) text += " x" + std::to_string(end - i);
            text += '\n';
        }
    };
    if (!plan.frame_begin.empty()) text += "first:\n";
    list(plan.frame_begin);
    text += std::to_string(plan.substeps) + " times:\n";
    list(plan.substep);
    text += "once a frame:\n";
    list(plan.frame_end);
    return text;
}

}  // namespace weft
