// The drawn mesh of a model on the device: the data of a drawn surface that does not change while the cloth moves.
// Shared by all cloths of that model.
#pragma once

#include "gpu/surface_buffers.h"
#include "solver/model/cloth_model.h"
#include "vulkan/arena.h"

#include <memory>

namespace weft::vulkan {

/// Usage as vertex and index buffers, in addition to the usage of every buffer.
inline constexpr VkBufferUsageFlags drawn_usage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT;

/// The range of a slot; without a buffer if the slot is empty.
gpu::BufferRange range_of(const Arena& arena, Slot slot);

class DrawnMesh {
  public:
    static Result<std::shared_ptr<const DrawnMesh>> create(gpu::Device& device,
                                                           std::shared_ptr<const ClothModel> model);

    const std::shared_ptr<const ClothModel> model;
    Slot triangles, uvs;
    Slot around_offsets, around_items;  ///< the triangles at each vertex, ascending; only with UVs
    Slot particle;                      ///< of each vertex; only without a binding
    Slot bound_particles, bound_shape;  ///< only with a binding

    std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(model->mesh().positions.size()); }
    const Arena& arena() const { return arena_; }
    std::uint64_t address(Slot slot) const { return arena_.address(slot); }

  private:
    explicit DrawnMesh(std::shared_ptr<const ClothModel> cloth_model) : model(std::move(cloth_model)) {}

    Arena arena_;
};

}  // namespace weft::vulkan
