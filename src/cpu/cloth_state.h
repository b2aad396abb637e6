// What changes while a cloth moves, as the CPU backend keeps it.
#pragma once

#include "base/aligned.h"
#include "cpu/passes.h"
#include "solver/cloth_model.h"
#include "solver/jacobi.h"
#include "solver/snapshot.h"
#include "solver/step_plan.h"

#include <array>
#include <memory>
#include <vector>

namespace weft::cpu {

/// The arrays that a step goes on from; what rollback restores and what the state hash covers.
struct Particles {
    AlignedVector<Vec4> position, start, velocity, carry;  ///< as in ParticleView

    ParticleView view() { return {&position[0].x, &start[0].x, &velocity[0].x, &carry[0].x}; }
};

/// What one coarse level works with in a substep; nothing of it outlives that.
struct LevelState {
    AlignedVector<Vec4> position, origin, displacement;
    AlignedVector<float> lambda;
};

struct ClothState {
    explicit ClothState(std::shared_ptr<const ClothModel> cloth_model);

    std::shared_ptr<const ClothModel> model;
    Particles now;
    Particles last_good;  ///< as the current frame found them
    /// Those of stretch outlive a frame, the others an iteration: without a second one they are empty.
    std::array<AlignedVector<float>, constraint_kind_count> lambda;
    AlignedVector<Vec4> contact_sums;  ///< [collider · capacity + particle]; empty with one iteration
    AlignedVector<Vec4> face_normals, normals;
    std::vector<LevelState> levels;              ///< as many as the model has, if a plan uses them
    AlignedVector<Vec4> wind, air_impulse;       ///< per triangle; empty until a plan has them
    std::unique_ptr<const JacobiGather> gather;  ///< none until a plan projects side by side
    AlignedVector<Vec4> corrections;
    std::vector<AlignedVector<float>> line_scratch;  ///< per rank
    double substep_seconds = 0;                      ///< of the last frame, for lambda's scale; 0 before it
    Limits limits;                                   ///< in this frame, of tethers and coarse rows

    /// The same particles; anchors may come or go.
    void set_model(std::shared_ptr<const ClothModel> other);
    ClothSnapshot save() const;
    void restore(const ClothSnapshot& snapshot);

    AlignedVector<float>& stretch_lambda() { return lambda[static_cast<std::uint32_t>(ConstraintKind::stretch)]; }
    const AlignedVector<float>& stretch_lambda() const {
        return lambda[static_cast<std::uint32_t>(ConstraintKind::stretch)];
    }
    RowView rows(ConstraintKind kind);
    AroundView around() const;
    SurfaceView surface();
    LevelView level(std::uint32_t i);
    ParticleView level_particles(std::uint32_t i);
    RowView level_rows(std::uint32_t i);
    /// From level i + 1 to level i.
    CarryView carry_to_level(std::uint32_t i) const;
    CarryView carry_to_particles() const;
    AirView air(float density);
    GatherView gather_view(bool mean) const;
    CorrectionView correction(ConstraintKind kind, const StepPlan& plan);
    /// Makes room for what the plan needs beyond the particles; only here memory is asked for.
    void prepare(const StepPlan& plan, std::size_t colliders, unsigned ranks);
    void begin_frame() { update_limits(); }
    void end_frame(const StepPlan& plan, double dt);
    void update_normals();

  private:
    /// Lets tethers and coarse levels give way to the tension that the last frame left in the cloth.
    void update_limits();
};

}  // namespace weft::cpu
