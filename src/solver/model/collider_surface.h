// The surface of a collider as exact contact sees it: a cloth of particles without weight, without constraints.
#pragma once

#include "solver/model/cloth_model.h"

#include <array>
#include <memory>
#include <string>

namespace weft {

struct ColliderSurface {
    std::shared_ptr<const ClothModel> model;  ///< in the collider's frame; its thickness is 0
    TopologyReport report;
};

/// Vertices at the same position become one particle. Triangles without an area and repeated ones are left out. Edges
/// of three and more triangles are allowed. Fails like build_topology().
Result<ColliderSurface> build_collider_surface(const std::string& name, const TriangleMesh& mesh,
                                               std::array<float, 2> friction);

/// The same surface with another friction. Shares all arrays.
std::shared_ptr<const ClothModel> with_friction(const ClothModel& surface, std::array<float, 2> friction);

}  // namespace weft
