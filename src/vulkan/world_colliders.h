// The world's colliders on the device, for all cloths: shapes, poses in each substep, and a tree to search.
#pragma once

#include "gpu/commands.h"
#include "solver/world/collider_places.h"
#include "vulkan/args.data.h"
#include "vulkan/shape_buffers.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace weft::vulkan {

class WorldColliders {
  public:
    /// Brings the device's copy up to date for the frame that `places` is in. Copies only what has changed since the
    /// last call, and submits nothing if nothing has. The device must have finished the frame before.
    /// `bodies`: address of BodiesIn; 0 without bodies.
    Result<void> update(gpu::Device& device, std::span<const Collider> colliders, const ColliderPlaces& places,
                        std::uint64_t bodies);

    /// Address of CollidersIn; 0 without colliders. It changes only if an update() finds no colliders.
    std::uint64_t address() const { return head_.address(); }

  private:
    /// Offsets in the buffer. From `moving_nodes` on, it changes in every frame in which colliders move. The nodes of
    /// those at rest, of those that move and of those without a box follow one another.
    struct Layout {
        std::uint64_t colliders = 0, resting_poses = 0, nodes = 0, moving_nodes = 0, moving_poses = 0, end = 0;
    };
    struct Range {
        std::uint64_t begin = 0, end = 0;
    };

    Result<void> copy_changes(gpu::Device& device, std::span<const Collider> colliders, const ColliderPlaces& places,
                              std::uint64_t bodies);
    void lay_out(const ColliderPlaces& places);
    Result<void> make_room(gpu::Device& device);
    void write_colliders(std::span<const Collider> colliders, const ColliderPlaces& places);
    void write_resting(const ColliderPlaces& places);
    void write_moving(const ColliderPlaces& places);
    Range changed_friction(std::span<const Collider> colliders);
    bool write_head(std::uint64_t bodies);
    Result<void> submit(std::span<const Range> ranges, bool with_head);
    template <class T>
    std::span<T> array(std::uint64_t offset, std::size_t count) const {
        return {reinterpret_cast<T*>(upload_.mapped().data() + offset), count};
    }

    ShapeBuffers shapes_;
    std::uint64_t order_ = 0;  ///< ColliderPlaces::order() of the device's copy; 0: it has none
    Layout layout_;
    std::size_t node_count_ = 0;
    std::vector<std::array<float, 2>> friction_;  ///< by collider, as the device has it
    CollidersIn written_{};
    gpu::Buffer buffer_, upload_, head_, head_upload_;
    std::optional<gpu::Commands> commands_;
};

}  // namespace weft::vulkan
