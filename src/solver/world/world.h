// The simulated world: cloths, colliders, stitches and time.
#pragma once

#include "base/id_list.h"
#include "solver/model/cloth_edit.h"
#include "solver/state/address_space.h"
#include "solver/world/backend.h"
#include "solver/world/grabs.h"
#include "solver/world/islands.h"
#include "solver/world/pending_models.h"
#include "solver/world/tangle_watch.h"
#include "solver/world/world_moment.h"
#include "solver/world/world_settings.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace weft {

/// Objects can be added, removed and changed between two steps. Ids must name existing objects. Not thread-safe.
class World {
  public:
    World(std::unique_ptr<Backend> backend, WorldSettings settings);
    // Defined in world.cpp, so that other files do not compile the destruction of all members again.
    World(World&&) noexcept;
    World& operator=(World&&) noexcept;
    ~World();

    /// Colliders named in `targets` must exist. Fails if the device has not enough memory.
    Result<ClothId> try_add(std::shared_ptr<const ClothModel> model, KinematicTargets targets = {});
    /// Like try_add(), but throws if it fails. For backends that use only host memory.
    ClothId add(std::shared_ptr<const ClothModel> model, KinematicTargets targets = {});
    void remove(ClothId id);
    /// Sets another model of the same particles, with another material or other pins. Positions and velocities are
    /// kept. `pinned`: the pinned particles, in any order; nullopt: those of the model. If all edits of the cloth are
    /// openings, the new model gets them too, and `pinned` can name copies; other edits are dropped. `model` must not
    /// have edits.
    Result<void> set_model(ClothId id, std::shared_ptr<const ClothModel> model, KinematicTargets targets,
                           std::optional<std::vector<std::uint32_t>> pinned = {});
    /// The same with another reserve (ClothReserve). The cloth must not have been edited.
    Result<void> set_model_with_room(ClothId id, std::shared_ptr<const ClothModel> model, KinematicTargets targets);
    /// Sets a model made by with_fabric() or with_tear_paint(): the same constraints with other parameters. Pins are
    /// kept. Drops a model that rebuild_later() has pending.
    Result<void> set_material(ClothId id, std::shared_ptr<const ClothModel> model);
    /// Replaces the pins. Changes only the particles concerned: newly pinned ones keep their positions, released ones
    /// get their inverse mass back. `pinned`: in any order, repetitions allowed. Tethers and coarse levels remain those
    /// of the model until set_model().
    Result<void> set_pins(ClothId id, std::vector<std::uint32_t> pinned, KinematicTargets targets);
    /// Also replaces the attachments; anchors are placed at their positions. Returns false and changes nothing if the
    /// model has no room for so many attachments.
    Result<bool> set_pins(ClothId id, std::vector<std::uint32_t> pinned, KinematicTargets targets,
                          const std::vector<Attachment>& attachments);
    /// Builds another model of the same particles and pins, and uses it frames_to_build() frames from now: the same
    /// frame on every run. Until then the cloth keeps its model. Another call for the same cloth, set_model() and
    /// removing the cloth drop the pending model. If building fails, the cloth keeps its model. Does nothing for a
    /// cloth with edits other than openings, because the new model would not have them.
    void rebuild_later(ClothId id, BuildModel build);
    /// Changes single constraints, triangles and particles, or opens edges, within the reserve of the model
    /// (with_edit). Positions and velocities are kept. Copies that openings make are pinned like their originals. Edits
    /// belong to the saved state.
    Result<void> edit(ClothId id, const ClothEdit& edit);
    /// Whether a model is pending for the cloth.
    bool is_rebuilding(ClothId id) const { return pending_.contains(id); }
    bool contains(ClothId id) const { return cloths_.contains(id); }
    const std::shared_ptr<const ClothModel>& model(ClothId id) const { return cloths_[cloths_.find(id)].model; }
    /// The model before the edits.
    const std::shared_ptr<const ClothModel>& unedited_model(ClothId id) const {
        const Cloth& cloth = cloths_[cloths_.find(id)];
        return cloth.unedited ? cloth.unedited : cloth.model;
    }
    /// The pinned particles, ascending.
    const std::vector<std::uint32_t>& pinned(ClothId id) const { return cloths_[cloths_.find(id)].pinned; }
    const KinematicTargets& kinematic_targets(ClothId id) const { return cloths_[cloths_.find(id)].targets; }

    /// Ties points on cloth together; their cloths become one island. The stitches are removed with any of these
    /// cloths.
    StitchId add(std::vector<Stitch> stitches);
    void remove(StitchId id);
    bool contains(StitchId id) const { return stitches_.contains(id); }

    /// Pulls a point of a cloth toward `to` from the next frame on. The triangle must be alive, the weights must be ≥ 0
    /// and sum to 1. Triangles are those of ClothFrame; the grab follows its triangle through edits and tears. It is
    /// released with its cloth, and when its triangle is removed. Grabs belong to the saved state and to the hash.
    GrabId grab(ClothId cloth, std::uint32_t triangle, Vec3 weights, Vec3 to, const GrabDesc& spring = {});
    /// The target moves evenly from its place to `to` during the next frame, then stays.
    void move_grab(GrabId id, Vec3 to);
    void release(GrabId id);
    bool contains(GrabId id) const { return grabs().contains(id); }
    /// Whether the grab existed when the last frame began. Does not wait.
    bool knows(GrabId id) const { return grabs_.contains(id); }
    /// Waits for the frame, which may have removed a triangle.
    const Grabs& grabs() const {
        complete();
        return grabs_;
    }
    /// N, with which the grab pulled in the last frame, on average. 0 if the frame was taken back.
    Vec3 grab_force(GrabId id) const { return grabs()[id].force; }
    /// m, of the grabbed point.
    Vec3 grab_position(GrabId id) const;

    /// Fails if the device has not enough memory for the collider's surface.
    Result<ColliderId> try_add(Collider collider);
    /// Like try_add(), but throws if it fails.
    ColliderId add(Collider collider);
    /// Pins that follow the collider stay at their current positions.
    void remove(ColliderId id);
    bool contains(ColliderId id) const { return colliders_.contains(id); }
    const Collider& collider(ColliderId id) const { return colliders_[colliders_.find(id)]; }
    void set_friction(ColliderId id, std::array<float, 2> friction);
    /// Moves the collider from its current pose to `to` during the next frame; cloth in contact moves with it. The
    /// collider then stays there. Ends its motion by keys.
    void move(ColliderId id, const Pose& to);

    /// Makes the collider a body that moves by forces, at its current pose, or nullopt: one that moves as it is told.
    /// The body starts with the velocity and the spin of its description. The collider must have a surface of no mesh
    /// (Collider::surface). Ends a motion by keys. Fails if the backend moves no more bodies. `features` as in
    /// Collider.
    Result<void> set_body(ColliderId id, std::optional<Body> body, BodyFeatures features);
    /// Keeps the features.
    Result<void> set_body(ColliderId id, std::optional<Body> body) {
        return set_body(id, std::move(body), collider(id).features);
    }
    /// Puts a body elsewhere, with another velocity in m/s and angular velocity in rad/s. Cloth and bodies that are
    /// there are pushed out slowly.
    void place_body(ColliderId id, const Pose& pose, Vec3 velocity, Vec3 rate);
    /// Changes the velocity and the spin of a body by an impulse in N·s at a point in world space.
    void push_body(ColliderId id, Vec3 impulse, Vec3 point);
    /// Waits for the frame.
    const Body& body(ColliderId id) const;

    void configure(WorldSettings settings);

    /// Advances by dt seconds, > 0 and finite. On a device it returns as soon as the frame is submitted. Queries of
    /// results, edits and the next step wait for the frame. Positions stay on the device until frame() is called.
    void advance(double dt);
    /// Advances and reads the results. The frame stays valid until the next step or change.
    const Frame& step(double dt) {
        advance(dt);
        return frame();
    }
    /// The last frame; before the first step, the state at the start.
    const Frame& frame() const;
    /// The last frame; the cloths' arrays may be out of date.
    const Frame& summary() const {
        complete();
        return frame_;
    }
    std::uint64_t index() const { return frame_.index; }  ///< of the last frame, without waiting
    double time() const { return frame_.time; }
    /// Contact forces, if `settings().contact_forces` is on. Never waits. After advance() they are those of the frame
    /// before. They are those of the last frame after a call that has waited for it: summary(), frame(), a change. The
    /// CPU backend follows the same rule. Empty in a new or restored world.
    const ContactForces& contact_forces() const;

    const WorldSettings& settings() const { return settings_; }
    /// Poses of bodies may be those of an earlier frame until a call has waited for the last one.
    const std::vector<Collider>& colliders() const { return colliders_.values(); }
    ColliderId collider_id(std::size_t place) const { return colliders_.id_of(place); }
    std::size_t cloth_count() const { return cloths_.size(); }
    ClothId cloth_id(std::size_t place) const { return cloths_.id_of(place); }  ///< in the order of frames
    const WorldPlan& plan() const { return plan_; }
    std::size_t island_count() const { return islands_.size(); }
    /// Indices of an island's cloths in the order of frames; stitched cloths follow one another.
    std::span<const std::uint32_t> island(std::size_t i) const { return islands_[i].cloths; }
    const Backend& backend() const { return *backend_; }
    Backend& backend() { return *backend_; }
    /// The backend's handle of a cloth.
    ClothHandle handle(ClothId id) const { return cloths_[cloths_.find(id)].handle; }

    /// Waits for models that are still being built; they are used from now on.
    Snapshot save();
    /// Steps after restore() give the same bits as steps after save() did, if cloths, colliders and settings are the
    /// same. Fails and changes nothing if the numbers or sizes of cloths or colliders differ.
    Result<void> restore(const Snapshot& snapshot);

    /// Everything of this world at this moment, to go back to it. Unlike save(), it does not wait for models that are
    /// being built.
    WorldMoment moment();
    /// Brings everything back, to the bit, including models, pins, colliders, settings and pending models. The world
    /// must have as many cloths with the same particles, as many colliders of the same shapes, and the same stitches as
    /// then, in the same order; ids may differ. Fails if the device has not enough memory; the world may then hold a
    /// part of the moment.
    Result<void> go_to(const WorldMoment& moment);
    /// Orders the cloths and the colliders. Each list holds all ids, each once.
    void reorder(std::span<const ClothId> cloths, std::span<const ColliderId> colliders);

    /// Measures over all cloths. State on a device is measured there.
    ClothMeasures measure() const;
    Residual stretch_residual() const { return measure().residual; }
    /// A 64-bit hash of the state of all cloths, as 16 hexadecimal digits.
    std::string state_hash() const;

  private:
    struct Cloth {
        ClothHandle handle;
        std::shared_ptr<const ClothModel> model;
        KinematicTargets targets;
        std::uint32_t base = 0;                      ///< start of its range in the address space
        std::vector<std::uint32_t> pinned;           ///< ascending
        std::shared_ptr<const ClothModel> unedited;  ///< model before the edits; null without edits
        std::vector<ClothEdit> edits;                ///< lead from `unedited` to `model`
        PlainStiffness stiffness{};
        std::vector<Pose> motion_poses;
        std::vector<std::uint32_t> motion_bodies;  ///< ClothStep::motion_bodies of the frame
        std::vector<GrabStep> grabs;               ///< of the frame
        std::vector<Vec4> pulls;                   ///< ClothStep::pulls of the frame
    };
    /// The surface of a collider: a cloth for the backend alone.
    struct Surface {
        ColliderId collider;
        ClothHandle handle;
        std::shared_ptr<const ClothModel> model;
        std::uint32_t base = 0;                ///< start of its range in the address space
        bool moves = false;                    ///< the collider has moved, or has keys
        std::vector<KinematicTarget> targets;  ///< all particles; empty if it does not move
        std::vector<Pose> poses;               ///< after each substep of a frame
        Bounds bounds;                         ///< m: of the particles in the collider's frame
        std::vector<Vec4> positions;           ///< where watch_tangle() has found it
        ClothFrame frame;                      ///< ClothStep needs one; its values are not used
    };
    struct Island {
        std::vector<std::uint32_t> cloths;                     ///< indices; those of each part follow one another
        std::vector<std::uint32_t> surfaces;                   ///< indices of surfaces that its cloths can touch
        std::vector<StitchedPart> parts;                       ///< of `cloths`, then one per surface
        std::vector<std::unique_ptr<const LinkTables>> links;  ///< of the parts that have any
        std::shared_ptr<const Seams> seams;                    ///< null without stitches between cloths that can touch
        IslandPlan plan;
        std::vector<ClothStep> steps;  ///< scratch of a frame
    };

    void replan();
    void make_islands();
    std::vector<std::array<std::uint32_t, 2>> colliding_parts(std::span<const std::uint32_t> part_of,
                                                              std::uint32_t parts) const;
    void use_model(const PendingModels::Ready& ready);
    // world_edits.cpp
    static Result<std::shared_ptr<const ClothModel>> edited_model(const Cloth& cloth,
                                                                  const std::vector<ClothEdit>& edits);
    static Result<std::shared_ptr<const ClothModel>> opened_model(const Cloth& cloth,
                                                                  const std::vector<Opening>& openings,
                                                                  std::uint32_t pruned);
    Result<void> set_edits(Cloth& cloth, const std::vector<ClothEdit>& edits, std::shared_ptr<const ClothModel> model);
    static Result<std::shared_ptr<const ClothModel>> with_fabric_unedited(const Cloth& cloth, const ClothModel& model);
    std::vector<ParticleWeight> pin_copies(Cloth& cloth, const ClothModel& model, std::size_t plain_copies) const;
    static bool has_only_openings(const Cloth& cloth);
    static ClothEdit all_openings(const Cloth& cloth);
    static void hash_edits(const Cloth& cloth, StateHash& hash);
    Result<void> exchange_model(Cloth& cloth, std::shared_ptr<const ClothModel> model,
                                std::optional<std::vector<std::uint32_t>> pinned);
    SavedTargets save_targets(const KinematicTargets& targets) const;
    KinematicTargets restore_targets(const SavedTargets& saved) const;
    Result<void> restore_cloths(const Snapshot& snapshot, std::span<const std::shared_ptr<const ClothModel>> models);
    Result<void> restore_cloth(Cloth& cloth, const ClothSnapshot& snapshot,
                               const std::shared_ptr<const ClothModel>& model);
    Result<void> check_fits(const Snapshot& snapshot) const;
    Snapshot snapshot();
    Result<void> bring_back(const Snapshot& snapshot);
    void list_cloths();
    // world_surfaces.cpp
    Result<Surface> make_surface(const Collider& collider);
    void remove_surface(ColliderId id);
    Surface* surface_of(ColliderId id);
    void put_surfaces();
    void begin_surfaces();
    void place_surfaces();
    float surface_motion() const;
    ClothStep step_of(Surface& surface) const;
    std::vector<Vec3> places_of(const Surface& surface) const;
    // world_grabs.cpp
    bool is_grabbed(ClothId id) const;
    void begin_grabs();
    void read_grabs() const;
    void drop_grabs_without_triangle() const;
    void hash_grabs(StateHash& hash) const;
    std::vector<SavedGrab> save_grabs() const;
    Result<void> check_grabs(const Snapshot& snapshot, std::span<const std::shared_ptr<const ClothModel>> models) const;
    void restore_grabs(const std::vector<SavedGrab>& saved);
    // world_bodies.cpp
    Result<void> can_move(std::size_t bodies) const;
    std::size_t body_count() const;
    PlannedCloth planned(std::size_t place) const;
    bool is_attached(const KinematicTargets& targets) const;
    BodyMass mass_with_cloth(ColliderId id) const;
    void begin_bodies();
    void end_bodies() const;
    void hash_bodies(StateHash& hash) const;
    std::vector<SavedBody> save_bodies() const;
    Result<void> check_bodies(const Snapshot& snapshot) const;
    void restore_bodies(const std::vector<SavedBody>& saved);
    // world_contact.cpp
    std::shared_ptr<const Seams> seams_of(std::span<const std::uint32_t> cloths,
                                          std::span<const PlacedStitch> stitches) const;
    std::optional<ParticlePlace> place_of(std::uint32_t particle) const;
    void watch_tangle() const;
    void collect_contact_marks() const;
    void take_openings() const;
    void complete() const;        ///< waits for the frame that runs on a device
    void complete_and_resolve();  ///< complete(), and resolves the contact log before its memory is freed
    ContactLog& begin_contact_forces(double dt);
    void place_colliders(double dt);
    void place_motions(Cloth& cloth, double dt) const;

    std::unique_ptr<Backend> backend_;
    WorldSettings settings_;
    mutable IdList<Cloth, struct ClothTag> cloths_;
    bool compensated_ = false;           ///< of the last frame: compensates()
    mutable std::vector<ClothId> torn_;  ///< cloths whose models changed by tearing since the last replan()
    mutable IdList<Collider, struct ColliderTag> colliders_;
    mutable std::vector<Surface> surfaces_;  ///< of colliders, in the order in which they were added
    std::unique_ptr<ColliderPlaces> places_ = std::make_unique<ColliderPlaces>();
    std::vector<WindNow> winds_;
    PendingModels pending_;
    AddressSpace space_;
    IdList<std::vector<Stitch>, struct StitchTag> stitches_;
    mutable Grabs grabs_;
    WorldPlan plan_;
    std::uint64_t plan_serial_ = 0;
    std::vector<Island> islands_;
    std::vector<BodyStep> bodies_;   // scratch of a frame
    std::vector<IslandStep> steps_;  // scratch of a frame
    WorldStep step_;                 // scratch of a frame
    mutable TangleWatch tangle_;
    std::uint64_t watched_serial_ = 0;  ///< `plan_serial_` at the last step: what changes positions changes it
    mutable Frame frame_;
    mutable bool unread_ = false;   ///< the arrays of frame_ are out of date
    mutable bool running_ = false;  ///< the backend has not finished the frame
    /// They alternate: one is read while the next frame writes the other.
    std::array<ContactLog, 2> contact_logs_;
    mutable std::optional<std::uint32_t> unresolved_;  ///< index of the log of the last finished frame
    mutable ContactForces contact_forces_;
    mutable std::vector<std::uint32_t> vertices_;
};

}  // namespace weft
