// Describes the source of a non-finite value as text.
#pragma once

#include "solver/world/backend.h"

#include <span>
#include <string>

namespace weft {

/// The first particle whose position or velocity is not finite; `none` if all are finite.
std::uint32_t first_non_finite(std::span<const Vec4> positions, std::span<const Vec4> velocities);

/// Names the first non-finite value in the input of a frame; empty if all are finite. The state is that at the start of
/// the frame.
std::string name_input(const StepInput& input, std::span<const Pose> motion_poses, std::span<const Vec4> positions,
                       std::span<const Vec4> velocities);

/// "stretch between particles 3, 4 made particle 3 non-finite in substep 2".
std::string name_pass(const ClothModel& model, const Pass& pass, std::uint32_t substep, std::uint32_t particle);

/// The text if no pass of a substep produced the value.
inline constexpr std::string_view late_non_finite = "damping or compensation became non-finite at the end of the frame";

}  // namespace weft
