// What changes while a cloth moves, as the CPU backend keeps it.
#pragma once

#include "base/aligned.h"
#include "cpu/contact_account.h"
#include "cpu/passes.h"
#include "cpu/world_arrays.h"
#include "solver/model/cloth_model.h"
#include "solver/model/jacobi.h"
#include "solver/plan/world_plan.h"
#include "solver/state/particle_weight.h"
#include "solver/state/snapshot.h"

#include <array>
#include <memory>
#include <vector>

namespace weft::cpu {

/// What one coarse level works with in a substep; nothing of it outlives that.
struct LevelState {
    AlignedVector<Vec4> position, origin, displacement;
    AlignedVector<float> lambda;
};

struct ClothState {
    /// The cloth's particles are those from `base` on; the arrays must be large enough.
    ClothState(std::shared_ptr<const ClothModel> cloth_model, WorldArrays& arrays, std::uint32_t base);

    std::shared_ptr<const ClothModel> model;
    WorldArrays& world;
    std::uint32_t base;

    Particles now() const { return world.range(base, model->capacity()); }
    std::span<Vec4> normals() const { return std::span(world.normals).subspan(base, model->capacity()); }
    std::span<float> weights() const { return std::span(world.weight).subspan(base, model->capacity()); }

    /// Those of stretch outlive a frame, the others an iteration: without a second one they are empty.
    std::array<AlignedVector<float>, constraint_kind_count> lambda;
    AlignedVector<Vec4> contact_sums;  ///< [collider · capacity + particle]; empty with one iteration
    ContactAccount account;            ///< empty without feedback
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

    /// The same particles; anchors may come or go. `base` is where they are now, which may be another place.
    void set_model(std::shared_ptr<const ClothModel> other, std::uint32_t new_base);
    /// The same rows, particles and anchors, other numbers.
    void set_material(std::shared_ptr<const ClothModel> other);
    /// Other rows and triangles for the same points: Backend::set_topology().
    void set_topology(std::shared_ptr<const ClothModel> other, std::span<const std::uint32_t> copied);
    void place_points(std::uint32_t first, std::span<const Vec3> places);
    /// Changes inverse masses, nothing else.
    void set_weights(std::span<const ParticleWeight> changed);
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
    GatherView gather_view(const WorldPlan& plan) const;
    CorrectionView correction(ConstraintKind kind, const WorldPlan& plan, const PlainStiffness& stiffness);
    void remember(std::size_t begin, std::size_t end);  ///< particles, as the last good ones
    void remember();                                    ///< all
    void roll_back();
    /// Makes room for what the plan needs beyond the particles; only here memory is asked for.
    void prepare(const WorldPlan& plan, std::size_t colliders, unsigned ranks, bool feedback = false);
    /// Lets tethers and coarse levels give way to the tension that the last frame left in the cloth.
    void begin_frame(const WorldPlan& plan);
    void end_frame(const WorldPlan& plan, double dt);
    void update_normals();

  private:
    void weigh();
    CarryView carry_from(std::uint32_t i) const;
};

}  // namespace weft::cpu
