#include "solver/plan/island_plan.h"

#include <algorithm>

namespace weft {
namespace {

// One thread solves a coarse level if sharing it costs more than it saves.
bool is_single(std::span<const PlannedCloth> cloths, const Pass& pass) {
    if (pass.kind == PassKind::place || pass.kind == PassKind::search_particles || is_cloth_contact(pass.kind) ||
        is_grab(pass.kind) || is_body_pass(pass.kind))
        return true;
    if (pass.source != RowSource::level || pass.kind == PassKind::prolongation) return false;
    std::size_t nodes = 0;
    for (const PlannedCloth& cloth : cloths)
        nodes += takes_part(cloth, pass) ? cloth.model->hierarchy[pass.level].count : 0;
    return nodes < nodes_for_many_threads;
}

}  // namespace

IslandPlan::IslandPlan(const WorldPlan& plan, std::span<const PlannedCloth> cloths,
                       std::span<const LinkTables* const> links, Sharing sharing)
    : substeps_(plan.substeps) {
    Barriers barriers(sharing);
    const auto add = [&](std::vector<IslandPass>& list, const Pass& pass) {
        const auto has_work = [&](const PlannedCloth& one) { return takes_part(one, pass); };
        const auto have_work = [&](const LinkTables* tables) { return takes_part(*tables, pass); };
        if (std::ranges::none_of(links, have_work) && std::ranges::none_of(cloths, has_work)) return;
        const bool single = is_single(cloths, pass);
        list.push_back({pass, barriers.before(pass, single), single, std::ranges::all_of(cloths, has_work)});
    };
    const auto add_substep = [&](std::vector<IslandPass>& list, std::uint32_t substep) {
        const SubstepPasses now = passes_of(plan, substep);
        for (const Pass& pass : now.passes) add(list, pass);
        if (now.advance) add(list, {.kind = PassKind::advance});
    };
    for (const Pass& pass : plan.frame_begin) add(frame_begin_, pass);
    add_substep(first_, 0);
    if (plan.substeps > 2) {
        // The second substep may need other barriers than the following ones. One list for all has the barriers of
        // both.
        add_substep(middle_, 1);
        std::vector<IslandPass> again;
        add_substep(again, 1);
        for (std::size_t i = 0; i < middle_.size(); ++i) middle_[i].barrier |= again[i].barrier;
    }
    if (plan.substeps > 1) add_substep(last_, plan.substeps - 1);
    for (const Pass& pass : plan.frame_end) add(frame_end_, pass);
}

}  // namespace weft
