// Kinetic energy, speed, strain and residual of a cloth, summed up on the device.
#pragma once

#include "solver/measures/measures.h"
#include "vulkan/arena.h"
#include "vulkan/programs.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace weft::vulkan {

class ClothState;

/// Device data that only measuring needs. Shared by all cloths of a model.
struct MeasureLists {
    static Result<std::unique_ptr<const MeasureLists>> create(gpu::Device& device, const ClothModel& model);

    Arena arena;
    Slot masses;          ///< kg
    Slot stretch, shear;  ///< edges (MeasureEdgesArgs), without those of rest length 0
    std::uint32_t stretch_edges = 0, shear_edges = 0;
};

/// Agrees with MeasureSums::add() on the host within a relative 1e-5 and an absolute 1e-12. Gives the same bits every
/// time on the same device. Returns no value if a number is not finite or exceeds the range of a float.
Result<std::optional<MeasureSums>> measure(gpu::Device& device, Programs& programs, const ClothState& cloth);

}  // namespace weft::vulkan
