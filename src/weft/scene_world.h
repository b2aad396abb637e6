// A scene as a document, and the world that runs it.
#pragma once

#include "scene/scene_desc.h"
#include "solver/world/world.h"
#include "weft/backends.h"
#include "weft/cloth_building.h"

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

/// scene() is the document. Every change is made here, to the document and to the world; what
/// fails changes neither. The world adds to the document only what moves: positions, velocities, the poses of colliders
/// on their way. So a world that is built from the document starts as this one would have.
///
/// Cloths and colliders stand in the document in the order of the world, and all have a name. Ids must name what is
/// there; values have been checked (check.h), but by change_to().
class SceneWorld {
  public:
    /// A scene that has been checked, or one without cloths, to be filled. Options override its solver. Problems have
    /// JSON pointers as `where`. `make`: in place of make_backend().
    static Result<SceneWorld> create(SceneDesc scene, const Options& options, const std::filesystem::path& folder = {},
                                     const MakeBackend& make = {});

    SceneWorld(SceneWorld&&) noexcept;
    SceneWorld& operator=(SceneWorld&&) noexcept;
    ~SceneWorld();

    const SceneDesc& scene() const { return scene_; }
    /// Where files are looked for.
    const std::filesystem::path& folder() const { return files_.folder; }

    /// `pointer` is the place of the cloth in errors.
    Result<ClothId> add(SceneCloth cloth, const std::string& pointer = {});
    ColliderId add(ColliderDesc collider);
    /// Between cloths that are there, from where they are now.
    Result<StitchId> add(StitchDesc stitches, const std::string& pointer = {});
    void remove(StitchId id);
    /// Its stitches go with it.
    void remove(ClothId id);
    /// Pins that it carried stay where they are.
    void remove(ColliderId id);
    /// Cloth goes on moving as it was. `preset`: the name of the one that the fabric began as. Builds a model only
    /// where with_fabric() cannot make one; coarse levels and tethers may follow some frames later.
    Result<Done> set_fabric(ClothId id, const Fabric& fabric, const std::string& preset);
    /// Particles are held where they are now; boxes are where particles are now. Touches the particles concerned alone,
    /// where pins hold without giving way before and after; what else pins decide follows some frames later.
    Result<Done> set_pins(ClothId id, std::vector<PinDesc> pins);
    /// During the next frame the collider moves there, and stays. Ends its motion by keys.
    void move(ColliderId id, Vec3 position, Vec3 rotation_degrees);
    void set_friction(ColliderId id, std::array<float, 2> friction);
    void set_gravity(Vec3 gravity);
    void set_air(const std::optional<AirDesc>& air);
    /// Makes coarse levels and lines where they are wanted now and were not before.
    Result<Done> set_solver(const SolverDesc& solver);
    /// Whether contacts are accounted for. Nothing of the scene: the same bits with and without.
    void set_feedback(bool on);

    /// Applies the differences from the document to `next`, as an editor does to undo. What has the same name is the
    /// same thing: fabric, pins, friction and pose of what stays are changed while it moves on; a cloth whose mesh or
    /// transform differs and a collider whose shape or keys differ are replaced by new ones. The order of what stays
    /// is kept. Fails, with every problem, on a scene that does not pass its checks, and then changes nothing. If a
    /// cloth cannot be built, the world goes back to the document as it was; cloths that had been removed for it start
    /// anew.
    Result<Done> change_to(SceneDesc next);

    World& world() { return *world_; }
    const World& world() const { return *world_; }
    double frame_seconds() const { return 1.0 / static_cast<double>(scene_.frame_rate); }
    void advance() { world_->advance(frame_seconds()); }
    void advance(double dt) { world_->advance(dt); }
    const Frame& step() { return world_->step(frame_seconds()); }
    const Frame& step(double dt) { return world_->step(dt); }

    /// What building found and survived, a line each.
    const std::vector<std::string>& notes() const { return notes_; }
    /// In the order of the document.
    std::span<const StitchId> stitches() const { return stitch_ids_; }

  private:
    struct Change;

    SceneWorld();
    std::size_t place_of(ClothId id) const;
    std::size_t place_of(ColliderId id) const;
    Result<Done> change_cloth(ClothId id, SceneCloth cloth, ClothPins pins, Holds holds);
    Result<Done> set_models(std::span<Change> changes);
    /// False, and nothing is changed, where the fabric needs a model that is built anew.
    Result<bool> change_material(std::size_t place, const SceneCloth& cloth);
    void rebuild_later(std::size_t place);
    Result<bool> hold_at_once(std::size_t place, const Pinned& pinned);
    Result<Done> change_stitches(const SceneDesc& next);
    void forget_look(const std::string& name);
    void remove_what_is_not_in(const SceneDesc& next);
    void change_colliders(const SceneDesc& next);
    Result<Done> change_cloths(const SceneDesc& next);
    Result<Done> follow(const SceneDesc& next);

    SceneDesc scene_;
    MeshFiles files_;
    std::vector<ClothSource> sources_;  ///< of the cloths, in their order
    std::vector<StitchId> stitch_ids_;  ///< of the rows of stitches, in their order
    std::unique_ptr<World> world_;
    std::vector<std::string> notes_;
};

}  // namespace weft
