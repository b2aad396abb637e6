// What changes while a cloth moves, as the CPU backend keeps it.
#pragma once

#include "base/aligned.h"
#include "cpu/contact_account.h"
#include "cpu/passes.h"
#include "solver/model/cloth_model.h"
#include "solver/model/jacobi.h"
#include "solver/plan/step_plan.h"
#include "solver/state/snapshot.h"

#include <array>
#include <memory>
#include <vector>

namespace weft::cpu {

/// The arrays that a step goes on from; what the state hash covers.
struct Particles {
    AlignedVector<Vec4> position, start, velocity, carry;  ///< as in ParticleView

    ParticleView view() { return {&position[0].x, &start[0].x, &velocity[0].x, &carry[0].x}; }
};

/// What the current frame found, to go back to. The fourth floats of `position` are those of Particles::start: weights
/// are the model's, and where the last substep started nobody asks any more.
struct LastGood {
    AlignedVector<Vec4> position, velocity, carry;
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
    LastGood last_good;
    /// Those of stretch outlive a frame, the others an iteration: without a second one they are empty.
    std::array<AlignedVector<float>, constraint_kind_count> lambda;
    AlignedVector<Vec4> contact_sums;  ///< [collider · capacity + particle]; empty with one iteration
    ContactAccount account;            ///< empty without feedback
    AlignedVector<Vec4> normals;
    /// What triangles hand to the particles around them: the air's impulse, and at the end of a frame their normals.
    /// One more stays zero.
    AlignedVector<Vec4> by_face;
    std::vector<LevelState> levels;              ///< as many as the model has, if a plan uses them
    AlignedVector<Vec4> wind;                    ///< per triangle; empty without
    AlignedVector<float> face_mass;              ///< kg, per triangle; empty until a plan has air
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
    SurfaceView surface();
    LevelView level(std::uint32_t i);
    ParticleView level_particles(std::uint32_t i);
    RowView level_rows(std::uint32_t i);
    /// From level i + 1 to level i.
    CarryView carry_to_level(std::uint32_t i) const;
    CarryView carry_to_particles() const;
    AirView air(float density);
    GatherView gather_view(const StepPlan& plan) const;
    CorrectionView correction(ConstraintKind kind, const StepPlan& plan);
    void remember(std::size_t begin, std::size_t end);  ///< particles, as the last good ones
    void remember();                                    ///< all
    void roll_back();
    /// Makes room for what the plan needs beyond the particles; only here memory is asked for.
    void prepare(const StepPlan& plan, std::size_t colliders, unsigned ranks, bool feedback = false);
    /// Lets tethers and coarse levels give way to the tension that the last frame left in the cloth.
    void begin_frame(const StepPlan& plan);
    void end_frame(const StepPlan& plan, double dt);
    void update_normals();

  private:
    CarryView carry_from(std::uint32_t i) const;
};

}  // namespace weft::cpu
