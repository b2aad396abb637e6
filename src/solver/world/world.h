// Cloths, colliders and time.
#pragma once

#include "base/id_list.h"
#include "solver/model/cloth_edit.h"
#include "solver/state/address_space.h"
#include "solver/world/backend.h"
#include "solver/world/islands.h"
#include "solver/world/pending_models.h"

#include <memory>
#include <optional>
#include <vector>

namespace weft {

struct WorldSettings {
    Vec3 gravity{0, -9.81f, 0};  ///< m/s²
    SolverDesc solver = {};
    std::optional<AirDesc> air = {};                      ///< without, a vacuum
    bool surface = true;                                  ///< keep normals up to date
    bool feedback = false;                                ///< keep account of what contacts do
    std::uint32_t list_capacity = default_list_capacity;  ///< rows that dynamic lists have room for at first
    bool background = false;  ///< models are rebuilt on a thread of their own, one after another

    /// What the models of a world with these settings should have.
    ClothLayout layout() const {
        return {.lines = resolve(solver.projection, solver.method) == Projection::lines, .hierarchy = solver.hierarchy};
    }
};

/// Everything may be added, removed and changed between two steps. Ids must name what is there.
class World {
  public:
    World(std::unique_ptr<Backend> backend, WorldSettings settings);
    // Defined in world.cpp, so that other files do not compile the destruction of all members again.
    World(World&&) noexcept;
    World& operator=(World&&) noexcept;
    ~World();

    /// `holds` names colliders that are there already. Fails where the backend's device has no room for the cloth.
    Result<ClothId> try_add(std::shared_ptr<const ClothModel> model, Holds holds = {});
    /// For backends that have the memory of the program itself, which is there or throws.
    ClothId add(std::shared_ptr<const ClothModel> model, Holds holds = {});
    void remove(ClothId id);
    /// Another model for the same particles, with other material or other pins; what moves goes on moving.
    Result<Done> set_model(ClothId id, std::shared_ptr<const ClothModel> model, Holds holds);
    /// A model by with_fabric(): other numbers for the rows that there are. Pins stay as they are now. Drops what
    /// rebuild_later() has pending.
    Result<Done> set_material(ClothId id, std::shared_ptr<const ClothModel> model);
    /// Other pins for what is there: touches the particles concerned alone. Particles that are pinned stay where they
    /// are, those that are let go get their weight back. `pinned`: in any order, repetitions allowed. Tethers and
    /// coarse levels stay those of the model until set_model().
    Result<Done> set_pins(ClothId id, std::vector<std::uint32_t> pinned, Holds holds);
    /// The same with springs: `attachments` in place of those that there are, with anchors at their places. False, and
    /// nothing is changed, where the model has no room for so many.
    Result<bool> set_pins(ClothId id, std::vector<std::uint32_t> pinned, Holds holds,
                          const std::vector<Attachment>& attachments);
    /// Another model for the same particles and pins in a later frame, frames_to_build() from now: the same one on
    /// every run. Until then the cloth goes on with the model that it has. Dropped by another call for the same cloth,
    /// by set_model() and with the cloth. Where building fails, the cloth keeps its model.
    /// Does nothing for a cloth that has been edited: the new model would not have the edits.
    void rebuild_later(ClothId id, BuildModel build);
    /// Changes single constraints, triangles and particles, within what the model has in reserve; what moves goes on
    /// moving. Coarse levels go where triangles or particles change. Part of the state until set_model().
    Result<Done> edit(ClothId id, const ClothEdit& edit);
    /// Whether a model is pending for the cloth.
    bool is_rebuilding(ClothId id) const { return pending_.contains(id); }
    bool contains(ClothId id) const { return cloths_.contains(id); }
    const std::shared_ptr<const ClothModel>& model(ClothId id) const { return cloths_[cloths_.find(id)].model; }
    const Holds& holds(ClothId id) const { return cloths_[cloths_.find(id)].holds; }

    /// Ties points on cloth together, which makes one island of their cloths. Gone with any of its cloths.
    StitchId add(std::vector<Stitch> stitches);
    void remove(StitchId id);
    bool contains(StitchId id) const { return stitches_.contains(id); }

    ColliderId add(Collider collider);
    /// Pins that it carried stay where they are.
    void remove(ColliderId id);
    bool contains(ColliderId id) const { return colliders_.contains(id); }
    const Collider& collider(ColliderId id) const { return colliders_[colliders_.find(id)]; }
    void set_friction(ColliderId id, std::array<float, 2> friction);
    /// During the next frame the collider moves there from where it is, and takes cloth along; then it stays. Ends its
    /// motion by keys.
    void move(ColliderId id, const Pose& to);

    void configure(WorldSettings settings);

    /// Advances by dt seconds, > 0 and finite. A device may be at work still when this returns: whatever asks what came
    /// of it waits, and so does the next step. What becomes of the cloths may stay there until frame() is called.
    void advance(double dt);
    /// And brings them here. The frame stays valid until the next step or change.
    const Frame& step(double dt) {
        advance(dt);
        return frame();
    }
    /// The last frame; before the first step, the start.
    const Frame& frame() const;
    /// Of that frame, without the cloths' arrays.
    const Frame& summary() const {
        complete();
        return frame_;
    }
    std::uint64_t index() const { return frame_.index; }  ///< of the last frame, without waiting
    double time() const { return frame_.time; }
    /// What contacts did, with `settings().feedback`; never waits. After advance() it is that of the frame before, and
    /// of the last one as soon as anything has waited for that: summary(), frame(), a change. Likewise on the CPU,
    /// where nothing waits. None in a world that is fresh or restored.
    const Feedback& feedback() const;

    const WorldSettings& settings() const { return settings_; }
    const std::vector<Collider>& colliders() const { return colliders_.values(); }
    ColliderId collider_id(std::size_t place) const { return colliders_.id_of(place); }
    std::size_t cloth_count() const { return cloths_.size(); }
    ClothId cloth_id(std::size_t place) const { return cloths_.id_of(place); }  ///< in the order of frames
    const WorldPlan& plan() const { return plan_; }
    std::size_t island_count() const { return islands_.size(); }
    /// Places of an island's cloths, in the order of frames.
    std::span<const std::uint32_t> island(std::size_t i) const { return islands_[i].cloths; }
    const Backend& backend() const { return *backend_; }
    Backend& backend() { return *backend_; }
    /// What the backend calls it.
    ClothHandle handle(ClothId id) const { return cloths_[cloths_.find(id)].handle; }

    /// Models that are still being built are waited for and used from now on.
    Snapshot save();
    /// The same bits come after it as came after save(), as long as cloths, colliders and settings are what they were.
    /// Fails, and changes nothing, if the cloths or colliders are not as many or as large.
    Result<Done> restore(const Snapshot& snapshot);

    /// Over all cloths, as they are; what is on a device is measured there.
    ClothMeasures measure() const;
    Residual stretch_residual() const { return measure().residual; }
    /// 16 hexadecimal digits that differ as soon as one bit of the state does.
    std::string state_hash() const;

  private:
    struct Cloth {
        ClothHandle handle;
        std::shared_ptr<const ClothModel> model;
        Holds holds;
        std::uint32_t base = 0;                      ///< of its particles in the address space
        std::vector<std::uint32_t> pinned;           ///< ascending
        std::shared_ptr<const ClothModel> unedited;  ///< none without edits
        std::vector<ClothEdit> edits;                ///< that lead from there to `model`
        PlainStiffness stiffness{};
        std::vector<Pose> mover_poses;
    };
    struct Island {
        std::vector<std::uint32_t> cloths;  ///< places
        LinkTables links;
        bool linked = false;
        IslandPlan plan;
        std::vector<ClothStep> steps;  ///< of a frame
    };

    void replan();
    void make_islands();
    void use_model(const PendingModels::Ready& ready);
    // world_edits.cpp
    static Result<std::shared_ptr<const ClothModel>> edited_model(const Cloth& cloth,
                                                                  const std::vector<ClothEdit>& edits);
    Result<Done> set_edits(Cloth& cloth, const std::vector<ClothEdit>& edits, std::shared_ptr<const ClothModel> model);
    static Result<std::shared_ptr<const ClothModel>> with_fabric_unedited(const Cloth& cloth, const ClothModel& model);
    static void hash_edits(const Cloth& cloth, StateHash& hash);
    Result<Done> exchange_model(Cloth& cloth, std::shared_ptr<const ClothModel> model);
    SavedHolds save_holds(const Holds& holds) const;
    Holds restore_holds(const SavedHolds& saved) const;
    Result<Done> check_fits(const Snapshot& snapshot) const;
    void list_cloths();
    void complete() const;  ///< waits for the frame that a device is at work on
    void settle();          ///< and makes out its feedback, before what that lies in goes
    FrameFeedback& begin_feedback(double dt);
    void place_colliders(double dt);
    void place_movers(Cloth& cloth, double dt) const;

    std::unique_ptr<Backend> backend_;
    WorldSettings settings_;
    IdList<Cloth, struct ClothTag> cloths_;
    IdList<Collider, struct ColliderTag> colliders_;
    std::vector<Pose> poses_;
    std::vector<WindNow> winds_;
    PendingModels pending_;
    AddressSpace space_;
    IdList<std::vector<Stitch>, struct StitchTag> stitches_;
    WorldPlan plan_;
    std::uint64_t plan_serial_ = 0;
    std::vector<Island> islands_;
    std::vector<IslandStep> steps_;  // of a frame
    WorldStep step_;                 // likewise
    mutable Frame frame_;
    mutable bool unread_ = false;   ///< its arrays are still those of a frame before
    mutable bool running_ = false;  ///< the backend has not finished it
    /// In turn: one is read while the next frame writes the other.
    std::array<FrameFeedback, 2> felt_;
    mutable std::optional<std::uint32_t> not_made_out_;  ///< of these, the one of the last finished frame
    mutable Feedback feedback_;
    mutable std::vector<std::uint32_t> vertices_;
};

}  // namespace weft
