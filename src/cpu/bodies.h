// Rigid bodies on the CPU: their motion in a frame, and what pushes them.
#pragma once

#include "base/aligned.h"
#include "cpu/body_contacts.h"
#include "cpu/passes.h"
#include "solver/world/backend.h"

#include <weft/bounds.h>

#include <cstdint>
#include <span>
#include <vector>

namespace weft::cpu {

/// All bodies of a world. The cloths that they can touch step together with them. Sums of pushes are integers, so that
/// they do not depend on the number of threads.
class Bodies {
  public:
    /// Begins a frame from the states of the input. Allocates, on the calling thread.
    void prepare(const WorldStep& step, unsigned workers);
    bool empty() const { return bodies_.empty(); }

    /// A pass over bodies (is_body_pass). One thread, while no other calls any function.
    void run(const Pass& pass);
    /// A frame without cloths.
    void run_alone(const WorldPlan& plan);
    bool all_finite() const;
    /// Writes the states at the end of the frame.
    void finish() const;

    /// Number of the body that the collider is; none: it is none.
    std::uint32_t body_of(std::uint32_t collider) const {
        return collider < body_of_.size() ? body_of_[collider] : none;
    }
    const Pose& now(std::uint32_t body) const { return bodies_[body].now; }        ///< in the substep
    const Pose& before(std::uint32_t body) const { return bodies_[body].before; }  ///< at its start
    /// m: ball_radius() of its collider.
    float ball_radius(std::uint32_t body) const { return bodies_[body].ball_radius; }
    std::uint32_t count() const { return static_cast<std::uint32_t>(bodies_.size()); }
    std::uint32_t collider_of(std::uint32_t body) const { return bodies_[body].collider; }
    /// Where the body was when the contacts of its faces were found.
    const Pose& found(std::uint32_t body) const { return bodies_[body].found; }
    /// Where the body was when the points that are attached to it were placed.
    const Pose& placed(std::uint32_t body) const { return bodies_[body].placed; }
    bool feels_cloth(std::uint32_t body) const { return bodies_[body].of->body->desc.reaction; }
    /// Counts contacts that a worker has found.
    void add_touches(unsigned worker, std::uint32_t body, std::uint32_t count) { sums_[worker][body].touches += count; }
    /// As one of the points of cloth that are attached to it sees it.
    scalar::MovedBody moved_by_attached(std::uint32_t body) const;
    /// Takes the opposite of what a contact did to a particle with this inverse mass, which is now at `x`.
    void add_push(unsigned worker, std::uint32_t body, Vec3 by, Vec3 x, float w);
    /// N·s, at a point in the world.
    void add_impulse(unsigned worker, std::uint32_t body, Vec3 impulse, Vec3 x);
    /// What contact of a worker's particles needs of a body. Sums are the worker's own.
    BodyView view(std::uint32_t body, unsigned worker);

    /// Appends the colliders of bodies that may reach the box in the rest of the frame, by ascending number.
    void find(const Bounds& box, std::vector<std::uint32_t>& to) const;
    /// Changes when find() may find more than before.
    std::uint64_t reach_serial() const { return reach_serial_; }

  private:
    void predict();
    void count_touches();
    void take_sums(std::uint32_t sweeps);
    void watch_reach();

    std::vector<BodyInStep> bodies_;
    std::vector<std::uint32_t> body_of_;  ///< by collider; empty without bodies
    std::vector<BodyStep> steps_;         ///< of the input
    std::vector<Bounds> reach_;           ///< where each body is expected in the frame
    std::uint64_t reach_serial_ = 0;
    std::vector<AlignedVector<BodySums>> sums_;  ///< by worker, then by body
    BodyContacts contacts_;
    Vec3 gravity_;
    float h_ = 0;
    std::uint32_t substep_ = 0, substeps_ = 0;
};

}  // namespace weft::cpu
