// The step as data: one list of passes for the whole world, which every backend executes. A cloth takes part in a pass
// or has no work in it.
#pragma once

#include "scene/scene_desc.h"
#include "solver/model/cloth_model.h"
#include "solver/plan/pass.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace weft {

/// Replaces `automatic` by the projection that it selects.
constexpr Projection resolve(Projection projection, Method method) {
    if (projection != Projection::automatic) return projection;
    return method == Method::xpbd ? Projection::lines : Projection::gauss_seidel;
}

/// s: in shorter substeps, rounding drops a noticeable part of what projections move particles by. Frames whose lengths
/// scatter about one display's do not cross this bound back and forth: 40 substeps at 60 Hz and 20 at 120 Hz are 1/2400
/// s, 20 at 144 Hz are 1/2880 s.
inline constexpr double short_substep = 1.0 / 2600;

/// Whether projections keep what rounding drops, in frames of `dt` seconds.
constexpr bool compensates(const SolverDesc& solver, double dt) {
    if (solver.compensation != Compensation::automatic) return solver.compensation == Compensation::on;
    return solver.method == Method::xpbd && dt < short_substep * solver.substeps;
}

/// Sweeps over the contacts of faces with colliders. One more follows, which keeps faces from passing.
inline constexpr std::uint32_t face_sweeps = 3;
/// How often particles of faces that have passed in spite of that are held, on all threads. Rounds on one thread
/// follow, until no face passes, but at most so many.
inline constexpr std::uint32_t face_holds = 2;
inline constexpr std::uint32_t most_hold_rounds = 128;

/// Sweeps over the contacts of cloth with bodies, each of which moves the bodies, at the first contact of a substep.
inline constexpr std::uint32_t body_sweeps = 3;

/// Settings that select the passes of a plan, together with the cloths. Models without coarse levels have no work in
/// the passes of `solver.hierarchy`.
struct StepSettings {
    SolverDesc solver = {};
    bool contacts = true;      ///< there are colliders
    bool faces = false;        ///< faces of a cloth may touch a collider where their corners do not
    bool air = false;          ///< there is air
    bool wind = false;         ///< the air moves
    bool adhesion = false;     ///< a collider has adhesion
    bool bodies = false;       ///< colliders that move by forces
    bool surface = true;       ///< compute normals
    bool compensated = false;  ///< projections keep what rounding drops
    friend bool operator==(const StepSettings&, const StepSettings&) = default;
};

/// Constraints between points of different cloths, or of one cloth: a table per kind, with particles numbered over the
/// whole world. Most tables are empty.
using LinkTables = std::array<ConstraintTable, constraint_kind_count>;

/// The properties of a cloth that a plan depends on.
struct PlannedCloth {
    const ClothModel* model = nullptr;
    bool kinematic = false;  ///< it has kinematic targets
    bool grabbed = false;    ///< it has grabs
    bool attached = false;   ///< some of its targets are points of bodies
};

/// A frame runs `frame_begin` once, `substep` `substeps` times, then `frame_end` once. The solver options are those
/// that the passes were made for; `projection` is never `automatic` here.
struct WorldPlan : SolverDesc {
    std::uint32_t later_rounds =
        0;  ///< in which constraints of exact cloths, and links, act again after the iterations
    std::vector<Pass> frame_begin;
    std::vector<Pass> substep;
    std::vector<Pass> frame_end;
    bool weighs_taut = false;  ///< taut edges add mass, by lambda of the substep before
    bool steadies = false;     ///< particles near pins are heavier
    bool compensated = false;  ///< projections keep what rounding drops
    bool reads_kept = false;   ///< a frame reads ClothModel::kept_floats() of the frame before
};

/// `links`: of all islands that have any.
WorldPlan plan_world(const StepSettings& settings, std::span<const PlannedCloth> cloths,
                     std::span<const LinkTables* const> links = {});

/// Whether a pass is one of contact of faces with colliders.
constexpr bool is_face_contact(PassKind kind) {
    return kind == PassKind::longest_edge || kind == PassKind::find_faces || kind == PassKind::push_faces ||
           kind == PassKind::move_faces || kind == PassKind::hold_faces || kind == PassKind::settle_faces ||
           kind == PassKind::finish_holds;
}
bool has_face_contact(const WorldPlan& plan);
/// Whether a pass is one of contact between cloths.
constexpr bool is_cloth_contact(PassKind kind) {
    return kind == PassKind::detect || kind == PassKind::cloth_contact || kind == PassKind::limit ||
           kind == PassKind::separate;
}

/// Whether a pass goes over bodies, and not over the cloths that touch them.
constexpr bool is_body_pass(PassKind kind) {
    return kind == PassKind::predict_bodies || kind == PassKind::move_bodies || kind == PassKind::finish_bodies;
}

/// Batches of PassKind::targets: all targets, those on bodies, and those on bodies of cloths without exact contact,
/// which would no longer keep its promise if particles moved after it.
inline constexpr std::uint32_t targets_all = 0, targets_on_bodies = 1, targets_at_last = 2;
/// Batches of PassKind::weigh_attached: for the constraints of the cloth, and before them for those of its coarse
/// levels, with the sign changed. Levels that are older than a pin take its particle for a free one, and do not move
/// particles of negative weight.
inline constexpr std::uint32_t weigh_for_constraints = 0, weigh_for_levels = 1;
/// Batches of PassKind::move_bodies: before contact of faces, which counts contacts; after contact of particles; after
/// contact of faces; after constraints have pulled at attached points, which are then placed again; and likewise in the
/// rounds of exact contact, where they stay.
inline constexpr std::uint32_t move_before_faces = 0, move_after_particles = 1, move_after_faces = 2,
                               move_after_pulls = 3, move_in_rounds = 4;

/// Whether air acts on cloth.
inline bool has_air(const WorldPlan& plan) {
    return std::ranges::any_of(plan.substep, [](const Pass& pass) { return pass.kind == PassKind::air; });
}

/// Whether a pass is one of grabs.
constexpr bool is_grab(PassKind kind) {
    return kind == PassKind::hide_grabs || kind == PassKind::hold_grabs || kind == PassKind::grab ||
           kind == PassKind::free_grabs;
}

/// Whether any of the cloths collides by particles.
bool has_particle_contact(std::span<const PlannedCloth> cloths);
bool has_particle_contact(const WorldPlan& plan);
/// Whether a pass is one of contact between particles.
constexpr bool is_particle_contact(PassKind kind) {
    return kind >= PassKind::track_particles && kind <= PassKind::settle_particles;
}

/// How often the constraints of a cloth act in a substep, and those of links and dynamic lists.
std::uint32_t rounds_of(const WorldPlan& plan, const ClothModel& model);
std::uint32_t rounds_of_links(const WorldPlan& plan);
/// Whether a cloth has work in a pass.
bool takes_part(const PlannedCloth& cloth, const Pass& pass);
/// Whether the links of an island have work in a pass.
bool takes_part(const LinkTables& links, const Pass& pass);

/// The passes of one substep. If the last pass of a substep and the first of the next one both go over single particles
/// (velocities, predict), `advance` replaces both and runs after `passes`.
struct SubstepPasses {
    std::span<const Pass> passes;
    bool advance = false;
};
SubstepPasses passes_of(const WorldPlan& plan, std::uint32_t substep);

/// Calls visit(pass, substep) for all passes of a frame, in order.
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

/// Use of a constraint's Lagrange multiplier lambda, which restarts at 0 in every substep.
enum class LambdaUse {
    discard,     ///< starts at 0 and is not kept
    store,       ///< starts at 0 and is kept
    accumulate,  ///< continues from the last iteration
};

/// Lambda is stored if it is read later: by the next iteration, by the next sweep on a coarse level, or, for stretch in
/// the last substep, to compute the tension and the residual.
/// `rounds`: how often the constraints act in a substep (rounds_of).
LambdaUse lambda_use(const WorldPlan& plan, const Pass& pass, std::uint32_t substep, std::uint32_t rounds);
/// For the constraints of a cloth. Those that are coupled read the multipliers of others.
LambdaUse lambda_use(const WorldPlan& plan, const ClothModel& model, const Pass& pass, std::uint32_t substep);
/// Whether the constraints of this table of the model need room for multipliers.
bool stores_lambda(const WorldPlan& plan, const ConstraintTable& table, const ClothModel& model);

/// The fraction 0…1 of its error that a constraint removes per iteration of plain position-based dynamics, for C > 0
/// and for C < 0.
using PlainStiffness = std::array<std::array<float, 2>, constraint_kind_count>;
PlainStiffness plain_stiffness(const Fabric& fabric, std::uint32_t iterations);

/// Sweeps over the constraints of a coarse level. Levels are small, so sweeps are cheap, and they leave less error to
/// the finer levels.
inline constexpr std::uint32_t coarse_sweeps = 4;

/// The plan as text: one line per run of equal passes.
std::string describe(const WorldPlan& plan);

}  // namespace weft
