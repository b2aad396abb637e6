// How deep cloth is inside the true surfaces of colliders.
#pragma once

#include "collide/bvh.h"
#include "solver/measures/true_surfaces.h"
#include "solver/state/frame.h"

#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// Depth of the cloth's particles, edges and faces below the colliders' surfaces. The cloth counts as a surface without
/// thickness: cloth that rests on a collider is half its thickness above it. A particle that has tunneled deep inside
/// counts with its full depth.
struct Penetration {
    double max = 0;             ///< m, at the deepest sample
    double at_most = 0;         ///< m, >= max: the search excludes a deeper place on any face
    std::uint64_t count = 0;    ///< triangles with a sample more than 1 µm inside
    std::uint64_t samples = 0;  ///< points whose distance was computed
    /// Of the deepest sample, if max > 0:
    std::uint32_t collider = none, cloth = none;
    Vec3 place{};  ///< m
};

/// Searches each face near a collider: the point where the face is deepest is found by dividing the face wherever the
/// distance at a sample leaves room for a deeper place. So a needle through the middle of a large face is found.
/// Distances change by at most the way between two points; those of convex shapes are convex functions, whose slope at
/// a sample bounds them everywhere.
///
/// Keeps the search trees of meshes from one frame to the next. Not thread-safe.
class PenetrationSearch {
  public:
    /// A face is divided until nothing can be deeper by more than this, or a thirtieth of its longest side if that is
    /// less, than the deepest sample of all faces; or, if none of its own samples is inside, than the surface.
    static constexpr double resolution = 1e-4;  // m
    /// Largest number of samples for a face and a collider. Where it ends a search, `at_most` says what is left open.
    static constexpr std::uint32_t most_samples = 2048;

    /// Ignores faces with a position that is not finite, colliders where the distance is not, and colliders whose
    /// surface the cloth meets: it may be on either side, and count_intersections() counts where it passes through.
    Penetration measure(const Frame& frame, std::span<const Collider> colliders);

  private:
    struct Point {
        double x, y, z;
    };
    struct Part {
        Point corners[3];
        double bound;  // m, depth that no point of the part exceeds
    };
    void search_face(const Vec3 (&corners)[3], const Collider& collider);
    void add_part(const Part& part, TrueSurfaces::Probe& probe);
    double sample(const Point& at, TrueSurfaces::Probe& probe);
    double limit() const;

    TrueSurfaces surfaces_;
    std::vector<Part> parts_;  // heap: the one with the largest bound first
    Penetration result_;
    // Of the face and collider that are being searched.
    bool convex_ = false;
    double face_depth_ = 0, face_resolution_ = 0;
    std::uint32_t face_samples_ = 0, cloth_ = 0, collider_ = 0;
};

}  // namespace weft
