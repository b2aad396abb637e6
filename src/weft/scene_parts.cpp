#include "weft/scene_parts.h"

#include <utility>

namespace weft {

Errors placed_at(const std::string& pointer, Errors errors) {
    for (Error& error : errors)
        if (error.fault == Fault::input && error.where.starts_with('/')) error.where.insert(0, pointer);
    return errors;
}

SceneCloth without_meshes(const SceneCloth& cloth) {
    return {.name = cloth.name,
            .mesh = {},
            .render_mesh = {},
            .transform = cloth.transform,
            .velocity = cloth.velocity,
            .fabric = cloth.fabric,
            .fabric_name = cloth.fabric_name,
            .groups = cloth.groups,
            .pins = cloth.pins,
            .cuts = cloth.cuts,
            .seams = cloth.seams,
            .resistance = cloth.resistance,
            .weights = cloth.weights,
            .tethers = cloth.tethers,
            .tether_slack = cloth.tether_slack,
            .self_collision = cloth.self_collision,
            .tearing = cloth.tearing,
            .tear_room = cloth.tear_room,
            .collision_group = cloth.collision_group,
            .collision_mask = cloth.collision_mask,
            .layer = cloth.layer,
            .material = cloth.material};
}

}  // namespace weft
