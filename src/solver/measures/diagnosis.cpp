#include "solver/measures/diagnosis.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

bool finite(const Pose& pose) {
    const auto& [x, y, z] = pose.rotation;
    return finite(pose.position) && finite(x) && finite(y) && finite(z);
}

bool finite4(const Vec4& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

// " between particles 3, 4": the constraint of the batch that moved `particle`.
std::string row_at(const ClothModel& model, const Pass& pass, std::uint32_t particle) {
    const ConstraintTable& table = model.table(pass.constraint);
    const Batch& batch = table.batches[pass.batch];
    for (std::uint32_t row = batch.begin; row < batch.begin + batch.rows; ++row) {
        std::string names;
        bool here = false;
        for (std::uint32_t slot = 0; slot < table.arity; ++slot) {
            const std::uint32_t other = table.particles[std::size_t{slot} * table.stride + row];
            names += (slot == 0 ? " between particles " : ", ") + std::to_string(other);
            here = here || other == particle;
        }
        if (here && table.is_real(row)) return names;
    }
    return "";
}

}  // namespace

std::uint32_t first_non_finite(std::span<const Vec4> positions, std::span<const Vec4> velocities) {
    for (std::uint32_t p = 0; p < positions.size(); ++p) {
        if (!finite4(positions[p]) || !finite4(velocities[p])) return p;
    }
    return none;
}

std::string name_input(const StepInput& input, std::span<const Pose> motion_poses, std::span<const Vec4> positions,
                       std::span<const Vec4> velocities) {
    if (!finite(input.gravity)) return "gravity is not finite";
    if (!std::isfinite(input.air_density)) return "the density of the air is not finite";
    for (const WindNow& wind : input.winds) {
        const bool sound = std::ranges::all_of(wind.vectors, [](Vec3 v) { return finite(v); }) &&
                           finite(wind.position) &&
                           std::ranges::all_of(wind.numbers, [](float x) { return std::isfinite(x); });
        if (!sound) return "a wind is not finite";
    }
    for (std::size_t i = 0; i < input.colliders.size(); ++i) {
        if (!finite(input.places->pose(i, 0)) || !finite(input.places->end_pose(i)))
            return "the pose of collider '" + input.colliders[i].name + "' is not finite";
    }
    for (const Pose& pose : motion_poses) {
        if (!finite(pose.position)) return "the motion of a pin is not finite";
    }
    const std::uint32_t p = first_non_finite(positions, velocities);
    return p == none ? "" : "particle " + std::to_string(p) + " was not finite when the frame began";
}

std::string name_pass(const ClothModel& model, const Pass& pass, std::uint32_t substep, std::uint32_t particle) {
    std::string where(stage_name(stage_of(pass)));
    if (pass.kind == PassKind::project && pass.source == RowSource::model) where += row_at(model, pass, particle);
    return where + " made particle " + std::to_string(particle) + " non-finite in substep " + std::to_string(substep);
}

}  // namespace weft
