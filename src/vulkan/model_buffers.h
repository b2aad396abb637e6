// The constant data of a ClothModel on the device. Shared by all cloths of that model.
#pragma once

#include "solver/model/cloth_model.h"
#include "vulkan/arena.h"
#include "vulkan/measures/measure.h"

#include <array>
#include <memory>
#include <vector>

namespace weft::vulkan {

struct TableBuffers {
    Slot particles, fields;
    Slot coupled, coupling;
    Slot blocks;  ///< begin and length of each; only if constraints are stored along lines
};

struct LevelBuffers {
    Slot restriction_begin, restriction_node, restriction_weight, prolongation_node, prolongation_weight;
    TableBuffers limits;
    Slot batches;  ///< LevelLimitArgs::batches
    Slot pinned;   ///< LevelArgs::pinned
    Slot weight;   ///< CoarseLevel::weight
};

class ModelBuffers {
  public:
    static Result<std::shared_ptr<ModelBuffers>> create(gpu::Device& device, std::shared_ptr<const ClothModel> model);

    const std::shared_ptr<const ClothModel>& model() const { return model_; }
    /// Replaces the model by one made by with_fabric(). Overwrites only the numbers that differ. A failure changes
    /// nothing.
    Result<void> set_material(gpu::Device& device, std::shared_ptr<const ClothModel> other);

    std::array<TableBuffers, constraint_kind_count> tables;
    std::vector<LevelBuffers> levels;
    Slot faces, faces_by_tile, face_mass, around_offsets, around_items;
    Slot span_ends, span_lengths, steadiness, pins;

    /// Created on first use.
    Result<const MeasureLists*> measure_lists(gpu::Device& device) const;

    std::uint64_t address(Slot slot) const { return arena_.address(slot); }
    std::uint64_t bytes() const { return arena_.size(); }

  private:
    explicit ModelBuffers(std::shared_ptr<const ClothModel> cloth_model) : model_(std::move(cloth_model)) {}
    Result<void> write_changed(gpu::Device& device, const ClothModel& from, const ClothModel& to) const;

    std::shared_ptr<const ClothModel> model_;
    Arena arena_;
    mutable std::unique_ptr<const MeasureLists> measure_lists_;
};

}  // namespace weft::vulkan
