// The step as data: the list of passes that every backend executes, and that reads like a table of contents.
#pragma once

#include "physics/constraint.h"
#include "solver/cloth_model.h"

#include <string>
#include <string_view>
#include <vector>

namespace weft {

enum class PassKind : std::uint8_t {
    predict,     ///< per particle: gravity, then where it would go
    hold,        ///< per held particle: to where it is carried
    project,     ///< one batch of one constraint
    contact,     ///< per particle: every collider
    velocities,  ///< per particle: the velocity that the projection left
    damp,        ///< one batch of one constraint, on velocities
    faces,       ///< per triangle: its normal
    normals,     ///< per particle: the sum of those
};

struct Pass {
    PassKind kind;
    ConstraintKind constraint{};  ///< of project and damp
    std::uint32_t batch = 0;      ///< of project and damp
    bool first_iteration = true;  ///< of project and contact: no lambda, no friction from before

    /// Whether it works particle by particle, touching no neighbor. Two such passes in a row need no barrier.
    bool particle_wise() const {
        return kind == PassKind::predict || kind == PassKind::hold || kind == PassKind::contact ||
               kind == PassKind::velocities;
    }
};

struct StepSettings {
    std::uint32_t substeps = 20;
    std::uint32_t iterations = 1;
    bool contacts = true;  ///< there is something to touch
    bool holds = false;    ///< some particles are carried along
    bool surface = true;   ///< compute normals
    friend bool operator==(const StepSettings&, const StepSettings&) = default;
};

/// `substep` runs `substeps` times, then `frame_end` once.
struct StepPlan {
    std::uint32_t substeps = 0;
    std::uint32_t iterations = 0;
    std::vector<Pass> substep;
    std::vector<Pass> frame_end;
};

StepPlan plan_step(const ClothModel& model, const StepSettings& settings);

/// What timings are kept by: predict, one per constraint, contact, velocities, damp, surface.
std::uint32_t stage_of(const Pass& pass);
std::string_view stage_name(std::uint32_t stage);
inline constexpr std::uint32_t stage_count = constraint_kind_count + 5;

/// One line per run of alike passes.
std::string describe(const StepPlan& plan);

}  // namespace weft
