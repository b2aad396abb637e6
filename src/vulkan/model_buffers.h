// A ClothModel on the device: what does not move with a cloth. Shared by all cloths of that model.
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
    Slot blocks;  ///< begin and length of each, where rows lie along lines
};

struct LevelBuffers {
    Slot restriction_begin, restriction_node, restriction_weight, carry_node, carry_weight;
    TableBuffers reach;
};

class ModelBuffers {
  public:
    static Result<std::shared_ptr<ModelBuffers>> create(gpu::Device& device, std::shared_ptr<const ClothModel> model);

    const std::shared_ptr<const ClothModel>& model() const { return model_; }
    /// A model by with_fabric() in place of this one: writes the numbers that differ where they are. Where it fails,
    /// all is as it was.
    Result<Done> set_material(gpu::Device& device, std::shared_ptr<const ClothModel> other);

    std::array<TableBuffers, constraint_kind_count> tables;
    std::vector<LevelBuffers> levels;
    Slot faces, face_mass, around_offsets, around_items;
    Slot span_ends, span_lengths;

    /// Made when somebody asks for them.
    Result<const MeasureLists*> measure_lists(gpu::Device& device) const;

    std::uint64_t address(Slot slot) const { return arena_.address(slot); }
    std::uint64_t bytes() const { return arena_.size(); }

  private:
    explicit ModelBuffers(std::shared_ptr<const ClothModel> cloth_model) : model_(std::move(cloth_model)) {}
    Result<Done> write_changed(gpu::Device& device, const ClothModel& from, const ClothModel& to) const;

    std::shared_ptr<const ClothModel> model_;
    Arena arena_;
    mutable std::unique_ptr<const MeasureLists> measure_lists_;
};

}  // namespace weft::vulkan
