// One cloth on the device, and what the host sees of it.
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

    /// Brings positions, velocities and normals to the host, where they stay until the next call.
    Result<Done> read();
    std::span<const Vec4> positions() const { return read_array(0); }
    std::span<const Vec4> velocities() const { return read_array(1); }
    std::span<const Vec4> normals() const { return read_array(2); }

    Result<ClothSnapshot> save() const { return state_->save(device_); }
    Result<Done> restore(const ClothSnapshot& snapshot);
    Result<Done> update_normals();
    /// On the device; on the host what is not finite there, or where the device has no room for it.
    void measure(MeasureSums& sums);

    /// What is submitted from now on finds it changed.
    void changed(bool with_normals) {
        ++changes_;
        normals_stale_ = !with_normals;
    }

    /// The arrays of the world lie elsewhere now; the device has nothing to do.
    Result<Done> particles_moved();

    bool has_surface() const { return surface_ != nullptr; }
    Result<Done> make_surface(std::shared_ptr<const DrawnMesh> mesh);
    /// As it is now; there must be one.
    Result<gpu::SurfaceBuffers> surface(gpu::Moment before);

    void hash(StateHash& hash) const;

  private:
    Cloth(gpu::Device& device, Programs& programs) : device_(device), programs_(programs) {}
    Result<Done> make_readable();
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
