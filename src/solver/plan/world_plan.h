// The step as data: one list of passes for the whole world, which every backend executes and which reads like a table
// of contents. A cloth takes part in a pass or has no work in it.
#pragma once

#include "scene/scene_desc.h"
#include "solver/model/cloth_model.h"
#include "solver/plan/pass.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace weft {

/// What `automatic` stands for.
constexpr Projection resolve(Projection projection, Method method) {
    if (projection != Projection::automatic) return projection;
    return method == Method::xpbd ? Projection::lines : Projection::gauss_seidel;
}

/// What decides which passes a plan has, apart from the cloths. Models without coarse levels have no work in passes of
/// `solver.hierarchy`.
struct StepSettings {
    SolverDesc solver = {};
    bool contacts = true;   ///< there is something to touch
    bool air = false;       ///< there is air
    bool wind = false;      ///< and it moves
    bool adhesion = false;  ///< some of it sticks to cloth
    bool surface = true;    ///< compute normals
    friend bool operator==(const StepSettings&, const StepSettings&) = default;
};

/// Constraints between points of different cloths, or of one: a table per kind whose particles are numbered over the
/// whole world. Most kinds have none.
using LinkTables = std::array<ConstraintTable, constraint_kind_count>;

/// What a plan has to know of a cloth.
struct PlannedCloth {
    const ClothModel* model = nullptr;
    bool held = false;  ///< some of its particles are carried along
};

/// `frame_begin` once, `substep` `substeps` times, then `frame_end` once. The solver options are those that the passes
/// were made for; `projection` is never `automatic` here.
struct WorldPlan : SolverDesc {
    std::vector<Pass> frame_begin;
    std::vector<Pass> substep;
    std::vector<Pass> frame_end;
};

/// `links`: of every island.
WorldPlan plan_world(const StepSettings& settings, std::span<const PlannedCloth> cloths,
                     std::span<const LinkTables* const> links = {});

/// Whether a cloth has work in a pass.
bool takes_part(const PlannedCloth& cloth, const Pass& pass);
/// Whether an island's links have.
bool takes_part(const LinkTables& links, const Pass& pass);

/// The passes of one substep. Where a substep ends as the next one begins, with the particles one by one, `advance`
/// comes in place of both, behind `passes`.
struct SubstepPasses {
    std::span<const Pass> passes;
    bool advance = false;
};
SubstepPasses passes_of(const WorldPlan& plan, std::uint32_t substep);

/// visit(pass, substep) for a whole frame, in order.
template <class Visit>
void for_each_pass(const WorldPlan& plan, Visit&& visit) {
    for (const Pass& pass : plan.frame_begin) visit(pass, 0u);
    for (std::uint32_t substep = 0; substep < plan.substeps; ++substep) {
        const SubstepPasses now = passes_of(plan, substep);
        for (const Pass& pass : now.passes) visit(pass, substep);
        if (now.advance) visit(Pass{.kind = PassKind::advance}, substep);
    }
    for (const Pass& pass : plan.frame_end) visit(pass, plan.substeps - 1);
}

/// What happens to a constraint's multiplier lambda, which restarts at 0 in every substep.
enum class LambdaUse {
    discard,     ///< starts at 0 and is not kept
    store,       ///< starts at 0 and is kept
    accumulate,  ///< goes on from where the last iteration left it
};

/// A later iteration reads lambda again. The tension in the cloth and the residual are computed from the lambda of
/// stretch after the last substep. Those of coarse levels go on from sweep to sweep.
LambdaUse lambda_use(const WorldPlan& plan, const Pass& pass, std::uint32_t substep);

/// The part of its error that an iteration of plain position-based dynamics undoes, 0…1, while C > 0 and while C < 0.
using PlainStiffness = std::array<std::array<float, 2>, constraint_kind_count>;
PlainStiffness plain_stiffness(const Fabric& fabric, std::uint32_t iterations);

/// Nodes of a level that is worth sharing out: a sweep over its rows then takes longer than the barriers between them.
inline constexpr std::uint32_t nodes_for_many_threads = 2048;

/// One line per run of alike passes.
std::string describe(const WorldPlan& plan);

}  // namespace weft
