// Settings of a whole world.
#pragma once

#include "scene/scene_desc.h"
#include "solver/model/cloth_model.h"
#include "solver/world/backend.h"

#include <cstdint>
#include <optional>

namespace weft {

struct WorldSettings {
    Vec3 gravity{0, -9.81f, 0};  ///< m/s²
    SolverDesc solver = {};
    std::optional<AirDesc> air = {};                      ///< nullopt: no air
    bool surface = true;                                  ///< compute normals
    bool contact_forces = false;                          ///< record contacts
    bool contact_marks = false;                           ///< record ClothFrame::contact_marks
    std::uint32_t list_capacity = default_list_capacity;  ///< initial capacity of dynamic lists, in constraints
    bool background = false;                              ///< rebuild models on a separate thread, one after another

    /// The layout that cloth models need for these settings.
    ClothLayout layout() const {
        return {.lines = resolve(solver.projection, solver.method) == Projection::lines, .hierarchy = solver.hierarchy};
    }
};

}  // namespace weft
