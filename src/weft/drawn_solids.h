// The rigid objects of a world, as exporters read them.
#pragma once

#include "look/drawn_solid.h"
#include "scene/scene_desc.h"
#include "solver/world/world.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace weft {

/// The colliders that an export shows. Planes are never shown, because they are unbounded.
enum class SolidChoice : std::uint8_t {
    bodies,     ///< those that forces move
    colliders,  ///< all
};

/// Colliders with their meshes and materials, the same ones in all frames.
class DrawnSolids {
  public:
    explicit DrawnSolids(SolidChoice choice = SolidChoice::bodies) : choice_(choice) {}

    /// Sets the poses to those of the world's last frame, for which it waits. The first call chooses the colliders and
    /// makes their meshes. Later calls show the same ones: a collider stays if it ends being a body, and one that
    /// becomes a body later is not added. Removed ones are left out. `colliders`: those of the scene, whose materials
    /// are found by name. Names and materials point into the world and into `colliders`.
    void update(const World& world, std::span<const SceneCollider> colliders = {});
    std::span<const DrawnSolid> solids() const { return solids_; }

  private:
    struct Chosen {
        ColliderId id;
        std::shared_ptr<const TriangleMesh> mesh;
    };
    void choose(const World& world);

    SolidChoice choice_;
    bool has_chosen_ = false;
    std::vector<Chosen> chosen_;
    std::vector<DrawnSolid> solids_;
};

}  // namespace weft
