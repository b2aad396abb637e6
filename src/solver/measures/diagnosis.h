// Where a number that is not finite came from, in words.
#pragma once

#include "solver/world/backend.h"

#include <span>
#include <string>

namespace weft {

/// The first particle whose place or velocity is not finite; `none` if all are.
std::uint32_t first_non_finite(std::span<const Vec4> positions, std::span<const Vec4> velocities);

/// What of a frame's input is not finite; nothing if all is sound. The state is what the frame began with.
std::string name_input(const StepInput& input, std::span<const Pose> mover_poses, std::span<const Vec4> positions,
                       std::span<const Vec4> velocities);

/// "stretch between particles 3, 4 made particle 3 non-finite in substep 2".
std::string name_pass(const ClothModel& model, const Pass& pass, std::uint32_t substep, std::uint32_t particle);

/// If no pass of a substep did it.
inline constexpr std::string_view late_non_finite =
    "damping or a rounding carry became non-finite at the end of the frame";

}  // namespace weft
