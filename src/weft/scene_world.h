// A scene and the world that simulates it, kept in agreement.
#pragma once

#include "scene/scene_desc.h"
#include "solver/world/world.h"
#include "weft/backends.h"
#include "weft/checkpoint.h"
#include "weft/cloth_building.h"
#include "weft/shape_building.h"

#include <weft/result.h>
#include <weft/simulation.h>

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace weft {

/// scene() is the document: the scene with all changes so far. Each function changes both the document and the world,
/// or, if it fails, neither. Only the world contains what moves: positions, velocities and poses of moving colliders. A
/// new world that is built from the document therefore begins at the start. Cuts are part of the document, and which
/// edges are open is part of the world's state: before each frame all cuts that are due are made where edges are
/// closed.
///
/// Cloths and colliders have the same order in document and world, and all have names. Ids must name existing objects.
/// Values must have been checked (check.h); only change_to() checks them itself.
class SceneWorld {
  public:
    /// `scene` must have been checked; it may have no cloths. Options::solver overrides its solver settings. `where` of
    /// errors is a JSON pointer. `make`: used instead of make_backend(), if not empty. If a collider is a
    /// body, Options::backend `auto` selects the CPU, unless Options::device names a device.
    static Result<SceneWorld> create(SceneDesc scene, const Options& options, const std::filesystem::path& folder = {},
                                     const MakeBackend& make = {});

    SceneWorld(SceneWorld&&) noexcept;
    SceneWorld& operator=(SceneWorld&&) noexcept;
    ~SceneWorld();

    const SceneDesc& scene() const { return scene_; }
    /// The folder in which files are searched.
    const std::filesystem::path& folder() const { return files_.folder; }

    /// `pointer` is the place of the cloth in errors.
    Result<ClothId> add(SceneCloth cloth, const std::string& pointer = {});
    /// `pointer`: the place of the collider in errors.
    Result<ColliderId> add(SceneCollider collider, const std::string& pointer = "");
    /// Stitches existing cloths together at their current positions.
    Result<StitchId> add(StitchDesc stitches, const std::string& pointer = {});
    void remove(StitchId id);
    /// Also removes the stitches of the cloth.
    void remove(ClothId id);
    /// Pins that are attached to the collider stay at their current positions.
    void remove(ColliderId id);
    /// Positions and velocities are kept. `preset`: name of the preset that the fabric is based on. Rebuilds the model
    /// only if with_fabric() cannot make one; coarse levels and tethers may follow some frames later.
    Result<void> set_fabric(ClothId id, const Fabric& fabric, const std::string& preset);
    /// Particles are pinned at their current positions; boxes select by current positions. Changes only the particles
    /// concerned if neither old nor new pins have a compliance. Coarse levels and tethers follow some frames later.
    Result<void> set_pins(ClothId id, std::vector<PinDesc> pins);
    /// Positions and velocities are kept. Boxes select by the positions at the start. The model is rebuilt.
    Result<void> set_weights(ClothId id, std::vector<WeightDesc> weights);
    /// Likewise, without a rebuild. The cloth must tear or erode.
    Result<void> set_resistance(ClothId id, std::vector<ResistanceDesc> resistance);
    /// Cuts the cloth now. Positions are those of `positions`. Not part of the document; part of the saved state.
    Result<void> cut(ClothId id, const CutDesc& cut, CutPositions positions);
    /// Pulls a point of the simulated mesh (World::grab). Not part of the document; part of the saved state.
    Result<GrabId> grab(ClothId id, const MeshPoint& point, Vec3 to, const GrabDesc& spring);
    /// Moves the collider during the next frame; it then stays there. Ends its motion by keys.
    void move(ColliderId id, Vec3 position, Vec3 rotation_degrees);
    /// Fails and changes nothing for values that no body has, and for a collider that pins are attached to.
    Result<void> set_body(ColliderId id, const std::optional<BodyDesc>& body);
    void set_friction(ColliderId id, std::array<float, 2> friction);
    void set_gravity(Vec3 gravity);
    void set_air(const std::optional<AirDesc>& air);
    /// Rebuilds all models if the new settings need another layout (coarse levels, lines).
    Result<void> set_solver(const SolverDesc& solver);
    /// Whether contacts are recorded. Not part of the document; the motion has the same bits with and without it.
    void set_contact_forces(bool on);
    /// Likewise for ClothFrame::contact_marks.
    void set_contact_marks(bool on);

    /// Applies the differences between the document and `next`, for example to undo edits. Objects are matched by name.
    /// Fabric, pins, resistance, friction and pose of a matched object are changed while it keeps moving. A cloth whose
    /// mesh, transform or velocity differs, and a collider whose shape or keys differ, are replaced by new ones.
    /// Objects then have the order of `next`. Fails on a scene that does not pass its checks, with all problems, and on
    /// a cloth that cannot be built, and then changes nothing.
    Result<void> change_to(SceneDesc next);

    /// Gives cloths and colliders other names. `next` must equal the document except for names and references to them.
    /// Everything keeps moving.
    Result<void> rename(const SceneDesc& next);

    /// The document and the world at this moment, to go back to it, also in another SceneWorld with another backend.
    Checkpoint checkpoint();
    /// Brings the document and the world back, to the bit: steps from here give the bits of the steps from then, and
    /// so do changes. Objects that were removed since then come back with new ids, without being built again. Fails if
    /// the device has not enough memory, and then changes nothing.
    Result<void> go_to(const Checkpoint& checkpoint);

    World& world() { return *world_; }
    const World& world() const { return *world_; }
    double frame_seconds() const { return 1.0 / static_cast<double>(scene_.frame_rate); }
    /// Makes the cuts that are due, then advances the world.
    void advance(double dt) {
        make_cuts();
        world_->advance(dt);
    }
    void advance() { advance(frame_seconds()); }
    const Frame& step(double dt) {
        advance(dt);
        return world_->frame();
    }
    const Frame& step() { return step(frame_seconds()); }

    /// Warnings, one line each: of building cloths, and of cuts that were due and for which there was no room.
    const std::vector<std::string>& notes() const { return notes_; }
    /// How the vertices of a cloth in the document are numbered as particles. `place`: of the cloth in the document.
    const std::shared_ptr<const ParticleNumbers>& numbers(std::size_t place) const { return sources_[place].numbers; }
    /// Ids of the stitches, in the order of the document.
    std::span<const StitchId> stitches() const { return stitch_ids_; }

  private:
    struct Change;

    SceneWorld();
    void make_cuts();
    void make_cuts(std::size_t place);
    std::size_t place_of(ClothId id) const;
    std::size_t place_of(ColliderId id) const;
    Result<void> change_cloth(ClothId id, SceneCloth cloth, ClothPins pins, KinematicTargets targets,
                              std::vector<std::uint32_t> pinned);
    Result<void> set_models(std::span<Change> changes);
    /// Returns false and changes nothing if the fabric needs a rebuilt model.
    Result<bool> change_material(std::size_t place, const SceneCloth& cloth);
    Result<void> change_resistance(std::size_t place, const SceneCloth& cloth, const std::string& pointer);
    /// Whether change_tearing() can make the cloth one that parts like `wanted`, without starting it again.
    bool can_change_tearing(std::size_t place, const SceneCloth& wanted) const;
    Result<void> change_tearing(std::size_t place, const SceneCloth& wanted);
    void rebuild_later(std::size_t place);
    Result<bool> target_at_once(std::size_t place, const Pinned& pinned);
    Result<void> change_stitches(const SceneDesc& next);
    void remove_what_is_not_in(const SceneDesc& next);
    Result<void> change_colliders(const SceneDesc& next);
    Result<void> change_cloths(const SceneDesc& next);
    Result<void> change_all(const SceneDesc& next);
    void take_order_of(const SceneDesc& next);
    // checkpoint.cpp
    Result<void> match_objects(const Checkpoint& checkpoint);
    Result<void> match_stitches(const SceneDesc& scene, bool all);

    SceneDesc scene_;
    MeshFiles files_;
    ShapeLibrary shapes_;
    std::vector<ClothSource> sources_;                   ///< per cloth, in the order of the document
    std::vector<std::uint64_t> collider_serials_;        ///< per collider; another collider has another one
    std::vector<StitchId> stitch_ids_;                   ///< per StitchDesc, in the order of the document
    std::shared_ptr<const SceneDesc> checked_document_;  ///< of the last checkpoint
    std::unique_ptr<World> world_;
    std::vector<std::string> notes_;
};

}  // namespace weft
