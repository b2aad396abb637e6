// Interface of the backends that execute a WorldPlan: CPU and Vulkan.
#pragma once

#include "base/hash.h"
#include "collide/seams.h"
#include "collide/tangle.h"
#include "solver/measures/measures.h"
#include "solver/plan/island_plan.h"
#include "solver/state/cloth_contact_counts.h"
#include "solver/state/contact_forces.h"
#include "solver/state/frame.h"
#include "solver/state/grab.h"
#include "solver/state/kinematic_targets.h"
#include "solver/state/list_counts.h"
#include "solver/state/particle_weight.h"
#include "solver/state/snapshot.h"
#include "solver/world/air.h"
#include "solver/world/collider.h"
#include "solver/world/collider_places.h"

#include <weft/result.h>

#include <memory>
#include <span>
#include <string>

namespace weft {

/// A backend's identifier of a cloth. World maps ClothIds to it.
struct ClothHandle {
    std::uint32_t value = 0;
};

/// The most bodies that a device moves.
inline constexpr std::uint32_t most_device_bodies = 256;

/// A collider that is a body, in a frame.
struct BodyStep {
    std::uint32_t collider = 0;  ///< number
    BodyState* state = nullptr;  ///< at the start of the frame; step() or finish() writes the one at its end
    std::uint32_t attached = 0;  ///< points of cloth that are attached to it
};

/// Input of a frame that is common to all cloths.
struct StepInput {
    double dt = 0;                        ///< s, > 0: length of the frame
    Vec3 gravity;                         ///< m/s²
    float air_density = 0;                ///< kg/m³
    std::span<const WindNow> winds = {};  ///< evaluated in the middle of the frame
    std::span<const Collider> colliders = {};
    const ColliderPlaces* places = nullptr;               ///< of the colliders, in this frame
    std::span<const BodyStep> bodies = {};                ///< by ascending collider
    bool contact_forces = false;                          ///< record contacts
    bool contact_marks = false;                           ///< record what contact between cloths does to each particle
    std::uint32_t list_capacity = default_list_capacity;  ///< initial capacity of dynamic lists
    /// Of the cloths that collide with cloth, at the start of the frame; particles are numbered over the world. Null if
    /// nothing is tangled.
    const Tangle* tangle = nullptr;
    /// m: the most that a point of a surface (Collider::surface) moves in a substep.
    float surface_motion = 0;
};

/// One cloth's part of a frame.
struct ClothStep {
    ClothHandle cloth;
    const PlainStiffness* stiffness = nullptr;
    std::span<const KinematicTarget> targets = {};
    /// Poses of the target motions: [substep · motions + motion], substep = 0 … substeps.
    std::span<const Pose> motion_poses = {};
    std::uint32_t motions = 0;
    /// By target motion: number in StepInput::bodies of the body that it follows, or none. Empty: it follows no body.
    /// The poses of such a motion are those at the start of the frame.
    std::span<const std::uint32_t> motion_bodies = {};
    std::span<const GrabStep> grabs = {};
    /// Output: kg·m, the impulse of each grab in each substep times the length of the substep:
    /// [substep · grabs + grab].
    std::span<Vec4> pulls = {};
    ClothFrame* frame = nullptr;                ///< the backend writes reports and details here
    ClothContactLog* contact_forces = nullptr;  ///< output; null if the input records no contacts
};

/// Cloths of an island that stitches connect, directly or through others; or one cloth without stitches.
struct StitchedPart {
    std::uint32_t begin = 0, end = 0;   ///< in the island's cloths
    const LinkTables* links = nullptr;  ///< null if there are no stitches
};

/// An island: cloths that are stitched together or can collide. Islands are independent and may run in parallel. Cloths
/// that are stitched together, and cloths that come near each other in the frame, finish a substep before any of them
/// begins the next.
struct IslandStep {
    const IslandPlan* plan = nullptr;
    std::span<const ClothStep> cloths = {};
    std::span<const StitchedPart> parts = {};  ///< of all cloths, in their order
    std::shared_ptr<const Seams> seams = {};   ///< for contact between cloths; null if there are none
};

struct WorldStep {
    const WorldPlan* plan = nullptr;
    std::uint64_t plan_serial = 0;  ///< changes whenever the plan, the islands or their contents change
    StepInput input = {};
    std::span<const IslandStep> islands = {};
};

class Backend {
  public:
    virtual ~Backend() = default;

    virtual std::string_view name() const = 0;  ///< as on the command line
    virtual std::string device() const = 0;     ///< description for the user
    virtual unsigned threads() const = 0;
    /// The most bodies of a world (StepInput::bodies) that it moves.
    virtual std::uint32_t most_bodies() const { return 0; }
    /// Bytes of device memory in use, besides host memory.
    virtual std::uint64_t device_bytes() const { return 0; }

    /// `base`: start of the cloth's range of model->capacity() particles in the world's address space. No other cloth
    /// uses this range. Fails if the device has not enough memory.
    virtual Result<ClothHandle> add_cloth(std::shared_ptr<const ClothModel> model, std::uint32_t base) = 0;
    virtual void remove_cloth(ClothHandle cloth) = 0;
    /// Sets another model of the same particles, with other constraints, masses or pins. Positions and velocities are
    /// kept. `base` may change; the new range must not overlap that of any cloth, nor the old range of this one. A call
    /// that fails changes nothing.
    virtual Result<void> set_model(ClothHandle cloth, std::shared_ptr<const ClothModel> model, std::uint32_t base) = 0;
    /// Sets a model made by with_fabric(): the same constraints and particles with other parameters. Positions and
    /// velocities are kept, and pinned particles stay pinned. A call that fails changes nothing.
    virtual Result<void> set_material(ClothHandle cloth, std::shared_ptr<const ClothModel> model) = 0;
    /// Sets a model made from the current one by with_edit() or with_attachments(), or goes back to the model before.
    /// Both have room for the same number of points. `copied`: the sources of the additional particles, which start as
    /// copies with inverse mass 0. Positions and velocities are kept, and pinned particles stay pinned. A call that
    /// fails changes nothing.
    virtual Result<void> set_topology(ClothHandle cloth, std::shared_ptr<const ClothModel> model,
                                      std::span<const std::uint32_t> copied) = 0;
    /// Sets the positions of points from `first` on, and their velocities to 0. The points must have inverse mass 0.
    virtual Result<void> place_points(ClothHandle cloth, std::uint32_t first, std::span<const Vec3> places) = 0;
    /// Changes only the inverse masses of single particles.
    virtual Result<void> set_weights(ClothHandle cloth, std::span<const ParticleWeight> changed) = 0;
    /// Advances the world by a frame. On a device it returns as soon as the frame is submitted: the step and everything
    /// it points to must stay valid until finish(), which must be the next call. Stage times of work that runs in
    /// parallel are shares of the elapsed time. If a value becomes non-finite, all cloths of the island are restored to
    /// the start of the frame.
    virtual void step(const WorldStep& step) = 0;
    /// Waits for the frame that step() began, if there is one. Adds its times to `stage_ms`, and writes reports,
    /// details and contacts to its steps. read() returns the other results.
    virtual void finish(std::array<double, stage_count>& stage_ms) = 0;
    /// Counts of the last finished frame.
    virtual ListCounts list_counts() const = 0;
    /// Counts of the last finished frame. All are 0 on a backend without contact of cloth against cloth.
    virtual ClothContactCounts cloth_contact_counts() const { return {}; }
    /// Adds bits (ContactMark) to those of the cloth's particles, if the last finished frame recorded them. Call it
    /// before any change of the cloths.
    virtual void add_contact_marks(ClothHandle, std::span<std::uint32_t>) const {}
    /// Reads the current state of a cloth. The arrays stay valid until the next call of any function. Returns false if
    /// the device is lost; the state is then that of the last read.
    virtual bool read(ClothHandle cloth, ClothFrame& frame) const = 0;
    /// Adds the measures of the current state and the residual of stretch of the last substep. If the device is lost,
    /// of the last read state.
    virtual void measure(ClothHandle cloth, MeasureSums& sums) const = 0;
    /// Empty if the device is lost.
    virtual ClothSnapshot save(ClothHandle cloth) const = 0;
    /// `snapshot` must have the sizes that save() returns for this cloth.
    virtual Result<void> restore(ClothHandle cloth, const ClothSnapshot& snapshot) = 0;
    /// Adds all state that the next step depends on.
    virtual void hash(ClothHandle cloth, StateHash& hash) const = 0;
};

}  // namespace weft
