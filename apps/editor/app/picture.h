// What the simulating thread copies for the view and the tools.
#pragma once

#include "editor/core/stage.h"
#include "view/world_frame.h"
#include "weft/placement.h"

#include <weft/vector.h>

#include <memory>
#include <optional>
#include <vector>

namespace weft::editor {

/// A point that is being pulled.
struct PulledPoint {
    Vec3 position, target;  ///< m
    Vec3 force;             ///< N
    float max_force = 0;    ///< N
};

struct Picture {
    std::uint64_t serial = 0;  ///< another picture has another one
    std::shared_ptr<const WorldFrameCopy> world;
    std::shared_ptr<const SceneDesc> scene;                       ///< that the world follows
    std::vector<std::shared_ptr<const ParticleNumbers>> numbers;  ///< per cloth
    std::vector<PulledPoint> pulls;
};
using PicturePtr = std::shared_ptr<const Picture>;

/// Copies the present of a stage. Keeps memory for the next copies.
class Photographer {
  public:
    PicturePtr take(Stage& stage) {
        SceneWorld& from = stage.world();
        auto picture = std::make_shared<Picture>();
        picture->serial = ++serial_;
        picture->world = copies_.copy(from.world());
        if (!scene_ || *scene_ != from.scene()) scene_ = std::make_shared<const SceneDesc>(from.scene());
        picture->scene = scene_;
        for (std::size_t i = 0; i < from.scene().cloths.size(); ++i) picture->numbers.push_back(from.numbers(i));
        World& world = from.world();
        for (const weft::Grab& grab : world.grabs())
            picture->pulls.push_back(
                {world.grab_position(grab.id), grab.step.to, grab.force, grab.step.spring.max_force});
        return picture;
    }

  private:
    WorldFrameCopies copies_;
    std::uint64_t serial_ = 0;
    std::shared_ptr<const SceneDesc> scene_;
};

}  // namespace weft::editor
