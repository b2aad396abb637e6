// The drawn surface of a cloth, made on the device from where its particles are: positions, normals and tangents, one
// of each for every vertex of the drawn mesh, equal to those of draw_surface() and compute_tangents()
// (solver/state/frame.h).
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
    /// `cloth` outlives it.
    static Result<std::unique_ptr<DrawnSurface>> create(gpu::Device& device, Programs& programs,
                                                        const ClothState& cloth, std::shared_ptr<const DrawnMesh> mesh);
    ~DrawnSurface();

    /// The cloth's particles lie elsewhere from now on.
    Result<Done> particles_moved();
    /// The surface of the cloth as it is, with the particles' normals as they are. `change` is another number whenever
    /// the cloth has changed; with the same one, what there is. Otherwise the device writes the other one of two sets
    /// of buffers, after all work that was submitted to its queue before and after `before`, which must come of work
    /// that is submitted already. Does not wait for the device.
    Result<gpu::SurfaceBuffers> update(std::uint64_t change, gpu::Moment before = {});

  private:
    struct Set {
        Arena arena;
        Slot positions, normals, tangents;
        std::optional<gpu::Commands> commands;
        std::uint64_t written = 0;  ///< when its commands are done
    };

    DrawnSurface(gpu::Device& device, Programs& programs, const ClothState& cloth,
                 std::shared_ptr<const DrawnMesh> mesh)
        : device_(device), programs_(programs), cloth_(cloth), mesh_(std::move(mesh)) {}
    Result<Done> make(Set& set);
    Result<Done> record(Set& set);
    gpu::SurfaceBuffers buffers(const Set& set) const;

    gpu::Device& device_;
    Programs& programs_;
    const ClothState& cloth_;
    std::shared_ptr<const DrawnMesh> mesh_;
    std::array<Set, 2> sets_;
    std::size_t current_ = 0;
    std::optional<std::uint64_t> change_;  ///< what the current set shows
};

}  // namespace weft::vulkan
