// The part of Stage that pulls cloth.
#include "editor/core/stage.h"

#include <cmath>

namespace weft::editor {
namespace {

bool is_finite(Vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// A triangle that the cloth has and that was not removed.
bool is_there(const ClothModel& model, std::uint32_t triangle) {
    if (triangle >= model.triangle_count) return false;
    const Triangle corners = model.triangles()[triangle];
    return corners[0] != corners[1];
}

}  // namespace

// Triangles are those of the frame, which the pointer picks.
Result<void> Stage::act(const Grab& action) {
    const auto cloth = cloth_called(action.cloth);
    if (!cloth) return cloth.errors();
    const Vec3 weights = action.point.weights;
    const float sum = weights.x + weights.y + weights.z;
    if (!is_finite(action.to)) return Error{"grab", "must have a finite target"};
    if (!(action.max_force > 0 && action.max_force <= largest_grab_force))
        return Error{"grab", "must have a largest force from 0 to 1e6 N"};
    if (!(weights.x >= 0 && weights.y >= 0 && weights.z >= 0 && std::abs(sum - 1) < 1e-3f))
        return Error{"grab", "must have weights from 0 to 1 whose sum is 1"};
    return as_step("Pull of " + action.cloth, 0, [&]() -> Result<void> {
        const auto id = cloth_called(action.cloth);
        World& world = world_->world();
        if (!is_there(*world.model(*id), action.point.triangle))
            return Error{"grab", "names triangle " + std::to_string(action.point.triangle) + ", which is not there"};
        if (grab_ && world.contains(*grab_)) world.release(*grab_);
        grab_ = world.grab(*id, action.point.triangle, {weights.x / sum, weights.y / sum, weights.z / sum}, action.to,
                           {.max_force = action.max_force});
        begin_branch();
        return {};
    });
}

Result<void> Stage::act(const MoveGrab& action) {
    World& world = world_->world();
    if (!is_finite(action.to)) return Error{"grab", "must have a finite target"};
    // A torn cloth may have lost the triangle.
    if (grab_ && world.contains(*grab_)) world.move_grab(*grab_, action.to);
    return {};
}

Result<void> Stage::act(const Release&) {
    World& world = world_->world();
    if (grab_ && world.contains(*grab_)) world.release(*grab_);
    grab_.reset();
    return {};
}

void Stage::let_go() {
    World& world = world_->world();
    let_go_ = !world.grabs().empty();
    while (!world.grabs().empty()) world.release(world.grabs().begin()->id);
    grab_.reset();
}

}  // namespace weft::editor
