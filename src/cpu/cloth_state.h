// The CPU backend's mutable state of a cloth.
#pragma once

#include "base/aligned.h"
#include "cpu/collider_lists.h"
#include "cpu/contact_account.h"
#include "cpu/face_contacts.h"
#include "cpu/passes.h"
#include "cpu/tearing.h"
#include "cpu/world_arrays.h"
#include "solver/model/cloth_model.h"
#include "solver/model/jacobi.h"
#include "solver/plan/world_plan.h"
#include "solver/state/particle_weight.h"
#include "solver/state/snapshot.h"

#include <weft/bounds.h>

#include <array>
#include <memory>
#include <vector>

namespace weft::cpu {

/// Working memory of one coarse level. Its content is valid within a substep only.
struct LevelState {
    AlignedVector<Vec4> position, origin, displacement, remainder;
    AlignedVector<float> lambda;
};

struct ClothState {
    /// The cloth's particles start at `base`; the arrays must be large enough.
    ClothState(std::shared_ptr<const ClothModel> cloth_model, WorldArrays& arrays, std::uint32_t base);

    std::shared_ptr<const ClothModel> model;
    WorldArrays& world;
    std::uint32_t base;
    AlignedVector<float> thickness_factors;  ///< of the model; particles that openings copy in the frame have theirs
    bool rests = false;                      ///< in this frame: it is the surface of a collider that does not move

    Particles now() const { return world.range(base, model->capacity()); }
    std::span<Vec4> normals() const { return std::span(world.normals).subspan(base, model->capacity()); }
    std::span<float> weights() const { return std::span(world.weight).subspan(base, model->capacity()); }

    /// Those of stretch persist between frames, followed by shifts (ClothModel::kept_floats). The others persist
    /// between iterations; with one iteration they are empty.
    std::array<AlignedVector<float>, constraint_kind_count> lambda;
    ColliderLists near_colliders;
    FaceContacts face_contacts;
    ContactAccount account;        ///< empty without contact_forces
    AlignedVector<Vec4> supports;  ///< the arrays of a SupportView; empty without bodies or colliders
    /// Values that particles sum over their triangles: the air's impulse, and at the end of a frame the normals. One
    /// extra element stays zero.
    AlignedVector<Vec4> by_face;
    std::vector<LevelState> levels;                      ///< one per level of the model, if a plan uses them
    AlignedVector<Vec4> wind;                            ///< per triangle; empty without wind
    AlignedVector<Vec4> sheltered;                       ///< AirView::sheltered; empty without wind or colliders
    std::vector<std::vector<std::uint32_t>> sheltering;  ///< per worker: numbers of colliders
    AlignedVector<float> face_mass;                      ///< kg, per triangle; empty until a plan has air
    std::unique_ptr<const JacobiGather> gather;          ///< null until a plan uses averaged Jacobi
    AlignedVector<Vec4> corrections;
    std::vector<float> good_kept;        ///< at the start of the frame; empty if no frame reads those before
    AlignedVector<float> steady_parts;   ///< ParticleView, in this frame; empty if no particle is heavier near its pin
    std::vector<std::uint8_t> steadied;  ///< likewise
    AlignedVector<Vec4> remainder;       ///< ParticleView, zero between substeps; empty if the plan does not keep it
    AlignedVector<Vec4> taut;            ///< TautSum, zero between passes; empty if no plan uses it
    std::vector<AlignedVector<float>> line_scratch;  ///< per worker
    double substep_seconds = 0;                      ///< of the last frame, scales lambda; 0 before the first frame
    std::unique_ptr<Tearing> tearing;                ///< null unless the cloth tears
    Limits limits;                                   ///< in this frame, of tethers and coarse limits

    /// Keeps the particles; anchors may change. `new_base` is their new first index.
    void set_model(std::shared_ptr<const ClothModel> other, std::uint32_t new_base);
    /// Keeps constraints, particles and anchors; changes the material's numbers.
    void set_material(std::shared_ptr<const ClothModel> other);
    /// Other constraints and triangles for the same points: Backend::set_topology().
    void set_topology(std::shared_ptr<const ClothModel> other, std::span<const std::uint32_t> copied);
    void place_points(std::uint32_t first, std::span<const Vec3> places);
    /// Changes only inverse masses.
    void set_weights(std::span<const ParticleWeight> changed);
    ClothSnapshot save() const;
    void restore(const ClothSnapshot& snapshot);

    AlignedVector<float>& kept() { return lambda[static_cast<std::uint32_t>(ConstraintKind::stretch)]; }
    const AlignedVector<float>& kept() const { return lambda[static_cast<std::uint32_t>(ConstraintKind::stretch)]; }
    /// Points from 0 on that a pass goes over: without unused ones in reserve, if no anchors follow them.
    std::uint32_t points_in_use() const;
    RowView rows(ConstraintKind kind);
    /// Whether any of these second halves of stretch constraints is in use (tear_table.h).
    bool uses_halves(std::uint32_t begin, std::uint32_t end) const;
    /// Of the stretch constraints.
    std::span<const LineBlock> blocks() const;
    /// Corners of the triangles, [corner · stride + triangle].
    const std::uint32_t* faces() const;
    SurfaceView surface();
    SupportView support_view();
    void clear_supports(Range particles);
    void clear_taken(Range particles);  ///< what colliders have taken has been added to their pushes
    /// `heavy`: taut edges make the particles heavier.
    LevelView level(std::uint32_t i, bool heavy);
    ParticleView level_particles(std::uint32_t i);
    RowView level_rows(std::uint32_t i);
    /// From level i + 1 to level i.
    ProlongationView prolongation_to_level(std::uint32_t i) const;
    ProlongationView prolongation_to_particles() const;
    AirView air(float density);
    GatherView gather_view(const WorldPlan& plan) const;
    CorrectionView correction(ConstraintKind kind, const WorldPlan& plan, const PlainStiffness& stiffness);
    void remember(std::size_t begin, std::size_t end);  ///< saves these particles as the last good ones
    void remember();                                    ///< all
    void roll_back();
    Bounds bounds() const;  ///< of the particles where they are; leaves out what is not a number
    /// Allocates what the plan needs besides the particles; the passes do not allocate.
    void prepare(const WorldPlan& plan, std::size_t colliders, unsigned workers, bool contact_forces = false,
                 bool bodies = false);
    /// Computes the limits of tethers and coarse levels from the tension that the last frame left in the cloth.
    void begin_frame(const WorldPlan& plan);
    void end_frame(const WorldPlan& plan, double dt);
    void update_normals();

  private:
    void take_thickness();
    void weigh();
    void begin_tearing();
    void find_halves();
    std::vector<std::uint8_t> halves_used_;  ///< per lane_padding second halves: whether any is in use
    ProlongationView prolongation_from(std::uint32_t i) const;
};

}  // namespace weft::cpu
