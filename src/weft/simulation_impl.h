// Implementation of the public Simulation.
#pragma once

#include "scene/problems.h"
#include "solver/measures/penetration.h"
#include "weft/drawn_frame.h"
#include "weft/drawn_solids.h"
#include "weft/scene_world.h"

#include <weft/simulation.h>

#include <span>
#include <utility>
#include <vector>

namespace weft {

/// The error of a function whose id names no object.
inline Error no_such(const char* what) {
    return {what, "is not in this simulation; it was removed or belongs to another one"};
}

/// The problems that check(problems) finds.
template <class Check>
Result<void> checked(Check&& check) {
    Problems problems;
    check(problems);
    if (!problems.none()) return std::move(problems).take();
    return {};
}

struct Simulation::Impl {
    SceneWorld scene;
    mutable DrawnFrame drawn = {};
    mutable bool drawn_is_old = true;
    mutable DrawnSolids drawn_solids = DrawnSolids();
    mutable PenetrationSearch penetration = {};

    World& world() { return scene.world(); }
    const World& world() const { return scene.world(); }
    /// Surfaces of the current frame. They are read from the device on request.
    std::span<const DrawnSurface> surfaces() const {
        if (drawn_is_old) drawn.update(world().frame(), scene.scene().cloths);
        drawn_is_old = false;
        return drawn.surfaces();
    }
    void changed() { drawn_is_old = true; }
};

}  // namespace weft
