// The inner loops of the CPU backend, one table per instruction set.
#pragma once

#include "base/transform.h"
#include "physics/constraint.h"
#include "solver/model/constraint_table.h"
#include "solver/model/faces_around.h"
#include "solver/model/hierarchy.h"
#include "solver/plan/world_plan.h"
#include "solver/world/air.h"
#include "solver/world/collider.h"

#include <weft/bounds.h>

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace weft::cpu {

/// A contiguous range of particles, constraints or triangles. With SIMD both ends are multiples of lane_padding.
struct Range {
    std::uint32_t begin, end;
};

/// State of a cloth: blocks of four floats, one per particle. The fourth floats hold, in this order, the inverse mass
/// and the x, y and z of the velocity's compensation (integrate.kernel.h).
struct ParticleView {
    float* position;
    float* start;  ///< position at the start of the substep
    float* velocity;
    float* compensation;                     ///< rounding error of the position (compensated summation)
    const float* steady_parts = nullptr;     ///< per particle, of the acceleration by gravity; null: all of it
    const std::uint8_t* steadied = nullptr;  ///< per lane_padding particles: whether it is not 1 for all of them
    /// What rounding has dropped from corrections of the position in this substep, m; zero at its start. Null: not
    /// kept.
    float* remainder = nullptr;
};

/// How far one-sided limits give way in a frame; see Step.
struct Limits {
    float tension = 0;  ///< N/m
    float allowed = 1;
};

struct RowView {
    std::uint32_t stride;
    const std::uint32_t* particles;  ///< [slot · stride + row]
    const float* fields;             ///< [field · stride + row]
    float* lambda;                   ///< [multiplier · stride + row]
    Limits limits = {};
    float* shifts = nullptr;  ///< of coupled constraints: Step::shift_c, then shift_d
};

/// ConstraintTable::coupled and coupling.
struct CouplingView {
    const std::uint32_t* rows;
    const float* numbers;
};

/// What lies behind each particle that bodies may press on a collider: a Support, as arrays of blocks of four.
struct SupportView {
    float* plane = nullptr;     ///< normal, offset; nullptr without bodies or colliders
    float* taken = nullptr;     ///< displacement by friction, along the normal
    float* carried = nullptr;   ///< by the collider; its number
    float* friction = nullptr;  ///< of the pair, presser
    float* seen = nullptr;      ///< and height
};

inline constexpr std::size_t support_arrays = 5;

/// How thick a cloth is.
struct ThicknessView {
    float half;                      ///< m, of the fabric
    const float* factors = nullptr;  ///< on it, by particle of the cloth; nullptr: 1 everywhere
};

struct ContactView {
    int kind;                           ///< of the shape
    std::array<float, 4> numbers;       ///< of the shape
    ShapeBlocks data;                   ///< of the shape
    float steepness, roundness, width;  ///< of the shape (swept.kernel.h)
    Pose now, before;                   ///< at the end and at the start of the substep
    float static_friction, kinetic_friction;
    ThicknessView thickness;
    float depenetration;          ///< m
    Vec3 fall = {};               ///< m/s: what gravity adds to the velocity in a substep
    float h = 0;                  ///< s
    float* sums = nullptr;        ///< a ContactSum per particle of the range; nullptr with a single iteration
    bool first_iteration = true;  ///< of the substep: sums begin anew
    float* moved = nullptr;       ///< ContactTrace, blocks of four per particle of the range; contact_traced only
    float* turned = nullptr;      ///< likewise
    const float* free = nullptr;  ///< 1/kg, by particle of the cloth: inverse masses if particles may weigh more now
    /// Set for the particles of the range whose faces may touch, or that contact moves; nullptr if no face is to touch.
    std::uint8_t* near_faces = nullptr;
    float nearest = 0, widest = 0;  ///< m: nearest_of_faces() where the cloth is thickest, the longest edge
    SupportView support = {};       ///< contact with bodies, and with the colliders that support
    float number = 0;               ///< of the collider
};

/// Pushes of cloth on a body, in the quanta of contact_forces.kernel.h: sums wrap around.
struct BodySums {
    std::array<std::uint64_t, 3> impulse{}, twist{};
    std::uint32_t touches = 0;  ///< particles that push it
};

/// A body that gives way to cloth, in a sweep.
struct BodyView {
    float contacts;        ///< that share it
    float inverse_mass;    ///< 1/kg
    Vec3 center;           ///< m, of mass
    Mat3 inverse_inertia;  ///< in world axes
    float inv_h;           ///< 1/s
    BodySums* sums;
    bool moved;  ///< it takes part of the way; otherwise `sums` only counts
};

/// A ball that holds a collider, and how the collider moves in a substep. What contact with the collider would find is
/// near the ball.
struct MovingBall {
    Vec3 center;      ///< m, at the end of the substep
    float radius;     ///< m; may be infinite
    Vec3 way;         ///< m, of the center
    float turn;       ///< m: how far the rotation moves what was at 1 m from the center at the start
    float steepness;  ///< of the shape
    float widest;     ///< ContactView::widest
};

/// Bodies that may be near a range of particles.
struct NearBalls {
    const MovingBall* balls;                 ///< by body
    float half_thickness, nearest;           ///< m: nearest_of_faces() of it; where the cloth is thickest
    const std::uint32_t* numbers = nullptr;  ///< of the bodies; `none`: not a body
    const std::uint8_t* always = nullptr;    ///< in the order of `numbers`: whether it counts as near; null: none does
    std::uint32_t count = 0;
    float inside = 0;    ///< m: how far a support may push a particle toward the body
    bool faces = false;  ///< whether what may touch the faces of particles counts as near
};

/// Triangles in the order of FacesByTile, and what decides about their contact with a collider.
struct FaceView {
    const std::uint32_t* corners;  ///< [corner · stride + triangle]
    std::uint32_t stride;
    const std::uint32_t* items;  ///< numbers of the triangles to look at; room for lane_padding more
    std::uint32_t count;
    /// If set, contacts are not appended: the corners of faces that have passed are held at a part of their way.
    void (*hold)(const FaceView&, std::uint32_t particle, std::uint32_t part) = nullptr;
    void* holds = nullptr;
    /// Per particle: set to 1 for the corners of faces that touch. Needed unless `hold` is set.
    std::uint8_t* retry = nullptr;
    bool of_moved_body = false;  ///< whether cloth moves the collider
};

/// Where triangles are and how they move, per item of a FaceView.
struct FaceMeasures {
    float* numbers;  ///< [k · stride + item], m: x, y, z of the middle; radius around it; x, y, z of the middle's way;
                     ///< the most that a corner's way differs from it
    std::size_t stride;
};
inline constexpr std::size_t numbers_per_face = 8;

/// Contacts of faces with colliders: blocks of four floats per contact (FaceRow in face.kernel.h). Arrays must have
/// room for all that are appended, and lane_padding more.
struct FaceRows {
    std::size_t count = 0;
    bool any_fast = false;     ///< whether faces may pass a collider after the pushes
    float* weights = nullptr;  ///< of the first two corners; static and kinetic friction
    float* plane = nullptr;    ///< normal, offset
    float* start = nullptr;    ///< the point at the start; its gap there
    float* gaps = nullptr;     ///< of the corners at the start
    float* sum = nullptr;      ///< ContactSum
    /// By the sweep before, m: displacement per inverse mass and weight; of the last sweep, by corner, along the
    /// normal. The fourth float is 1 if the face touches on its way.
    float* displacement = nullptr;
    float* lever = nullptr;  ///< FaceRow::lever, world axes, m
    std::array<std::uint32_t*, 3> corners{};
};

/// Sums over the contacts of a particle's faces.
struct FaceSums {
    void* sums;
    /// Adds a push of a contact and its length to the sums of a particle, in quanta (cloth_contact.kernel.h).
    void (*add)(const FaceSums&, std::uint32_t particle, const std::int32_t* quanta);
};

/// Where constraints in parallel projection write the corrections of their particles.
struct CorrectionView {
    float* blocks;                     ///< of four, [slot · stride + row]
    const float* share;                ///< [row]; nullptr for plain constraints, whose sum is averaged by particle
    std::array<float, 2> stiffness{};  ///< plain constraints only
};

/// Lists the corrections of each particle.
struct GatherView {
    const float* blocks;
    const std::uint32_t* offsets;
    const std::uint32_t* items;
    bool mean;   ///< the sum divided by its terms; otherwise the sum
    bool fixed;  ///< in fixed point (accumulate.kernel.h)
};

/// One coarse level. Blocks of four floats per node.
struct LevelView {
    float* position;                     ///< w: inverse mass
    float* origin;                       ///< weighted mean of the finer positions it represents; w: see `heavy`
    float* displacement;                 ///< correction by this level and the coarser ones
    float* remainder;                    ///< as in ParticleView
    const std::uint32_t *begin, *finer;  ///< as Restriction has them: begin and node
    const float* weight;                 ///< likewise
    const float* node_weight;            ///< 1/kg, without what taut edges add to the particles
    const float* particle_weight;        ///< likewise, of the particles, if `heavy`; nullptr on coarser levels
    bool heavy;                          ///< taut edges add masses; w of an origin is the node's mass_ratio()
};

/// From a level's displacements to nodes of the finer one, or to particles.
struct ProlongationView {
    const float* displacement;  ///< of the coarser level; nullptr if there is none
    std::uint32_t stride;
    const std::uint16_t* narrow;  ///< as in Prolongation: one of the two is nullptr
    const std::uint32_t* wide;
    const float* weight;
};

/// Triangles at each particle.
struct AroundView {
    const std::uint32_t* begin;  ///< all members as in FacesAround
    const std::uint32_t* triangles;
    const std::uint32_t *own, *offsets, *items;
};

inline AroundView view_of(const FacesAround& around) {
    return {around.begin.data(), around.triangles.data(), around.own.data(), around.offsets.data(),
            around.items.data()};
}

struct AirView {
    const float* position;
    const float* velocity;
    const std::uint32_t* faces;  ///< [corner · stride + triangle]
    std::uint32_t stride;
    const float* mass;  ///< kg per triangle
    float* wind;        ///< blocks of four per triangle, m/s; nullptr without wind
    float* sheltered;   ///< of one wind that colliders can stop: blocks of four, the last 0 in shelter; or nullptr
    float* impulse;     ///< blocks of four per triangle, kg·m/s: a corner's third; then one of zeros
    float drag, lift;   ///< ½ρC, kg/m³
    bool sine_lift;
    AroundView around;
};

/// N·s: what the air gives to a particle in the substep.
Vec3 impulse_of_air(const AirView& air, std::uint32_t particle);

struct SurfaceView {
    const float* position;
    const std::uint32_t* faces;  ///< [corner · stride + triangle]
    std::uint32_t stride;
    float* face_normals;  ///< blocks of four, then one of zeros
    AroundView around;
    float* normals;  ///< blocks of four
};

/// What decides which triangles of a cloth that tears are watched (tearing.h).
struct TearView {
    const float* position;
    const std::uint32_t* faces;  ///< [corner · stride + triangle]
    std::uint32_t stride;
    const float* sides;      ///< as in TearLaw
    const float* couplings;  ///< likewise; nullptr if it has none
    const float* limits;     ///< TearLaw::watch
    std::uint16_t* hot;      ///< per lane_padding triangles: a bit for each
};

/// In the arrays by constraint kind, an entry is nullptr if no plan uses it (physics/constraint_parts.h).
struct Passes {
    std::string_view isa;
    int lanes;
    /// Returns whether the speed cap acted.
    bool (*predict)(const ParticleView&, Range, Vec3 gravity, float max_speed, float h);
    bool (*velocities)(const ParticleView&, Range, float max_speed, float h);
    /// velocities, then predict, in one pass over the particles.
    bool (*advance)(const ParticleView&, Range, Vec3 gravity, float max_speed, float h);
    /// No two constraints of the range may share a particle that one of them moves, except on one lane, which processes
    /// them one after another.
    std::array<void (*)(const ParticleView&, const RowView&, Range, float h, LambdaUse), constraint_kind_count> project;
    /// Plain position-based dynamics: applies a part, `stiffness`, of the rigid correction.
    std::array<void (*)(const ParticleView&, const RowView&, Range, std::array<float, 2> stiffness),
               constraint_kind_count>
        project_plain;
    /// Solves stretch constraints line by line. `scratch`: line_scratch_floats(…) of the longest block, aligned to 64
    /// bytes.
    void (*lines)(const ParticleView&, const RowView&, std::span<const LineBlock>, float h, LambdaUse, float* scratch);
    std::array<void (*)(const ParticleView&, const RowView&, const CorrectionView&, Range, float h, LambdaUse),
               constraint_kind_count>
        correct;
    void (*average)(const ParticleView&, const GatherView&, Range);
    /// `finer`: particle positions, or origins of the finer level.
    void (*restriction)(const float* finer, const LevelView&, Range);
    void (*interpolation)(const LevelView&, const ProlongationView&, Range);
    void (*node_correction)(const LevelView&, Range);
    void (*prolongation)(const ParticleView&, const ProlongationView&, Range);
    /// `viscous`: retardation time times time step, s².
    std::array<void (*)(const ParticleView&, const RowView&, Range, float viscous), constraint_kind_count> damp;
    /// Adds the masses of taut edges to the sums of their ends: blocks of TautSum, by particle.
    void (*couple)(const RowView&, const CouplingView&, Range, float h);
    void (*weigh_taut)(const ParticleView&, const RowView&, Range, float h, float* taut);
    /// Adds these sums to the masses, and clears them.
    void (*take_taut)(const ParticleView&, float* taut, Range);
    /// Boxes of tiles of lane_padding particles, the first of which begins the range: the first tile from `first` on
    /// that has a particle with a mass outside of its box; the number of tiles if there is none.
    std::uint32_t (*first_outside)(const float* position, std::span<const Bounds> boxes, Range, std::uint32_t first);
    std::array<void (*)(const ParticleView&, const ContactView&, Range), shape_kind_count> contact;
    /// Also adds the displacements of particles to the log.
    std::array<void (*)(const ParticleView&, const ContactView&, Range), shape_kind_count> contact_traced;
    /// Counts the particles that touch a body.
    std::array<void (*)(const ParticleView&, const ContactView&, const BodyView&, Range), shape_kind_count>
        count_touches;
    /// The first of the bodies from `first` on that may touch a particle of the range or a triangle of it; the number
    /// of bodies if there is none.
    std::uint32_t (*first_near)(const ParticleView&, const NearBalls&, Range, std::uint32_t first);
    /// Lets the collider support the particles that touch it.
    std::array<void (*)(const ParticleView&, const ContactView&, Range), shape_kind_count> find_support;
    /// Like `contact`, but the body takes its share: adds to its sums.
    std::array<void (*)(const ParticleView&, const ContactView&, const BodyView&, Range), shape_kind_count> touch_body;
    /// m, of the triangles [begin, end), at the start and at the end of the substep.
    float (*longest_edge)(const ParticleView&, const FaceView&, std::uint32_t begin, std::uint32_t end);
    void (*measure_faces)(const ParticleView&, const FaceView&, const FaceMeasures&);
    /// Writes those of the items that may touch the collider in the ball. `nearest`: m, nearest_of_faces() where the
    /// cloth is thickest. `to` has room for lane_padding more than all.
    /// Returns how many.
    std::uint32_t (*near_faces)(const FaceView&, const FaceMeasures&, const MovingBall&, float nearest,
                                std::uint32_t* to);
    /// Appends the contacts of triangles with a collider.
    std::array<void (*)(const ParticleView&, const ContactView&, const FaceView&, FaceRows&), shape_kind_count>
        find_faces;
    /// Adds the pushes of all contacts from `begin` to `end` to the particles' sums. `last`: of the sweep that keeps
    /// faces from passing.
    void (*push_faces)(const ParticleView&, const FaceRows&, std::size_t begin, std::size_t end, bool last,
                       float depenetration, const ThicknessView&, const FaceSums&);
    /// Likewise, but each body takes its share; those from `begin` to `end`, which are contacts of one body.
    void (*push_faces_of_body)(const ParticleView&, const FaceRows&, std::size_t begin, std::size_t end,
                               float depenetration, const BodyView&, const Pose& found, const Pose& now,
                               const FaceSums&);
    /// Adds to the wind of each triangle, or sets it; with AirView::sheltered, sets that. One entry per kind of wind.
    std::array<void (*)(const AirView&, const WindNow&, bool first, Range), wind_kind_count> wind;
    /// Marks triangles that have the collider within `reach` m against AirView::sheltered.
    void (*shelter)(const AirView&, const ContactView&, float reach, Range);
    /// Adds AirView::sheltered to the wind of each triangle, or sets it.
    void (*add_sheltered)(const AirView&, bool first, Range);
    void (*air)(const AirView&, Range, float h);
    void (*push)(const ParticleView&, const AirView&, Range);
    /// Marks triangles whose tension or strain is above this part of its limit.
    void (*watch_tears)(const TearView&, float part, Range);
    void (*faces)(const SurfaceView&, Range);
    /// Replaces the normals of triangles by the smoothed ones.
    void (*smooth_faces)(const SurfaceView&, Range);
    void (*normals)(const SurfaceView&, Range);
    /// Whether every float in [begin, end) is finite; both multiples of lane_padding.
    bool (*all_finite)(const float*, std::size_t begin, std::size_t end);
};

/// Size of the values that elimination stores for back substitution, per constraint and per block.
inline constexpr std::size_t line_scratch_fields = 13;
constexpr std::size_t line_scratch_floats(std::uint32_t block_length) {
    return line_scratch_fields * lane_padding * block_length;
}

/// Sums over each particle's list of triangles or constraints, one particle at a time.
void normals_pass(const SurfaceView&, Range);
void push_pass(const ParticleView&, const AirView&, Range);
void average_pass(const ParticleView&, const GatherView&, Range);

/// One lane, on any machine.
const Passes& scalar_passes();
/// All tables that this machine can run, the widest first; the last is scalar_passes().
std::span<const Passes* const> available_passes();
/// Returns nullptr if this machine lacks the instruction set.
const Passes* find_passes(std::string_view isa);

}  // namespace weft::cpu
