// What changes while a cloth moves, as the Vulkan backend keeps it.
#pragma once

#include "solver/model/jacobi.h"
#include "solver/state/particle_weight.h"
#include "solver/state/snapshot.h"
#include "vulkan/frame_input.h"
#include "vulkan/model_buffers.h"
#include "vulkan/world_particles.h"

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace weft::vulkan {

/// What a plan needs beyond the particles. Nothing of it outlives a frame.
struct WorkBuffers {
    struct Level {
        Slot position, origin, displacement, lambda;
    };

    Arena arena;
    Slot wind;
    std::vector<Level> levels;
    std::array<Slot, constraint_kind_count> lambda;  ///< of constraints other than stretch, with several iterations
    Slot contact_sums;
    Slot felt;         ///< what contacts do in the frame: moved, then turned (ContactArgs)
    Slot corrections;  ///< in floats, or
    Slot sums;         ///< in fixed point
    Slot gather_offsets, gather_items;
    std::array<Slot, constraint_kind_count> share, corrections_of;
    Slot line_scratch;

    static Result<WorkBuffers> create(gpu::Device& device, const ClothModel& model, const WorldPlan& plan,
                                      const InputShape& shape);
};

/// Where everything lies that outlives a frame.
class ClothState {
  public:
    /// The cloth's particles are those from `base` on; `world` has room for them and outlives this.
    static Result<std::unique_ptr<ClothState>> create(gpu::Device& device, std::shared_ptr<ModelBuffers> buffers,
                                                      const WorldParticles& world, std::uint32_t base);

    const ClothModel& model() const { return *buffers_->model(); }
    const ModelBuffers& buffers() const { return *buffers_; }
    /// Whether no other cloth has them.
    bool owns_buffers() const { return buffers_.use_count() == 1; }
    const std::shared_ptr<ModelBuffers>& shared_buffers() const { return buffers_; }
    const Arena& arena() const { return arena_; }
    std::uint64_t address(Slot slot) const { return arena_.address(slot); }
    /// Of the cloth's first particle.
    std::uint64_t address(PointArray array) const { return world_.address(array, base_); }
    const WorldParticles& world() const { return world_; }
    std::uint32_t base() const { return base_; }
    std::uint64_t offset(PointArray array) const { return world_.offset(array, base_); }

    Slot weights;  ///< inverse masses as they are, 0 for pinned particles
    Slot by_face, lambda, limits;
    double substep_seconds = 0;  ///< of the last frame, for lambda's scale; 0 before it

    /// A model by with_fabric() in the buffers that it has, which must be this cloth's alone. Pins stay as they are.
    Result<Done> set_material(gpu::Device& device, std::shared_ptr<const ClothModel> model);
    /// The same in place of buffers that it shares with other cloths.
    Result<Done> set_material(gpu::Device& device, std::shared_ptr<ModelBuffers> buffers);
    Result<Done> set_weights(gpu::Device& device, std::span<const ParticleWeight> changed);
    Result<Done> place_points(gpu::Device& device, std::uint32_t first, std::span<const Vec3> places);
    Result<ClothSnapshot> save(gpu::Device& device) const;
    /// Normals are not brought up to date.
    Result<Done> restore(gpu::Device& device, const ClothSnapshot& snapshot);
    /// The rounding carries too: all that decides what comes next. Whole arrays with padding.
    Result<std::vector<Vec4>> download_points(gpu::Device& device, PointArray array) const;
    Result<std::vector<float>> download_lambda(gpu::Device& device) const;

  private:
    Result<Done> set_masses(gpu::Device& device, const ClothModel& model);
    ClothState(std::shared_ptr<ModelBuffers> buffers, const WorldParticles& world, std::uint32_t base)
        : buffers_(std::move(buffers)), world_(world), base_(base) {}

    std::shared_ptr<ModelBuffers> buffers_;
    const WorldParticles& world_;
    std::uint32_t base_;
    Arena arena_;
};

}  // namespace weft::vulkan
