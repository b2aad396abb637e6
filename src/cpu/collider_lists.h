// The colliders near each tile of a cloth's particles, and what contact with them adds up during a frame.
#pragma once

#include "base/aligned.h"
#include "base/workers.h"
#include "cpu/passes.h"
#include "solver/world/collider_places.h"

#include <weft/bounds.h>

#include <cstdint>
#include <span>
#include <vector>

namespace weft::cpu {

class Bodies;

/// What decides how far around a tile to look.
struct TileReach {
    Vec3 fall;       ///< m: by gravity, in the rest of the frame
    float substeps;  ///< left in the frame
    float margin;    ///< m: contact, and constraints that pull
    float widest;    ///< m: widest_face()
    float longest;   ///< m: of the edges now
};

/// Consecutive particles that are near the same colliders.
struct ColliderRun {
    std::uint32_t begin, end;    ///< particles
    std::uint32_t first, count;  ///< in ColliderPart::near
};

/// A collider near a run, and the start of its sums in ColliderPart.
struct NearCollider {
    std::uint32_t collider;
    std::size_t sums;
};

/// A tile is lane_padding particles. Each tile has a box in which its particles are expected to stay during the frame,
/// and the colliders that this box touches. The lists of a worker are made again when a particle leaves its box; then
/// tiles only gain colliders. Collider lists change no bit of a result, because contact with a collider that is not
/// touched changes nothing.
class ColliderPart {
  public:
    /// Allocates for lists of twice the length of the last frame's. Where that is too little, a worker allocates.
    void reserve(std::uint32_t tiles, std::uint32_t colliders, bool keeps_sums, bool traces);
    /// Starts a frame for the particles of a worker. `surfaces`: lists also colliders with a Collider::surface.
    void begin_frame(Share mine, bool surfaces = true);
    /// Makes the lists again if a particle has left its box, or edges have become too long for it.
    void cover(const Passes& passes, const ParticleView& particles, const ColliderPlaces& places, const Bodies& bodies,
               const TileReach& reach);

    std::span<const ColliderRun> runs() const { return runs_; }
    std::span<const NearCollider> near(const ColliderRun& run) const {
        return std::span(near_).subspan(run.first, run.count);
    }
    /// Numbers of the bodies among them; `none` for others.
    const std::uint32_t* bodies(const ColliderRun& run) const { return near_bodies_.data() + run.first; }
    /// Whether each of them has been pushed on in the substep, so that its sums are valid. True for colliders that are
    /// not bodies.
    std::uint8_t* touched(const ColliderRun& run) { return touched_.data() + run.first; }
    /// Blocks of four per particle of the run: ContactSum. Null without sums.
    float* sums(const NearCollider& near) { return sums_.empty() ? nullptr : &sums_[near.sums].x; }
    /// Blocks of four per particle of the run: ContactTrace. Null without traces.
    float* moved(const NearCollider& near) { return moved_.empty() ? nullptr : &moved_[near.sums].x; }
    float* turned(const NearCollider& near) { return turned_.empty() ? nullptr : &turned_[near.sums].x; }
    std::span<const Vec4> moved(const NearCollider& near, const ColliderRun& run) const {
        return std::span(moved_).subspan(near.sums, run.end - run.begin);
    }
    std::span<const Vec4> turned(const NearCollider& near, const ColliderRun& run) const {
        return std::span(turned_).subspan(near.sums, run.end - run.begin);
    }

    bool has(std::uint32_t particle) const { return particle >= mine_.begin && particle < mine_.end; }
    void trace(std::uint32_t particle, std::uint32_t collider, Vec3 by, Vec3 lever);

    /// By body, in the pass.
    std::vector<MovingBall> balls;

    /// Particles that have a Support in the substep, if bodies may press them on colliders.
    std::vector<Range> pressed;

  private:
    struct Lists {
        std::vector<std::uint32_t> colliders;  ///< tile by tile
        std::vector<std::uint32_t> begin;      ///< of each tile, then the end
        std::span<const std::uint32_t> of(std::size_t tile) const {
            return std::span(colliders).subspan(begin[tile], begin[tile + 1] - begin[tile]);
        }
    };

    std::uint32_t tiles() const { return static_cast<std::uint32_t>(boxes_.size()); }
    Bounds box_of(const ParticleView& particles, std::uint32_t tile, const TileReach& reach) const;
    void search(const Passes& passes, const ParticleView& particles, const ColliderPlaces& places, const Bodies& bodies,
                const TileReach& reach, std::uint32_t outside, bool all);
    void grow_boxes(float stretch);
    void join_tiles();
    void number_bodies(const Bodies& bodies);
    /// `valid`: of `near`.
    void carry_over(std::span<const ColliderRun> runs, std::span<const NearCollider> near,
                    std::span<const std::uint8_t> valid, AlignedVector<Vec4>& sums, AlignedVector<Vec4>& scratch) const;

    Share mine_{};
    std::uint64_t bodies_serial_ = 0;  ///< Bodies::reach_serial() at the last search
    bool keeps_sums_ = false, traces_ = false, surfaces_ = true;
    std::vector<Bounds> boxes_;  ///< by tile; empty: not searched yet
    float stretch_ = 0;          ///< m: by how much they are larger because edges are long
    Lists lists_, next_lists_;
    std::vector<std::uint32_t> found_;
    std::vector<ColliderRun> runs_, last_runs_;
    std::vector<NearCollider> near_, last_near_;
    std::vector<std::uint32_t> near_bodies_;            ///< by place in near_
    std::vector<std::uint8_t> touched_, last_touched_;  ///< likewise; of last_near_
    std::size_t sum_count_ = 0;
    AlignedVector<Vec4> sums_, moved_, turned_, scratch_;
};

/// A cloth's lists, by worker.
class ColliderLists {
  public:
    /// Allocates, on the calling thread.
    void prepare(std::uint32_t particles, std::uint32_t colliders, unsigned workers, bool keeps_sums, bool traces);
    /// Calls visit(Range) for the particles that have a Support, and forgets them.
    template <class Visit>
    void take_pressed(Visit&& visit) {
        for (Slot& slot : parts_) {
            for (const Range& range : slot.part.pressed) visit(range);
            slot.part.pressed.clear();
        }
    }
    ColliderPart& part(unsigned worker) { return parts_[worker].part; }
    const ColliderPart& part(unsigned worker) const { return parts_[worker].part; }
    /// Adds to the trace of a particle and a collider that a contact moved it `by`; `lever`: where the contact is, from
    /// the collider's position.
    void trace(std::uint32_t particle, std::uint32_t collider, Vec3 by, Vec3 lever);

  private:
    /// Aligned so that no two workers share a cache line.
    struct alignas(cache_line) Slot {
        ColliderPart part;
    };
    std::vector<Slot> parts_;
};

}  // namespace weft::cpu
