#include "solver/plan/frame_numbers.h"

#include "physics/scalar.h"
#include "solver/plan/tension.h"
#include "solver/state/grab.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

// The speed cap lets a particle pass this many edges (or thicknesses, if longer) per substep. Beyond that, contacts
// miss the particle and constraints pull in the wrong direction.
constexpr float capped_edges_per_substep = 10;
constexpr double no_speed_cap = 1e18;

}  // namespace

FrameNumbers frame_numbers(const ClothModel& model, const WorldPlan& plan, double dt) {
    const double h = dt / plan.substeps;
    const float half_thickness = 0.5f * model.fabric.contact.thickness;
    const std::array range{half_thickness * model.thickness_range[0], half_thickness * model.thickness_range[1]};
    const double reach = std::max(2 * range[1], model.mean_edge);
    return {.h = static_cast<float>(h),
            .max_speed = static_cast<float>(
                model.collision.surface ? no_speed_cap : std::min(capped_edges_per_substep * reach / h, no_speed_cap)),
            .viscous = std::max(static_cast<float>(model.fabric.body.damping * dt), 1e-30f),
            .half_thickness = half_thickness,
            .half_thickness_range = range,
            .depenetration = depenetration_speed * static_cast<float>(h),
            .hand_reach = hand_reach_in_edges * model.mean_edge,
            .tile_margin = range[1] + model.mean_edge + (has_face_contact(plan) ? widest_face(model) : 0)};
}

std::array<float, 2> friction_between(const ClothModel& model, const Collider& collider) {
    const ContactMaterial& cloth = model.fabric.contact;
    return {std::sqrt(cloth.friction[0] * collider.friction[0]), std::sqrt(cloth.friction[1] * collider.friction[1])};
}

bool faces_touch(const ClothModel& model, const Collider& collider) {
    const float half_thickness = 0.5f * model.fabric.contact.thickness * model.thickness_range[0];
    return shape_acts_on(collider, model) &&
           scalar::reaches_faces(roundness_of(collider), half_thickness, nearest_of_faces(half_thickness),
                                 circle_of_faces(model));
}

double lambda_seconds(const WorldPlan& plan, double dt) {
    return plan.method == Method::pbd ? 0 : static_cast<double>(static_cast<float>(dt / plan.substeps));
}

FrameLimits frame_limits(const ClothModel& model, std::span<const float> lambda, double substep_seconds,
                         std::span<const Vec4> positions) {
    const float measured =
        tension_in(model.table(ConstraintKind::stretch), lambda, substep_seconds, softest_stretch(model));
    // Limits always allow for the model's tension. The strain between pins includes the strain due to tension, so that
    // is divided out.
    const Elasticity& elastic = model.elasticity;
    // Elasticity::eased() in floats, as on a GPU.
    const auto straight = static_cast<float>(std::min(elastic.straight, 1e30));
    const float tension =
        measured > straight ? straight + (measured - straight) / static_cast<float>(WEFT_STRAIGHT_STIFFNESS) : measured;
    FrameLimits limits;
    limits.tension = std::max(0.0f, tension - static_cast<float>(elastic.tension));
    const float stretched = static_cast<float>(std::max(elastic.warp, elastic.weft)) * limits.tension;
    limits.allowed = std::max(1.0f, (1 + strain_between(model.pin_spans, positions)) / (1 + stretched));
    return limits;
}

bool has_limits(const ClothModel& model, const WorldPlan& plan) {
    const bool levels = std::ranges::find(plan.substep, PassKind::prolongation, &Pass::kind) != plan.substep.end();
    return (levels && !model.hierarchy.empty()) || model.table(ConstraintKind::tether).rows > 0;
}

}  // namespace weft
