// Kinetic energy, speed, strain and residual of a cloth, summed up where it lies.
#pragma once

#include "solver/measures/measures.h"
#include "vulkan/arena.h"
#include "vulkan/programs.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace weft::vulkan {

class ClothState;

/// What measuring a model needs on the device beyond what steps do. Shared by all cloths of it.
struct MeasureLists {
    static Result<std::unique_ptr<const MeasureLists>> create(gpu::Device& device, const ClothModel& model);

    Arena arena;
    Slot masses;          ///< kg
    Slot stretch, shear;  ///< edges (MeasureEdgesArgs), without those that have no length at rest
    std::uint32_t stretch_edges = 0, shear_edges = 0;
};

/// Equal to what MeasureSums::add() finds on the host within 1e-5 of each figure and 1e-12, and the same bits every
/// time on the same device. Nothing where a number is not finite, or more than a float holds.
Result<std::optional<MeasureSums>> measure(gpu::Device& device, Programs& programs, const ClothState& cloth);

}  // namespace weft::vulkan
