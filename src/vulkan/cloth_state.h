// The state of a moving cloth on the device.
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

/// Tiles of particles that share a list of near colliders.
std::uint32_t near_tiles_of(const ClothModel& model);
/// Slots that the first lists of near colliders get. `list_capacity`: see StepInput.
std::uint32_t first_near_slots(const ClothModel& model, std::uint32_t colliders, std::uint32_t list_capacity);
/// The most slots that shaders can number.
inline constexpr std::uint32_t most_near_slots = 1u << 27;

/// Buffers that a plan needs beside the particles. Their contents are valid within one frame only.
struct WorkBuffers {
    struct Level {
        Slot position, origin, displacement, lambda, remainder;
    };

    Arena arena;
    Slot wind;
    std::vector<Level> levels;
    std::array<Slot, constraint_kind_count> lambda;  ///< of constraints other than stretch, with several iterations
    Slot near_tiles;                                 ///< lists of colliders near each tile (colliders.data.h)
    Slot near_slots;                                 ///< colliders in the lists
    std::uint32_t slot_count = 0;                    ///< room of near_slots
    Slot taut;                                       ///< TautArgs::sums
    Slot steady_parts, remainder;                    ///< ParticleArgs
    Slot good_kept;                                  ///< KeepArgs
    Slot contact_sums;                               ///< by slot and particle in the tile
    Slot supports;                                   ///< ContactArgs
    Slot contact_log;               ///< likewise, effect of the contacts in the frame: moved, then turned (ContactArgs)
    Slot face_contacts, face_sums;  ///< FaceContactArgs
    Slot corrections;               ///< as floats, or
    Slot sums;                      ///< in fixed point
    Slot gather_offsets, gather_items;
    std::array<Slot, constraint_kind_count> share, corrections_of;
    Slot line_scratch;

    /// `slots`: room for lists of near colliders.
    static Result<WorkBuffers> create(gpu::Device& device, const ClothModel& model, const WorldPlan& plan,
                                      const InputShape& shape, std::uint32_t slots);
};

/// Buffers whose contents outlive a frame.
class ClothState {
  public:
    /// The cloth's particles start at `base` in `world`, which has room for them and outlives this.
    static Result<std::unique_ptr<ClothState>> create(gpu::Device& device, std::shared_ptr<ModelBuffers> buffers,
                                                      const WorldParticles& world, std::uint32_t base);

    const ClothModel& model() const { return *buffers_->model(); }
    const ModelBuffers& buffers() const { return *buffers_; }
    /// Whether no other cloth shares the buffers.
    bool owns_buffers() const { return buffers_.use_count() == 1; }
    const std::shared_ptr<ModelBuffers>& shared_buffers() const { return buffers_; }
    const Arena& arena() const { return arena_; }
    std::uint64_t address(Slot slot) const { return arena_.address(slot); }
    /// Address of the cloth's first particle.
    std::uint64_t address(PointArray array) const { return world_.address(array, base_); }
    const WorldParticles& world() const { return world_; }
    std::uint32_t base() const { return base_; }
    std::uint64_t offset(PointArray array) const { return world_.offset(array, base_); }

    std::uint32_t near_slots = 0;  ///< room that lists of near colliders have grown to; 0: not yet

    Slot weights;    ///< current inverse masses, 0 for pinned particles
    Slot thickness;  ///< factors, with those of particles that openings copy; empty: all 1
    Slot by_face, limits;
    Slot kept;                   ///< ClothModel::kept_floats()
    double substep_seconds = 0;  ///< of the last frame, for lambda's scale; 0 before the first frame

    /// Writes a model made by with_fabric() into the present buffers, which no other cloth may share. Keeps the pins.
    Result<void> set_material(gpu::Device& device, std::shared_ptr<const ClothModel> model);
    /// Replaces buffers that other cloths share by `buffers`. Keeps the pins.
    Result<void> set_material(gpu::Device& device, std::shared_ptr<ModelBuffers> buffers);
    /// Sets the buffers of a model whose particles and constraints the state has already.
    void set_buffers(std::shared_ptr<ModelBuffers> buffers) { buffers_ = std::move(buffers); }
    Result<void> set_weights(gpu::Device& device, std::span<const ParticleWeight> changed);
    Result<void> place_points(gpu::Device& device, std::uint32_t first, std::span<const Vec3> places);
    Result<ClothSnapshot> save(gpu::Device& device) const;
    /// Does not update the normals.
    Result<void> restore(gpu::Device& device, const ClothSnapshot& snapshot);
    /// Complete elements: the fourth floats hold parts of the compensation, which the next frame depends on.
    Result<std::vector<Vec4>> download_points(gpu::Device& device, PointArray array) const;
    Result<std::vector<float>> download_kept(gpu::Device& device) const;

  private:
    Result<void> set_masses(gpu::Device& device, const ClothModel& model);
    ClothState(std::shared_ptr<ModelBuffers> buffers, const WorldParticles& world, std::uint32_t base)
        : buffers_(std::move(buffers)), world_(world), base_(base) {}

    std::shared_ptr<ModelBuffers> buffers_;
    const WorldParticles& world_;
    std::uint32_t base_;
    Arena arena_;
};

}  // namespace weft::vulkan
