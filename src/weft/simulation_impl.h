// What is behind the public Simulation.
#pragma once

#include "weft/drawn_frame.h"
#include "weft/scene_world.h"

#include <weft/simulation.h>

#include <span>
#include <vector>

namespace weft {

struct Simulation::Impl {
    SceneWorld scene;
    mutable DrawnFrame drawn = {};
    mutable bool drawn_is_old = true;

    World& world() { return scene.world(); }
    const World& world() const { return scene.world(); }
    /// Of the frame as it is; they come from the device when somebody asks for them.
    std::span<const DrawnSurface> surfaces() const {
        if (drawn_is_old) drawn.update(world().frame(), scene.scene().looks);
        drawn_is_old = false;
        return drawn.surfaces();
    }
    void changed() { drawn_is_old = true; }
};

}  // namespace weft
