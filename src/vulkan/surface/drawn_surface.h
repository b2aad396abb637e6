// The drawn surface of a cloth, computed on the device from its particles: positions, normals and tangents for every
// vertex of the drawn mesh. They equal those of draw_surface() and compute_tangents() (solver/state/frame.h).
#pragma once

#include "gpu/commands.h"
#include "gpu/surface_buffers.h"
#include "vulkan/cloth_state.h"
#include "vulkan/programs.h"
#include "vulkan/surface/drawn_mesh.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

namespace weft::vulkan {

class DrawnSurface {
  public:
    /// `cloth` must outlive the surface.
    static Result<std::unique_ptr<DrawnSurface>> create(gpu::Device& device, Programs& programs,
                                                        const ClothState& cloth, std::shared_ptr<const DrawnMesh> mesh);
    ~DrawnSurface();

    /// Call after the cloth's particles got new addresses.
    Result<void> particles_moved();
    /// Returns the surface of the cloth's current positions and normals. `change` must be a new number whenever the
    /// cloth has changed; with the same number, the present surface is returned. Otherwise the device writes the other
    /// one of two sets of buffers, after all work that is already in its queue and after `before`, which must belong to
    /// submitted work. The host does not wait for the device, unless that set is still being written.
    Result<gpu::SurfaceBuffers> update(std::uint64_t change, gpu::Moment before = {});

  private:
    struct Set {
        Arena arena;
        Slot positions, normals, tangents;
        std::optional<gpu::Commands> commands;
        std::uint64_t written = 0;  ///< timeline value after its commands
    };

    DrawnSurface(gpu::Device& device, Programs& programs, const ClothState& cloth,
                 std::shared_ptr<const DrawnMesh> mesh)
        : device_(device), programs_(programs), cloth_(cloth), mesh_(std::move(mesh)) {}
    Result<void> make(Set& set);
    Result<void> record(Set& set);
    gpu::SurfaceBuffers buffers(const Set& set) const;

    gpu::Device& device_;
    Programs& programs_;
    const ClothState& cloth_;
    std::shared_ptr<const DrawnMesh> mesh_;
    std::array<Set, 2> sets_;
    std::size_t current_ = 0;
    std::optional<std::uint64_t> change_;  ///< number of the state in the current set
};

}  // namespace weft::vulkan
