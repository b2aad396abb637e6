// Finds sheets that changed places: one passed through the other as a whole, so that nothing crosses any more.
#pragma once

#include "collide/closest_point.h"

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace weft {

enum class SideOfSheet : std::int8_t { behind = -1, unknown = 0, in_front = 1 };

/// Where a point is relative to a sheet.
struct SheetSide {
    SideOfSheet side =
        SideOfSheet::unknown;  ///< unknown if the closest point is on the rim, or closer than rounding allows to say
    SurfacePoint closest;
};

/// Finds on which side of a sheet points are. In front is where triangles appear counterclockwise. Keeps references to
/// the positions and triangles, which must outlive it.
class SheetSides {
  public:
    SheetSides(std::span<const Vec3> positions, std::span<const Triangle> triangles);

    SheetSide find(Vec3 p) const;
    Vec3 point(const SurfacePoint& at) const;

  private:
    struct EdgeUse {
        std::uint32_t low, high, triangle;
    };
    std::span<const EdgeUse> uses_of(std::uint32_t p, std::uint32_t q) const;

    std::span<const Vec3> positions_;
    std::span<const Triangle> triangles_;
    SurfaceSearch search_;
    std::vector<Vec3> normals_;      // by triangle, unit
    std::vector<Vec3> at_particle_;  // by particle: the normals of its triangles, weighted by angle
    std::vector<EdgeUse> uses_;      // sorted by edge
    std::vector<bool> on_rim_;       // by particle
};

/// One sheet at one time.
struct SheetPose {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> copied_from = {};  ///< originals of the last particles, which were appended later
};

/// Follows sheets through a sequence of poses and finds pairs that changed places.
///
/// A particle of one sheet is over another one if its closest point there is not on that sheet's rim. It passes through
/// if, between two poses in which it is over the sheet, it gets to the other side, while its closest point moves over
/// the sheet by not much more than the particle moves relative to it. So nothing passes that goes around a rim or gets
/// from one layer of a folded sheet to another. A pair has lost its order if, of the particles of either sheet that are
/// over the other one, more than half have passed an odd number of times, and at least a quarter of as many are still
/// over it as ever were.
class SheetOrder {
  public:
    /// The first pose. Later ones must have as many sheets. Particles may be appended, and triangles get other corners
    /// that were copied from theirs.
    explicit SheetOrder(std::vector<SheetPose> start);

    /// The next poses. `near`, m: particles farther from the other sheet do not count. Poses with a position that is
    /// not finite are left out.
    void add(std::vector<SheetPose> poses, double near = std::numeric_limits<double>::infinity());

    /// Pairs of sheets that had lost their order in any pose so far.
    std::size_t lost() const;

  private:
    /// What is known of a particle relative to a sheet.
    struct Track {
        SideOfSheet side = SideOfSheet::unknown;  // when it was last known
        bool passed = false;
        Vec3 place, closest_place;  // at that time
        SurfacePoint closest;
    };
    struct Pair {
        std::array<std::vector<Track>, 2> tracks = {};  // of the particles of either sheet; empty: not followed
        std::array<std::size_t, 2> most = {};           // of them that were over the other sheet
        bool lost = false;
    };
    struct Count {
        std::size_t over = 0, passed = 0;
    };
    void append_particles(std::size_t sheet, const SheetPose& next);
    void begin(std::vector<Track>& tracks, const SheetPose& sheet, const SheetSides& other) const;
    Count follow(std::vector<Track>& tracks, std::size_t sheet, std::size_t other, const SheetSides& sides,
                 double near) const;
    bool moved_along(const Track& track, Vec3 place, const SheetSides& sides, const SheetSide& now,
                     std::size_t other) const;

    std::vector<SheetPose> poses_;
    std::vector<std::vector<Vec3>> first_;  // positions in the first pose
    std::vector<Bounds> bounds_;            // of poses_
    std::vector<double> edge_;              // m, by sheet: mean length in the first pose
    std::vector<Pair> pairs_;               // (0, 1), (0, 2), …, (1, 2), …
};

}  // namespace weft
