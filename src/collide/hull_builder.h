// The convex hull of points on an integer grid, built point by point with exact decisions.
#pragma once

#include <weft/mesh.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// A point of the grid. Coordinates are from 0 to hull_grid_steps.
struct GridPoint {
    std::int32_t x = 0, y = 0, z = 0;
};

/// Steps of the grid along the largest extent. Normals of facets then fit into 64 bits, and distances times the length
/// of a normal into 128.
inline constexpr double hull_grid_steps = 1 << 24;

/// Builds a hull of triangles. Starts with a tetrahedron. Each step adds the point that is farthest outside, removes
/// the facets that the point is in front of, and joins the point to the rim of the hole. Each point outside is kept in
/// the list of one facet that it is in front of (Barber, Dobkin and Huhdanpaa 1996, "The Quickhull Algorithm for Convex
/// Hulls"). Which side of a facet a point is on is decided with integers, so the hull of the added points is exact:
/// convex, closed and without facets of no area.
class HullBuilder {
  public:
    enum class Shape { point, line, plane, volume };

    struct Facet {
        Triangle corners{};                        // counterclockwise from outside
        std::array<std::uint32_t, 3> neighbors{};  // across the edges from each corner to the next one
        std::array<std::int64_t, 3> normal{};      // exact, not unit
        double length = 0;                         // of the normal, rounded
        std::vector<std::uint32_t> outside{};      // points in front of it, farther than the tolerance
        std::uint32_t farthest = none;             // of those
        double farthest_distance = 0;              // steps
        bool removed = false;
    };

    /// Points that are at most `tolerance` (in steps, > 0) in front of all facets count as inside. Keeps a reference to
    /// the points.
    HullBuilder(std::span<const GridPoint> points, double tolerance);

    /// What the points span, within the tolerance. Only a volume has a hull.
    Shape shape() const { return shape_; }
    /// How far the points extend, in steps: from a point, a line or a plane, the one that `shape` names. 0 for a
    /// volume.
    double thickness() const { return thickness_; }

    /// Adds points until none is outside or the hull has `max_vertices`.
    void grow(std::size_t max_vertices);

    /// Removed facets are among them.
    std::span<const Facet> facets() const { return facets_; }
    std::size_t facet_count() const { return live_; }
    /// Signed distance of a point to the plane of a facet, in steps.
    double distance(const Facet& facet, std::uint32_t point) const;

  private:
    struct HorizonEdge {
        std::uint32_t from, to, outer;  // two vertices, and the facet that remains
    };

    bool start();
    bool in_front(const Facet& facet, std::uint32_t point) const;
    std::uint32_t make_facet(const Triangle& corners);
    void put_outside(std::uint32_t facet, std::uint32_t point, double distance);
    void distribute(std::span<const std::uint32_t> points, std::size_t first_facet);
    void remove_visible(std::uint32_t first, std::uint32_t point);
    void add(std::uint32_t facet);

    std::span<const GridPoint> points_;
    double tolerance_;
    Shape shape_ = Shape::point;
    double thickness_ = 0;
    std::vector<Facet> facets_;
    std::size_t live_ = 0;
    std::vector<HorizonEdge> horizon_;                  // of the current step
    std::vector<std::uint32_t> orphans_, open_facets_;  // of the current step
};

}  // namespace weft
