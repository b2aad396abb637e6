// Constraints between the cloths of an island, on the device.
#pragma once

#include "solver/plan/world_plan.h"
#include "vulkan/model_buffers.h"
#include "vulkan/world_particles.h"

namespace weft::vulkan {

/// The constraint tables of an island, and the multipliers that outlive an iteration.
class LinkBuffers {
  public:
    static Result<LinkBuffers> create(gpu::Device& device, const LinkTables& tables, const WorldPlan& plan);

    struct Table {
        Slot particles, fields, lambda;
        std::uint32_t stride = 0;
        std::vector<Batch> batches;
    };
    const Table& table(ConstraintKind kind) const { return tables_[static_cast<std::uint32_t>(kind)]; }
    std::uint64_t address(Slot slot) const { return arena_.address(slot); }

  private:
    std::array<Table, constraint_kind_count> tables_;
    Arena arena_;
};

}  // namespace weft::vulkan
