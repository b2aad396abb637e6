// Cloths, colliders and time.
#pragma once

#include "solver/backend.h"

#include <memory>
#include <vector>

namespace weft {

struct WorldSettings {
    Vec3 gravity{0, -9.81f, 0};  ///< m/s²
    std::uint32_t substeps = 20;
    std::uint32_t iterations = 1;
    bool surface = true;  ///< keep normals up to date
};

class World {
  public:
    World(std::unique_ptr<Backend> backend, const WorldSettings& settings);

    /// `holds` names colliders that are there already.
    ClothId add(std::shared_ptr<const ClothModel> model, Holds holds = {});
    void add(Collider collider);

    /// Advances by dt seconds, > 0 and finite. The frame stays valid until the next step.
    const Frame& step(double dt);
    /// The last frame; before the first step, the start.
    const Frame& frame() const { return frame_; }

    const WorldSettings& settings() const { return settings_; }
    const std::vector<Collider>& colliders() const { return colliders_; }
    const StepPlan& plan(std::size_t cloth) const { return cloths_[cloth].plan; }
    const Backend& backend() const { return *backend_; }

    /// Over all cloths.
    Residual stretch_residual() const;
    /// 16 hexadecimal digits that differ as soon as one bit of the state does.
    std::string state_hash() const;

  private:
    struct Cloth {
        ClothId id;
        std::shared_ptr<const ClothModel> model;
        Holds holds;
        StepPlan plan;
        std::vector<Pose> mover_poses;
    };

    void replan();
    void place_colliders(double dt);
    void place_movers(Cloth& cloth, double dt) const;

    std::unique_ptr<Backend> backend_;
    WorldSettings settings_;
    std::vector<Cloth> cloths_;
    std::vector<Collider> colliders_;
    std::vector<Pose> poses_;
    Frame frame_;
};

}  // namespace weft
