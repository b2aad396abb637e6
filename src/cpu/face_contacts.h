// Contacts of a cloth's faces with colliders on the CPU.
#pragma once

#include "base/aligned.h"
#include "base/workers.h"
#include "cpu/bodies.h"
#include "cpu/collider_lists.h"
#include "cpu/passes.h"
#include "physics/scalar.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace weft::cpu {

/// Sum of pushes in quanta, by axis; then the length of the longest, plus one.
using FaceSum = std::array<std::uint32_t, 4>;

/// Each worker lists the contacts of the faces of its own particles' tiles. All then add their pushes to sums per
/// particle, in integers, so that the result does not depend on the number of threads.
class FaceContacts {
  public:
    /// Allocates, on the calling thread; `faces`, `colliders`: 0 if no pass uses this.
    void prepare(std::uint32_t particles, std::uint32_t faces, std::uint32_t colliders, unsigned workers);

    /// In the first substep, and after one in which cloth met something fast, looks at a worker's part of the faces.
    void find_longest_edge(const Passes& passes, unsigned worker, const ParticleView& particles,
                           const FacesByTile& faces, std::uint32_t substep);
    /// m: the longest that has been found in the frame. Valid for all workers after all have looked.
    float longest_edge() const;

    /// Starts contact of particles: none of these has a face that may touch.
    void clear_near(Range particles);
    /// ContactView::near_faces of a run.
    std::uint8_t* near_faces(const ColliderRun& run) { return near_.empty() ? nullptr : &near_[run.begin]; }

    /// Starts the list of a worker anew.
    void begin(unsigned worker);
    /// Collects the faces that may touch of a run of particles, for calls of find().
    void collect(unsigned worker, const FacesByTile& faces, const ColliderRun& run);
    /// Leaves to the next call of find() or hold() only those of the collected faces that may touch the collider in the
    /// ball. Returns whether there are any. `nearest`: m, no face touches farther away.
    bool narrow(const Passes& passes, unsigned worker, const ParticleView& particles, const FacesByTile& faces,
                const MovingBall& ball, float nearest);
    /// Ends the calls for the collected faces.
    void drop_collected(unsigned worker) { parts_[worker].drop(); }
    /// Appends the contacts of the collected faces with a collider.
    /// Returns how many.
    std::size_t find(const Passes& passes, unsigned worker, const ParticleView& particles, const FacesByTile& faces,
                     std::uint32_t collider, const ContactView& contact, bool is_body);
    /// Adds the pushes of a worker's contacts. `last`: of the sweep that keeps faces from passing.
    void push(const Passes& passes, unsigned worker, const ParticleView& particles, Bodies& bodies, bool last,
              float depenetration, const ThicknessView& thickness);
    /// Whether there are contacts with bodies that cloth moves. Valid for all workers after all have found theirs.
    bool any_of_bodies() const;
    /// Moves the particles whose first push came from a contact of this worker.
    void move(unsigned worker, const ParticleView& particles);
    /// Calls visit(particle, collider, push, lever): what each contact's push does to a particle, and where the contact
    /// is, from the collider's position. By collider and particle in the order of faces. Between push() and move().
    template <class Visit>
    void for_each_push(const ParticleView& particles, bool last, Visit&& visit) const;

    /// Whether faces may pass. Valid for all workers after all have found their contacts.
    bool any_fast() const;
    /// Collects the faces of a run around those that touch and around particles that have been moved back, for calls of
    /// hold().
    /// `last`: only those around particles that the last call of for_each_held() has moved.
    void collect_again(unsigned worker, const FacesByTile& faces, const ColliderRun& run, bool last);
    /// Marks particles of those faces that have passed, after all pushes. `still`: they go no part of their way,
    /// otherwise the part before the touch.
    void hold(const Passes& passes, unsigned worker, const ParticleView& particles, const FacesByTile& faces,
              std::uint32_t collider, const ContactView& contact, bool still);
    /// Calls visit(particle, collider, part of its way) for the particles that a worker marked, and unmarks them. It
    /// returns whether faces around the particle may pass now. `last`: as for collect_again().
    template <class Visit>
    void for_each_held(unsigned worker, bool last, Visit&& visit);
    /// Whether faces may pass around any particle of the last of these calls.
    bool any_settled() const;
    /// Notes for find_longest_edge() what any_fast() says.
    void end_substep() { met_fast_ = met_fast_ || any_fast(); }
    /// Lets collect_again() collect only faces around particles that are moved from now on.
    void forget_settled();

  private:
    /// Contacts of the same collider, up to number `end`.
    struct Group {
        std::uint32_t collider;
        std::size_t end;
    };
    /// Aligned so that no two workers share a cache line.
    struct alignas(cache_line) Part {
        FaceRows rows;
        AlignedVector<Vec4> blocks;
        AlignedVector<std::uint32_t> corners;
        std::vector<Group> groups;
        std::vector<std::uint32_t> pushed, held;
        std::vector<std::uint32_t> items;  ///< faces that are collected
        std::uint32_t item_count = 0;
        std::vector<std::uint32_t> narrowed;  ///< those of narrow(), if is_narrowed
        std::uint32_t narrowed_count = 0;
        bool is_narrowed = false, is_measured = false;
        AlignedVector<float> measures;  ///< of `items`, if is_measured
        bool any_of_bodies = false, any_settled = false;
        float longest_edge = 0;  ///< m, in the frame

        void drop() { item_count = 0, is_narrowed = is_measured = false; }
    };

    static void collect(Part& part, const std::uint8_t* marks, const FacesByTile& faces, const ColliderRun& run);
    FaceView view(const Part& part, const FacesByTile& faces) const;

    static void make_room(Part& part, std::size_t rows);
    /// What a contact does to a corner; in other than the last sweep, per inverse mass.
    static Vec3 push_of(const FaceRows& rows, std::size_t contact, std::size_t corner, bool last);
    /// m: the sum of the pushes.
    static Vec3 total(const FaceSum& sum);
    /// The part of each push that is taken (face_share()).
    static float share_of(const FaceSum& sum);

    unsigned workers_ = 0;
    bool met_fast_ = false;  ///< in the frame
    std::vector<Part> parts_;
    AlignedVector<FaceSum> sums_;        ///< per particle; 0 between two sweeps
    std::vector<std::uint32_t> holds_;   ///< per particle; 0 for those that are not held
    std::vector<std::uint8_t> near_;     ///< per particle: whether a face of it may touch
    std::vector<std::uint8_t> retry_;    ///< per particle: 1 if a face of it touches or it has been held; of these ...
    std::vector<std::uint8_t> settled_;  ///< ... 1 if it has been held last
};

template <class Visit>
void FaceContacts::for_each_push(const ParticleView& particles, bool last, Visit&& visit) const {
    for (unsigned worker = 0; worker < workers_; ++worker) {
        const Part& part = parts_[worker];
        std::size_t i = 0;
        for (const Group& group : part.groups) {
            for (; i < group.end; ++i) {
                const float* lever = part.rows.lever + 4 * i;
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::uint32_t p = part.rows.corners[k][i];
                    const float w = particles.position[4 * std::size_t{p} + 3];
                    const FaceSum& sum = sums_[p];
                    if (!(w > 0) || sum[3] == 0) continue;
                    const float share = last ? share_of(sum) : share_of(sum) * w;
                    visit(p, group.collider, push_of(part.rows, i, k, last) * share,
                          Vec3{lever[0], lever[1], lever[2]});
                }
            }
        }
    }
}

template <class Visit>
void FaceContacts::for_each_held(unsigned worker, bool last, Visit&& visit) {
    Part& mine = parts_[worker];
    for (const std::uint32_t p : mine.held) {
        const std::uint32_t part = WEFT_HOLD_PARTS - (holds_[p] / WEFT_HOLD_COLLIDERS - 1);
        const std::uint32_t collider = holds_[p] % WEFT_HOLD_COLLIDERS;
        holds_[p] = 0;
        if (!visit(p, collider, static_cast<float>(part) / static_cast<float>(WEFT_HOLD_PARTS))) continue;
        retry_[p] = 1;
        if (!last) continue;
        settled_[p] = 1;
        mine.any_settled = true;
    }
    mine.held.clear();
}

}  // namespace weft::cpu
