#include "solver/step_plan.h"

#include <array>

namespace weft {
namespace {

template <class F>
void for_each_batch(const ClothModel& model, F&& f) {
    for (const ConstraintTable& table : model.constraints) {
        for (std::uint32_t batch = 0; batch < table.batches.size(); ++batch) f(table.kind, batch);
    }
}

}  // namespace

StepPlan plan_step(const ClothModel& model, const StepSettings& settings) {
    StepPlan plan{.substeps = settings.substeps, .iterations = settings.iterations, .substep = {}, .frame_end = {}};

    plan.substep.push_back({.kind = PassKind::predict});
    if (settings.holds) plan.substep.push_back({.kind = PassKind::hold});
    for (std::uint32_t i = 0; i < settings.iterations; ++i) {
        for_each_batch(model, [&](ConstraintKind kind, std::uint32_t batch) {
            plan.substep.push_back({PassKind::project, kind, batch, i == 0});
        });
        // Last, so that an iteration ends with nothing inside a collider.
        if (settings.contacts) plan.substep.push_back({.kind = PassKind::contact, .first_iteration = i == 0});
    }
    plan.substep.push_back({.kind = PassKind::velocities});

    // Once a frame: the cost of one substep's projection. It is implicit, so the longer step stays stable.
    if (model.fabric.body.damping > 0) {
        for_each_batch(model, [&](ConstraintKind kind, std::uint32_t batch) {
            const ConstraintInfo& info = constraint_info(kind);
            if (info.moved < info.arity) return;
            plan.frame_end.push_back({.kind = PassKind::damp, .constraint = kind, .batch = batch});
        });
    }
    if (settings.surface) {
        plan.frame_end.push_back({.kind = PassKind::faces});
        plan.frame_end.push_back({.kind = PassKind::normals});
    }
    return plan;
}

namespace {

enum Stage : std::uint32_t {
    stage_predict = constraint_kind_count,
    stage_contact,
    stage_velocities,
    stage_damp,
    stage_surface,
    stage_end,
};
static_assert(stage_end == stage_count);

}  // namespace

std::uint32_t stage_of(const Pass& pass) {
    switch (pass.kind) {
        case PassKind::predict:
        case PassKind::hold:
            return stage_predict;
        case PassKind::project:
            return static_cast<std::uint32_t>(pass.constraint);
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
    constexpr std::array<std::string_view, 5> others = {"predict", "contact", "velocities", "damp", "surface"};
    return stage < constraint_kind_count ? constraint_info(static_cast<ConstraintKind>(stage)).name
                                         : others[stage - constraint_kind_count];
}

std::string describe(const StepPlan& plan) {
    std::string text = std::to_string(plan.substeps) + " times:\n";
    const auto list = [&](const std::vector<Pass>& passes) {
        for (std::size_t i = 0, end = 0; i < passes.size(); i = end) {
            const std::uint32_t stage = stage_of(passes[i]);
            for (end = i; end < passes.size() && stage_of(passes[end]) == stage;) ++end;
            text += "  " + std::string(stage_name(stage));
            if (end - i > 1) text += " x" + std::to_string(end - i);
            text += '\n';
        }
    };
    list(plan.substep);
    text += "once a frame:\n";
    list(plan.frame_end);
    return text;
}

}  // namespace weft
