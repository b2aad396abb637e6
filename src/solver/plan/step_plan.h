// The step as data: the list of passes that every backend executes, and that reads like a table of contents.
#pragma once

#include "physics/constraint.h"
#include "scene/scene_desc.h"
#include "solver/model/cloth_model.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

enum class PassKind : std::uint8_t {
    wind,        ///< per triangle: the wind that it meets in this frame
    air,         ///< per triangle: what drag and lift do to it
    push,        ///< per particle: the sum of that over its triangles, on its velocity
    predict,     ///< per particle: gravity, then where it would go
    hold,        ///< per held particle: to where it is carried
    collect,     ///< per node of a coarse level: where what it carries is
    lift,        ///< per node of a coarse level: from there to where the coarser level takes it
    reach,       ///< one batch of a coarse level's rows
    settle,      ///< per node: how far the rows have moved it
    spread,      ///< per particle: along with the nodes around it
    project,     ///< one batch of one constraint, row after row
    correct,     ///< all rows of one constraint, side by side: what they want of their particles
    average,     ///< per particle: the mean of that
    contact,     ///< per particle: every collider
    velocities,  ///< per particle: the velocity that the projection left
    damp,        ///< one batch of one constraint, on velocities
    faces,       ///< per triangle: its normal
    normals,     ///< per particle: the sum of those
};

struct Pass {
    PassKind kind;
    ConstraintKind constraint{};  ///< of project, correct and damp
    std::uint32_t batch = 0;      ///< of project, reach and damp
    bool first_iteration = true;  ///< of project, reach, correct and contact: no lambda, no friction from before
    std::uint32_t level = 0;      ///< of collect, lift, reach and settle
    bool alone = false;           ///< of those: so little that one thread has it done before others would have joined
    friend bool operator==(const Pass&, const Pass&) = default;
};

/// Whether a pass may begin on one thread while another is still in the one before.
bool needs_barrier(const Pass& before, const Pass& after);

/// What `automatic` stands for.
constexpr Projection resolve(Projection projection, Method method) {
    if (projection != Projection::automatic) return projection;
    return method == Method::xpbd ? Projection::lines : Projection::gauss_seidel;
}

struct StepSettings {
    std::uint32_t substeps = 20;
    std::uint32_t iterations = 1;
    bool contacts = true;    ///< there is something to touch
    bool holds = false;      ///< some particles are carried along
    bool air = false;        ///< there is air
    bool wind = false;       ///< and it moves
    bool surface = true;     ///< compute normals
    bool hierarchy = false;  ///< coarse levels first, where the model has them
    Method method = Method::xpbd;
    Projection projection = Projection::automatic;
    Accumulate accumulate = Accumulate::gather;
    friend bool operator==(const StepSettings&, const StepSettings&) = default;
};

/// `frame_begin` once, `substep` `substeps` times, then `frame_end` once.
struct StepPlan {
    std::uint32_t substeps = 0;
    std::uint32_t iterations = 0;
    Method method = Method::xpbd;
    Projection projection = Projection::lines;  ///< resolved; lines where the model has them
    Accumulate accumulate = Accumulate::gather;
    /// What an iteration undoes of a constraint, 0…1, while C > 0 and while C < 0. Method pbd only.
    std::array<std::array<float, 2>, constraint_kind_count> stiffness{};
    std::vector<Pass> frame_begin;
    std::vector<Pass> substep;
    std::vector<Pass> frame_end;
    std::uint64_t serial = 0;  ///< another one for each plan that is made; 0 if made by hand
};

/// Whether both do the same. At once for a plan and its copy.
bool same_plan(const StepPlan& a, const StepPlan& b);

StepPlan plan_step(const ClothModel& model, const StepSettings& settings);

/// What timings are kept by: one per constraint, then air, predict, hierarchy, average, contact, velocities, damp,
/// surface; and for what a device runs as a whole: patched, the iterations of a substep, and fused, a frame.
std::uint32_t stage_of(const Pass& pass);
std::string_view stage_name(std::uint32_t stage);
inline constexpr std::uint32_t stage_count = constraint_kind_count + 10;
inline constexpr std::uint32_t stage_patched = stage_count - 2;
inline constexpr std::uint32_t stage_fused = stage_count - 1;

/// One line per run of alike passes.
std::string describe(const StepPlan& plan);

}  // namespace weft
