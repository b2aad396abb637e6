// What runs a WorldPlan: the CPU with its lanes and threads, a GPU with its passes.
#pragma once

#include "base/hash.h"
#include "solver/measures/measures.h"
#include "solver/plan/island_plan.h"
#include "solver/state/feedback.h"
#include "solver/state/frame.h"
#include "solver/state/holds.h"
#include "solver/state/list_counts.h"
#include "solver/state/particle_weight.h"
#include "solver/state/snapshot.h"
#include "solver/world/air.h"
#include "solver/world/collider.h"

#include <weft/result.h>

#include <memory>
#include <span>
#include <string>

namespace weft {

/// One cloth as a backend knows it. Kept by the world, which gives out ids.
struct ClothHandle {
    std::uint32_t value = 0;
};

/// What all cloths of a world meet in a frame.
struct StepInput {
    double dt = 0;                        ///< s, > 0: length of the frame
    Vec3 gravity;                         ///< m/s²
    float air_density = 0;                ///< kg/m³
    std::span<const WindNow> winds = {};  ///< in the middle of the frame
    std::span<const Collider> colliders = {};
    /// Where each collider is at the start of the frame and after every substep: [substep · colliders + collider],
    /// substeps + 1 times.
    std::span<const Pose> poses = {};
    bool feedback = false;                                ///< keep account of contacts
    std::uint32_t list_capacity = default_list_capacity;  ///< of dynamic lists that are new
};

/// One cloth's part of a frame.
struct ClothStep {
    ClothHandle cloth;
    const PlainStiffness* stiffness = nullptr;
    std::span<const HeldParticle> held = {};
    /// Of what carries the held particles: [substep · movers + mover], substeps + 1 times.
    std::span<const Pose> mover_poses = {};
    std::uint32_t movers = 0;
    ClothFrame* frame = nullptr;        ///< its reports and details are written here
    ClothFeedback* feedback = nullptr;  ///< likewise, where the input asks for it
};

/// Cloths that are tied together: a substep of one does not begin before the others have ended theirs. Islands have
/// nothing to do with one another, and may run side by side.
struct IslandStep {
    const IslandPlan* plan = nullptr;
    std::span<const ClothStep> cloths = {};
    const LinkTables* links = nullptr;  ///< nullptr without
    std::uint64_t links_serial = 0;     ///< another one whenever `links` changes
};

struct WorldStep {
    const WorldPlan* plan = nullptr;
    std::uint64_t plan_serial = 0;  ///< another one whenever the plan, the islands or what they consist of change
    StepInput input = {};
    std::span<const IslandStep> islands = {};
};

class Backend {
  public:
    virtual ~Backend() = default;

    virtual std::string_view name() const = 0;  ///< as on the command line
    virtual std::string device() const = 0;     ///< for a human
    virtual unsigned threads() const = 0;
    /// Of a device's memory, taken for cloths beside what the program has of its own.
    virtual std::uint64_t device_bytes() const { return 0; }

    /// `base`: where its particles begin in the world's address space. A range of model->capacity() from there on
    /// belongs to this cloth alone. Fails where the device has no room for it.
    virtual Result<ClothHandle> add_cloth(std::shared_ptr<const ClothModel> model, std::uint32_t base) = 0;
    virtual void remove_cloth(ClothHandle cloth) = 0;
    /// Another model for the same particles: other rows, other masses, other pins. What moved goes on moving. `base`
    /// may be another place, which overlaps no cloth's, not even its own former one. Where it fails, all is as it was.
    virtual Result<Done> set_model(ClothHandle cloth, std::shared_ptr<const ClothModel> model, std::uint32_t base) = 0;
    /// A model by with_fabric() in place of the one that it has: the same rows, particles and pins, other numbers.
    /// What moved goes on moving, pinned particles stay pinned. Where it fails, all is as it was.
    virtual Result<Done> set_material(ClothHandle cloth, std::shared_ptr<const ClothModel> model) = 0;
    /// A model by with_edit() or with_attachments() in place of the one that it has, or the other way round: as much
    /// room for points.  `copied`: particles of which the ones that it has more are copies, without weight. What moved
    /// goes on moving, pinned particles stay pinned. Where it fails, all is as it was.
    virtual Result<Done> set_topology(ClothHandle cloth, std::shared_ptr<const ClothModel> model,
                                      std::span<const std::uint32_t> copied) = 0;
    /// Puts points from `first` on, which have no weight, to other places, at rest.
    virtual Result<Done> place_points(ClothHandle cloth, std::uint32_t first, std::span<const Vec3> places) = 0;
    /// Changes inverse masses of single particles and nothing else.
    virtual Result<Done> set_weights(ClothHandle cloth, std::span<const ParticleWeight> changed) = 0;
    /// Advances the world by a frame; times of what runs side by side are shares of the time that passes. A device may
    /// be at work still when this returns: the step, and what it points to, must stay until finish(), which comes
    /// before any other call. Where a value is not finite, all cloths of the island are back where the frame began.
    virtual void step(const WorldStep& step) = 0;
    /// Ends the frame that step() began, if there is one. Adds its times, and leaves reports, details and feedback with
    /// its steps; the rest is for read().
    virtual void finish(std::array<double, stage_count>& stage_ms) = 0;
    /// Of the last finished frame.
    virtual ListCounts list_counts() const = 0;
    /// The cloth as it is, in arrays that stay until the next call of anything. False if the device cannot tell any
    /// more: then as it was when it was last read.
    virtual bool read(ClothHandle cloth, ClothFrame& frame) const = 0;
    /// Adds the cloth as it is, and what the last substep left of stretch; as read() has it if the device cannot tell
    /// any more.
    virtual void measure(ClothHandle cloth, MeasureSums& sums) const = 0;
    /// Empty if the device cannot tell any more.
    virtual ClothSnapshot save(ClothHandle cloth) const = 0;
    /// `snapshot` has the sizes that save() gives for this cloth.
    virtual Result<Done> restore(ClothHandle cloth, const ClothSnapshot& snapshot) = 0;
    /// Adds everything that decides what the cloth does next.
    virtual void hash(ClothHandle cloth, StateHash& hash) const = 0;
};

}  // namespace weft
