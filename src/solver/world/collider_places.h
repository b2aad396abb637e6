// Where the colliders are during a frame: poses after each substep, and a search by boxes.
#pragma once

#include "collide/bvh.h"
#include "solver/world/collider.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace weft {

/// A collider that moves costs little in a frame unless somebody asks for its pose: poses after substeps are computed
/// at the first question. pose() and find() may be called by several threads at a time.
class ColliderPlaces {
  public:
    /// Colliders were added, removed or put elsewhere since the last frame.
    void reset() { known_ = false; }
    /// `colliders` must stay where they are, and keep their poses, as long as functions other than end_pose() are
    /// called.
    void begin_frame(std::span<const Collider> colliders, double time, double dt, std::uint32_t substeps);

    std::size_t size() const { return count_; }
    std::uint32_t substeps() const { return substeps_; }
    /// Changes whenever the colliders, the trees at rest, the poses at rest, or the set of those that move change.
    std::uint64_t order() const { return order_; }
    /// Colliders that rest and that move, as the trees number them.
    std::span<const std::uint32_t> resting() const { return resting_; }
    std::span<const std::uint32_t> moving() const { return moving_; }
    /// Those that no box contains, which are not in the trees; at rest, and moving.
    std::span<const std::uint32_t> unbounded() const { return unbounded_; }
    std::span<const std::uint32_t> unbounded_moving() const { return unbounded_moving_; }
    const Bvh& resting_tree() const { return resting_tree_; }
    const Bvh& moving_tree() const { return moving_tree_; }
    /// Whether the collider may move in this frame.
    bool moves(std::size_t collider) const { return moving_place_[collider] != none; }
    /// After a substep: 0, the start of the frame, … substeps().
    const Pose& pose(std::size_t collider, std::uint32_t substep) const {
        const std::uint32_t place = moving_place_[collider];
        if (place == none) return resting_poses_[collider];
        if (!ready_[place].load(std::memory_order_acquire)) compute(collider, place);
        return moving_poses_[std::size_t{place} * (substeps_ + 1) + substep];
    }
    /// pose(collider, substeps()).
    const Pose& end_pose(std::size_t collider) const {
        const std::uint32_t place = moving_place_[collider];
        return place == none ? resting_poses_[collider] : end_poses_[place];
    }

    /// Appends all colliders that may touch the box at any time of the frame, by ascending index. Some of them may not.
    /// `surfaces`: also those with a Collider::surface. Bodies, whose motion the backend knows, are left out.
    void find(const Bounds& box, std::vector<std::uint32_t>& to, bool surfaces = true) const;

  private:
    void sort_by_motion();
    void compute(std::size_t collider, std::uint32_t place) const;
    Pose pose_after(const Collider& collider, std::uint32_t substep) const;
    Bounds swept(const Collider& collider, const Pose& end) const;
    void build_moving_tree();
    bool misses(std::uint32_t collider, const Bounds& box) const;

    bool known_ = false;
    std::uint64_t order_ = 0;
    std::span<const Collider> colliders_;
    std::size_t count_ = 0;
    double time_ = 0, dt_ = 0;
    std::uint32_t substeps_ = 0;

    std::vector<std::uint32_t> moving_place_;                  ///< index among those that move; none: rests
    std::vector<std::uint32_t> moving_;                        ///< their colliders
    std::vector<std::uint32_t> resting_;                       ///< those in resting_tree_
    std::vector<std::uint32_t> unbounded_, unbounded_moving_;  ///< those that no box contains
    std::vector<Pose> resting_poses_;                          ///< by collider
    std::vector<Pose> end_poses_;                              ///< by place
    std::vector<Bounds> swept_;                                ///< by place
    Bvh resting_tree_, moving_tree_;
    std::uint32_t refits_ = 0;  ///< since moving_tree_ was built

    mutable std::vector<Pose> moving_poses_;  ///< [place · (substeps + 1) + substep]
    mutable std::unique_ptr<std::atomic<bool>[]> ready_;
    mutable std::mutex computing_;
};

}  // namespace weft
