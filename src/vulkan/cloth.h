// One cloth on the device, and the host's copies of its arrays.
#pragma once

#include "base/hash.h"
#include "gpu/commands.h"
#include "solver/measures/measures.h"
#include "vulkan/cloth_state.h"
#include "vulkan/compiled_plan.h"
#include "vulkan/surface/drawn_surface.h"

#include <memory>
#include <optional>
#include <string>

namespace weft::vulkan {

class Cloth {
  public:
    static Result<std::unique_ptr<Cloth>> create(gpu::Device& device, Programs& programs,
                                                 std::shared_ptr<ModelBuffers> buffers, const WorldParticles& world,
                                                 std::uint32_t base);

    const ClothModel& model() const { return state_->model(); }
    ClothState& state() { return *state_; }
    const ClothState& state() const { return *state_; }

    /// Copies positions, velocities and normals to the host. The copies stay valid until the next call.
    Result<void> read();
    std::span<const Vec4> positions() const { return read_array(0); }
    std::span<const Vec4> velocities() const { return read_array(1); }
    std::span<const Vec4> normals() const { return read_array(2); }

    Result<ClothSnapshot> save() const { return state_->save(device_); }
    Result<void> restore(const ClothSnapshot& snapshot);
    Result<void> update_normals();
    /// Measures on the device; on the host if a result is not finite or the device has not enough memory.
    void measure(MeasureSums& sums);

    /// Marks the cloth as changed for all work that is submitted from now on.
    void changed(bool with_normals) {
        ++changes_;
        normals_stale_ = !with_normals;
    }

    /// Sets the buffers of a model whose openings, or coarse levels alone, are the only difference to the present one.
    /// The device must have made the openings. A call that fails changes nothing.
    Result<void> follow(std::shared_ptr<ModelBuffers> buffers);
    /// The last frame has made openings that the model does not have yet.
    bool torn = false;

    /// Call after the arrays of the world got new addresses. The device must be idle.
    Result<void> particles_moved();

    bool has_surface() const { return surface_ != nullptr; }
    Result<void> make_surface(std::shared_ptr<const DrawnMesh> mesh);
    /// The current drawn surface. Call make_surface() first.
    Result<gpu::SurfaceBuffers> surface(gpu::Moment before);

    void hash(StateHash& hash) const;

  private:
    Cloth(gpu::Device& device, Programs& programs) : device_(device), programs_(programs) {}
    Result<void> make_readable();
    std::span<const Vec4> read_array(std::uint32_t which) const;

    gpu::Device& device_;
    Programs& programs_;
    std::unique_ptr<ClothState> state_;
    gpu::Buffer readback_;  ///< positions, velocities, normals
    std::optional<gpu::Commands> read_commands_;
    std::uint64_t changes_ = 0;
    bool normals_stale_ = false;
    std::unique_ptr<DrawnSurface> surface_;  ///< reads the state
};

}  // namespace weft::vulkan
