// Distances to the true surfaces of colliders.
#pragma once

#include "collide/solid_surface.h"
#include "solver/world/collider.h"

#include <memory>
#include <unordered_map>

namespace weft {

/// The surface that a collider is meant to have: for a `mesh` its triangles, not the distance field that cloth collides
/// with; for all other shapes their exact distance, in doubles. Builds the search trees of a mesh when its distance is
/// first asked for, and keeps them. Not thread-safe.
class TrueSurfaces {
  public:
    TrueSurfaces();
    TrueSurfaces(TrueSurfaces&&) noexcept;
    TrueSurfaces& operator=(TrueSurfaces&&) noexcept;
    ~TrueSurfaces();

    /// Whether the distance is a convex function of the point, which allows sharper bounds.
    static bool is_convex(const Collider& collider) { return collider.shape != ShapeKind::mesh; }

    /// Distances to one collider at points that are close to each other. The next probe() of the same shape ends its
    /// use.
    class Probe {
      public:
        /// m, negative inside. In a hole of a mesh, as DistanceField: to the surface that closes it.
        double distance(Vec3 world);
        /// Of the last point: out of the collider, unit, world. Only for convex shapes.
        Vec3 normal() const { return normal_; }
        /// Whether a triangle around the last point is on the same side as that point, as a whole. Only for meshes,
        /// where it may say no although it is.
        bool same_side(const Vec3 (&triangle)[3]) const;

      private:
        friend class TrueSurfaces;
        struct OfMesh;
        explicit Probe(const Collider& collider) : collider_(collider) {}

        const Collider& collider_;
        OfMesh* mesh_ = nullptr;
        double radius_ = 0;  // of the region, in cells
        Vec3 normal_{};
    };
    /// For points within `radius` of `center`. The collider must outlive the probe.
    Probe probe(const Collider& collider, Vec3 center, double radius);

    double distance(const Collider& collider, Vec3 world) { return probe(collider, world, 0).distance(world); }

  private:
    Probe::OfMesh& of_mesh(const std::shared_ptr<const ShapeData>& data);

    std::unordered_map<const ShapeData*, std::unique_ptr<Probe::OfMesh>> meshes_;
};

}  // namespace weft
