// Colliders that cloth passed through between two frames.
#pragma once

#include "solver/measures/true_surfaces.h"
#include "solver/state/frame.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace weft {

/// Finds passages: a collider that passed whole through cloth, or cloth through a thin collider, is not inside it
/// afterwards, so penetration does not show it.
///
/// Each collider has up to 256 points halfway between its opposite sides: the center of a sphere, points of a capsule's
/// axis and of a box's middle plane; for `convex` and `mesh` the middles of straight ways through the shape. A face
/// that sweeps over such a point has lost the side on which it was. The face moves linearly between the frames, as seen
/// from the collider; a collider that turns is followed in steps of 0.2 rad.
///
/// Not found: passages of a plane, which stay as penetration; of colliders whose surface the cloth meets, see
/// Penetration; of cloth smaller than the distance between the points;
/// and of colliders that turn by more than half a turn in a frame. Found although nothing passed: cloth that moves
/// around a collider within one frame by so much that the straight way between leads through its middle.
struct Passages {
    std::uint64_t count = 0;  ///< pairs of a cloth and a collider, summed over the frames in which one passed the other
    std::uint64_t points = 0;  ///< points of colliders that cloth swept over, summed over the frames
    struct Place {
        std::uint64_t frame = 0;
        std::uint32_t collider = 0, cloth = 0;
        Vec3 place{};  ///< m, of the point of the collider at the end of the frame
    };
    std::optional<Place> first;
};

class PassageWatch {
  public:
    /// Compares with the frame before; there, particles that have been appended since were where their originals were.
    /// Starts anew if colliders were exchanged, or cloths by others with fewer particles.
    void add(const Frame& frame, std::span<const Collider> colliders);
    const Passages& passages() const { return passages_; }

  private:
    struct Watched {
        Collider shape;            ///< as it was when its points were made
        std::vector<Vec3> points;  ///< in its frame
        Bounds box;                ///< of them
        Pose before;
    };
    bool same_as_before(const Frame& frame, std::span<const Collider> colliders) const;
    void append_particles(const Frame& frame);
    void remember(const Frame& frame, std::span<const Collider> colliders);
    void compare(const Frame& frame, std::span<const Collider> colliders);

    TrueSurfaces surfaces_;
    std::vector<Watched> watched_;
    std::vector<std::vector<Vec3>> before_;  ///< positions by cloth
    Passages passages_;
};

/// Points halfway between opposite sides of the collider, in its frame. Empty for a plane.
std::vector<Vec3> middle_points(const Collider& collider, TrueSurfaces& surfaces);

/// When a triangle whose corners move linearly sweeps over the point: 0…1; nullopt if it does not.
std::optional<double> time_of_sweep(Vec3 point, const Vec3 (&start)[3], const Vec3 (&end)[3]);

}  // namespace weft
