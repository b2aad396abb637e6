// Runs the passes of a frame on one cloth, worker by worker.
#pragma once

#include "base/workers.h"
#include "cpu/bodies.h"
#include "cpu/cloth_state.h"
#include "cpu/passes.h"
#include "solver/plan/frame_numbers.h"
#include "solver/plan/island_plan.h"
#include "solver/world/backend.h"

namespace weft::cpu {

/// Selects the part of a pass that a thread runs: the same items in every pass.
struct Worker {
    unsigned number = 0, count = 1;
    Share of(std::uint32_t items) const { return share_of(items, lane_padding, number, count); }
};

class ClothRun {
  public:
    ClothRun(const Passes& passes, ClothState& cloth, Bodies& bodies, const WorldStep& step, const ClothStep& mine);

    const ClothModel& model() const { return *cloth_.model; }
    void keep_last_good(Worker worker) const;
    /// Returns whether the speed cap acted.
    bool run(const IslandPass& pass, std::uint32_t substep, Worker worker) const;
    bool all_finite(Worker worker) const;
    void count_contacts(Worker worker) const;

  private:
    Range particles(Worker worker) const;
    Range particles_in_use(Worker worker) const;
    void steady(Range mine) const;
    void release(Range mine) const;
    bool run_particles(const Pass& pass, std::uint32_t substep, Worker worker) const;
    template <class Visit>
    void for_each_target(Range mine, Visit&& visit) const;
    void run_targets(const Pass& pass, std::uint32_t substep, Range mine) const;
    void run_attached(const Pass& pass, Range mine, Worker worker) const;
    ColliderPart& cover_colliders(const Pass& pass, std::uint32_t substep, Range mine, Worker worker) const;
    void run_contacts(const Pass& pass, std::uint32_t substep, Range mine, Worker worker) const;
    void run_body_contacts(const Pass& pass, std::uint32_t substep, Range mine, Worker worker) const;
    bool supports(std::span<const NearCollider> near) const;
    void find_supports(const ColliderRun& run, std::span<const NearCollider> near, std::uint32_t substep) const;
    bool is_body(const NearCollider& near) const { return bodies_.body_of(near.collider) != none; }
    ThicknessView thickness() const;
    /// Without what run_contacts() adds.
    ContactView contact_view(const NearCollider& near, std::uint32_t substep) const;
    /// In the substep.
    MovingBall ball_of(std::uint32_t collider, std::uint32_t substep) const;
    void place_balls(ColliderPart& part, std::uint32_t substep) const;
    /// m
    float widest_to_touch(std::uint32_t collider) const;
    void mark_near_faces(const ColliderRun& run, const NearCollider& near, ContactView& view) const;
    template <class Collect, class Visit>
    void for_each_near_face(const Pass& pass, std::uint32_t substep, Worker worker, Collect&& collect,
                            Visit&& visit) const;
    void run_face_contact(const Pass& pass, std::uint32_t substep, Worker worker) const;
    void move_faces(bool last, Worker worker) const;
    void log_contact(std::uint32_t particle, std::uint32_t collider, Vec3 by, Vec3 lever) const;
    void push_back(std::uint32_t particle, std::uint32_t collider, Vec3 by) const;
    void hold_faces(const Pass& pass, std::uint32_t substep, Worker worker) const;
    bool gives(std::uint32_t collider) const;
    void settle_faces(const Pass& pass, std::uint32_t substep, Worker worker) const;
    void settle_faces_of(unsigned worker, std::uint32_t substep, bool last) const;
    void finish_holds(const Pass& pass, std::uint32_t substep, unsigned workers) const;
    LambdaUse use_of_lambda(const Pass& pass, std::uint32_t substep) const {
        return lambda_use(plan_, model(), pass, substep);
    }
    void run_rows(const Pass& pass, std::uint32_t substep, Worker worker) const;
    void run_range(const Pass& pass, std::uint32_t substep, Range range, bool serial) const;
    void run_lines(const Pass& pass, std::uint32_t substep, Worker worker) const;
    void run_blocks(const Pass& pass, std::uint32_t substep, std::span<const LineBlock> blocks, Worker worker) const;
    void run_corrections(const Pass& pass, std::uint32_t substep, Worker worker) const;
    template <class Visit>
    void for_each_pinned(const CoarseLevel& level, Range mine, Visit&& visit) const;
    void take_attached(std::uint32_t level, Range mine) const;
    void give_attached(std::uint32_t level, Range mine) const;
    void run_level(const IslandPass& island_pass, std::uint32_t substep, Worker worker) const;
    void run_faces(const Pass& pass, Worker worker) const;
    template <class Visit>
    void for_each_grab(Visit&& visit) const;
    void run_grabs(const Pass& pass, std::uint32_t substep) const;
    void run_winds(const AirView& air, Range mine, unsigned worker) const;
    /// Finds the triangles that have a collider within `reach` m against AirView::sheltered.
    void run_shelter(const AirView& air, float reach, Range mine, unsigned worker) const;

    const Passes& passes_;
    ClothState& cloth_;
    Bodies& bodies_;
    const WorldPlan& plan_;
    const StepInput& input_;
    const ClothStep& step_;
    PlannedCloth planned_;
    ParticleView view_;
    FrameNumbers numbers_;
};

}  // namespace weft::cpu
