// Surfaces of the distance fields of mesh colliders, compared with their meshes.
#pragma once

#include "solver/world/collider.h"

#include <array>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

namespace weft {

/// In the collider's frame.
struct FieldSurface {
    std::shared_ptr<const ShapeData> shape;
    float cell = 0;             ///< m
    TriangleMesh mesh;          ///< where the field is zero
    std::vector<float> errors;  ///< per vertex: signed distance to the true surface, in cells; positive outside
    float least = 0, most = 0;  ///< of the errors
    /// Pieces of the mesh's edges that are more than `beyond_counts` outside the field's solid: what it lacks.
    std::vector<std::array<Vec3, 2>> beyond;
    float farthest_beyond = 0;  ///< cells: the field's greatest distance on an edge; 0 if none is outside

    static constexpr float beyond_counts = 0.1f;  ///< cells
};

/// Makes the surface of a shape when it is first asked for, and keeps it while a collider has that shape. Not
/// thread-safe.
class FieldSurfaces {
  public:
    /// Null if the collider has no distance field.
    std::shared_ptr<const FieldSurface> of(const Collider& collider);
    /// Forgets the shapes that no collider has.
    void keep(std::span<const Collider> colliders);
    std::size_t count() const { return known_.size(); }

  private:
    std::unordered_map<const ShapeData*, std::shared_ptr<const FieldSurface>> known_;
};

}  // namespace weft
