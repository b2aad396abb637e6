// Data of collider shapes on the device.
#pragma once

#include "gpu/device.h"
#include "solver/world/collider.h"

#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>

namespace weft::vulkan {

class ShapeBuffers {
  public:
    /// Uploads what the colliders need and frees what they do not need any more. No frame may be running. If it fails,
    /// the colliders whose data is missing have the address 0.
    Result<void> hold(gpu::Device& device, std::span<const Collider> colliders);
    /// Address of the data; 0 for a shape without data.
    std::uint64_t address(const ShapeData* data) const;

  private:
    struct Entry {
        std::shared_ptr<const ShapeData> data;
        gpu::Buffer buffer;
    };
    std::unordered_map<const ShapeData*, Entry> entries_;
};

}  // namespace weft::vulkan
