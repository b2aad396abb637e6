// A set of triangles as the surface of a solid: which points are inside, how far away the surface is.
//
// The triangles may have holes, may overlap and may be partly turned around. A point is inside if the surface winds
// around it (winding_number.h) more than half a time, in either direction.
//
// A sheet, such as terrain or a wall without a back, winds around no point much more than half a time. It is solid for
// a short way behind the side that its triangles face: there the winding number is positive.
#pragma once

#include "base/workers.h"
#include "collide/bvh.h"
#include "collide/winding_number.h"
#include "mesh/triangle_mesh.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace weft {

struct OrientedTriangles {
    std::vector<Triangle> triangles;  ///< without zero-area ones
    std::uint32_t zero_area = 0;      ///< left out
    std::uint32_t flipped = 0;        ///< turned around
    /// Edges at which the triangles do not continue: those of holes, and those where orientations contradict each
    /// other. Empty for closed surfaces. Each as often as its uses differ between both directions.
    std::vector<std::array<std::uint32_t, 2>> boundary;
};

/// Turns triangles around so that neighbors have the same orientation: in each part of the surface that is connected by
/// edges of two triangles, the orientation of the larger area stays. Parts keep their orientation relative to each
/// other, so a cavity stays one. Vertices at the same place count as one. Fewer than 2^31 triangles, whose corners must
/// be valid and finite.
OrientedTriangles orient_triangles(std::span<const Vec3> positions, std::span<const Triangle> triangles);

class SolidSurface {
  public:
    /// Builds the search trees, at the same time if the team has two workers.
    SolidSurface(std::vector<Vec3> positions, OrientedTriangles oriented, WorkerTeam& team);
    SolidSurface(const SolidSurface&) = delete;
    SolidSurface& operator=(const SolidSurface&) = delete;

    struct Nearest {
        double squared_distance;
        std::uint32_t triangle;
    };
    /// `guess`: a triangle that is likely to be near, or `none`. A good guess makes the search faster.
    Nearest nearest(Vec3 point, std::uint32_t guess) const;

    /// Whether the surface may touch a triangle. False only if a plane separates the triangle from each one of the
    /// surface.
    bool may_touch(const std::array<Vec3, 3>& triangle) const;

    /// Whether the surface is open and, on average, winds around a point on it less than a quarter of a time: a flat
    /// one not at all, half a sphere 0.32 times, a closed surface half a time. A point on it is in the middle of both
    /// sides.
    bool is_sheet() const { return is_sheet_; }
    /// How far a sheet is solid behind its surface, in the unit of length.
    static constexpr double sheet_thickness = 2;

    /// How far the winding number must exceed one half, unless the surface is a sheet. With this margin, which is more
    /// than the error of the winding number, no point next to a flat part is inside because of it alone.
    static constexpr double margin = 0.01;
    double winding(Vec3 point) const { return winding_.at(point); }
    /// How far the winding number is from where a point counts as inside.
    double distance_from_limit(double winding) const {
        return is_sheet_ ? std::abs(winding) : std::abs(std::abs(winding) - (0.5 + margin));
    }
    /// Where the winding number changes from inside to outside in a hole, at first order. In the unit of length.
    double distance_to_limit(Vec3 point, double winding) const;
    /// For a sheet: behind it, at any distance.
    bool is_inside(double winding) const {
        return is_sheet_ ? winding > 0 : winding > 0.5 + margin || winding < -0.5 - margin;
    }
    bool inside(Vec3 point) const { return is_inside(winding(point)); }

    /// Bound on the gradient of the winding number, per unit of length, for all points within `radius` of `center` that
    /// are not on the surface. 0 for closed surfaces; infinite near the edge of a hole.
    double winding_gradient_bound(Vec3 center, double radius) const;

    std::span<const Vec3> positions() const { return positions_; }
    std::span<const Triangle> triangles() const { return oriented_.triangles; }

  private:
    double mean_winding() const;

    std::vector<Vec3> positions_;
    OrientedTriangles oriented_;
    Bvh triangle_tree_, boundary_tree_;
    WindingNumber winding_;
    double boundary_length_ = 0;
    bool is_sheet_ = false;
};

/// Signed distances along a path whose points are close to each other. Finds the nearest triangle from that of the
/// point before, and evaluates the winding number only where the sign can have changed.
class SignedDistanceWalk {
  public:
    /// `gradient_bound`: of the winding number, in the region of the walk.
    SignedDistanceWalk(const SolidSurface& surface, double gradient_bound)
        : surface_(surface), gradient_bound_(gradient_bound) {}
    /// Continues in another region, for which the bound holds.
    void enter_region(double gradient_bound) {
        if (gradient_bound != gradient_bound_) distance_before_ = 0;  // on the way, neither bound may hold
        gradient_bound_ = gradient_bound;
    }
    /// Negative inside. In and near a hole, the estimated distance to the surface that closes it if that is less.
    double distance_at(Vec3 point);
    /// Whether all points that a way through no triangle connects with the last point, and that are within `radius` of
    /// it, are on the same side.
    bool keeps_side_within(double radius) const {
        if (surface_.is_sheet() && winding_ > 0) return false;  // the solid ends behind it
        return surface_.distance_from_limit(winding_) - drift_ - SolidSurface::margin > radius * gradient_bound_;
    }

  private:
    double distance_to_closing_surface(Vec3 point, double distance);
    double distance_to_sheet(double distance, double closing) const;

    const SolidSurface& surface_;
    double gradient_bound_;
    Vec3 before_{};
    double distance_before_ = 0;  // absolute; at first 0, which lets no sign be kept
    std::uint32_t nearest_ = none;
    double winding_ = 0;  // at the last point where it was evaluated
    double drift_ = 0;    // how much it can have changed since
};

}  // namespace weft
