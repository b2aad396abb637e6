// Arguments of the shaders, one struct per kind of pass, shared by C++ and GLSL. They are pushed as constants with a
// dispatch, or are stored in a buffer where one dispatch runs many commands. No struct is larger than 120 bytes: with
// the two numbers that are pushed after it, it fits into the 128 bytes that every device supports.
#ifndef WEFT_VULKAN_ARGS_H
#define WEFT_VULKAN_ARGS_H

#ifdef __cplusplus
#include <weft/vector.h>

#include <cstdint>

namespace weft::vulkan {

using uint = std::uint32_t;
using vec4 = Vec4;
// Addresses on the device; 0 is none.
using Vec4s = std::uint64_t;
using Floats = std::uint64_t;
using Uints = std::uint64_t;
using FrameRef = std::uint64_t;
using ColliderRef = std::uint64_t;
using CollidersRef = std::uint64_t;
using BodiesRef = std::uint64_t;
using NearTileRef = std::uint64_t;
using PoseRef = std::uint64_t;
using WindRef = std::uint64_t;
using TargetRef = std::uint64_t;
using GrabRef = std::uint64_t;
using LimitsRef = std::uint64_t;
#else
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require

layout(buffer_reference, std430, buffer_reference_align = 16) buffer Vec4s {
    vec4 at[];
};
layout(buffer_reference, std430, buffer_reference_align = 4) buffer Floats {
    float at[];
};
layout(buffer_reference, std430, buffer_reference_align = 4) buffer Uints {
    uint at[];
};
layout(buffer_reference) buffer FrameRef;
layout(buffer_reference) buffer ColliderRef;
layout(buffer_reference) buffer CollidersRef;
layout(buffer_reference) buffer BodiesRef;
layout(buffer_reference) buffer NearTileRef;
layout(buffer_reference) buffer PoseRef;
layout(buffer_reference) buffer WindRef;
layout(buffer_reference) buffer TargetRef;
layout(buffer_reference) buffer GrabRef;
layout(buffer_reference) buffer LimitsRef;
#endif

// --- Inputs of a frame ---

struct FrameIn {
    float h;          // s    length of the substep
    float inv_h;      // 1/s
    float inv_h2;     // 1/s2
    float max_speed;  // m/s
    float gravity_x;  // m/s2
    float gravity_y;
    float gravity_z;
    float viscous;         // s2   retardation time times the length of the frame
    float half_thickness;  // m, of the fabric
    float depenetration;   // m    per substep
    float drag;            // kg/m3
    float lift;
    float sine_lift;
    uint colliders;
    uint winds;
    uint motions;
    float strain_per_lambda;  // rest length times strain over lambda of stretch in the last frame; 0: no lambda yet
    uint again;               // 1: second run of the frame from the same state, because a list was full
    uint substeps;
    float tile_margin;      // m    FrameNumbers
    float static_friction;  // of the cloth alone
    float kinetic_friction;
    float nearest_of_faces;  // m, where the cloth is thickest
    float circle_of_faces;   // m
    float widest_face;       // m
    float surface_motion;    // m: the most that a point of a collider's surface moves in a substep
    uint meets_surfaces;     // 1: the cloth meets the triangles of colliders that have a surface, not their shapes
    float least_half_thickness;  // m, where the cloth is thinnest
    Floats weights;    // 1/kg: inverse masses without taut edges and pins; 0: particles have no others
    Floats thickness;  // factors on half_thickness, by particle; 0: 1 everywhere
};

// Words of a report.
#define WEFT_REPORT_BITS 0
#define WEFT_REPORT_NEAR_SLOTS 1  // slots that the lists of near colliders took in the frame, or had no room for
#define WEFT_REPORT_WORDS 2

struct PoseIn {
    vec4 x;  // columns of the rotation
    vec4 y;
    vec4 z;
    vec4 position;
};

struct WindIn {
    vec4 n0;            // w: gust
    vec4 n1;            // w: gust_turns
    vec4 n2;            // w: gust_per_meter
    vec4 noise_offset;  // w: scattered
    vec4 position;      // w: strength
    vec4 axis_x;        // w: edge along it
    vec4 axis_y;
    vec4 axis_z;
    float s0;
    float s1;
    float s2;
    float per_border;
    float turbulence;
    float noise_per_meter;
    float noise_time;
    uint kind;
    float shelter;  // m
    uint unused0;
    uint unused1;
    uint unused2;
};

struct TargetIn {
    vec4 local;  // m, in the motion's frame of reference
    uint particle;
    uint motion;
    uint body;  // that it follows; 0xffffffff: none
    uint unused;
};

struct GrabIn {
    vec4 from;     // m    target at the start of the frame; w: largest force in N
    vec4 to;       // m    target at its end; w: compliance in m/N
    vec4 weights;  // of the corners; w: damping in s
    uint triangle;
    uint unused0;
    uint unused1;
    uint unused2;
};

// Slack of the one-sided constraints in a frame.
struct LimitsIn {
    float tension;  // N/m
    float allowed;
};

// --- Arguments of a pass ---

// Passes over single particles.
struct ParticleArgs {
    Vec4s position;
    Vec4s start;
    Vec4s velocity;
    Vec4s compensation;
    FrameRef frame;
    Uints report;
    Floats steady_parts;  // of the acceleration by gravity; 0: all of it
    Vec4s remainder;      // what rounding dropped from displacements in this substep, m; 0: not kept
    uint count;
    uint unused;
};

// Particles near pins.
struct SteadyArgs {
    Vec4s position;
    Floats weights;     // 1/kg: inverse masses without pins
    Floats steadiness;  // 1/s2
    Uints pins;         // per particle: the particle that is its pin
    Floats parts;       // ParticleArgs::steady_parts
    FrameRef frame;
    uint count;
    uint unused;
};

struct TargetArgs {
    Vec4s position;
    TargetRef targets;
    PoseRef poses;  // of the motions
    FrameRef frame;
    CollidersRef colliders;
    Vec4s by_face;  // from here on WEFT_TARGETS_PULL only: impulses of the air, and the triangles at each particle; 0: none
    Uints offsets;
    Uints items;
    uint count;
    uint substep;
    uint pass;  // WEFT_TARGETS_…
    uint particles;  // that have triangles
};
#define WEFT_FOLLOWS_NO_BODY 0xffffffffu  // TargetIn::body
#define WEFT_TARGETS_ALL 0u        // places all
#define WEFT_TARGETS_ON_BODIES 1u  // places those on bodies
#define WEFT_TARGETS_WEIGH 2u      // gives those on bodies a mass
#define WEFT_TARGETS_PULL 3u       // takes it back, and adds to the sums of the bodies
#define WEFT_TARGETS_WEIGH_FOR_LEVELS 4u  // as WEFT_TARGETS_WEIGH, with the sign changed

// All grabs of a cloth.
struct GrabArgs {
    Vec4s position;
    Vec4s start;
    Floats weights;  // 1/kg: inverse masses without hands
    Uints faces;     // [corner · stride + triangle]
    GrabRef grabs;
    Vec4s pulls;  // [substep · count + grab]: lambda
    FrameRef frame;
    uint stride;
    uint count;
    uint substep;
    uint first_iteration;
    float per_substep;  // 1 / substeps
    float reach;        // m
};

// Use of lambda, which restarts at 0 in every substep.
#define WEFT_LAMBDA_DISCARD 0
#define WEFT_LAMBDA_STORE 1
#define WEFT_LAMBDA_ACCUMULATE 2

// Distribution of constraints to invocations.
#define WEFT_ROWS_SINGLE 0  // one constraint per invocation
#define WEFT_ROWS_SERIAL 4  // the first invocation solves all, in order
#define WEFT_ROWS_LINES 8   // one line per invocation, in order along it

#define WEFT_LAMBDA_MODES 3u  // bits of RowArgs::modes
#define WEFT_ROWS_MODES 12u

// Constraints of one kind: a batch, or all of them.
struct RowArgs {
    Vec4s position;
    Vec4s moves;        // damp, weigh_taut: velocity; otherwise ParticleArgs::remainder
    Uints particles;    // [slot · stride + row]
    Floats fields;      // [field · stride + row]
    Floats lambda;      // [multiplier · stride + row]; 0 if it is not stored
    Vec4s corrections;  // correct only: [slot · stride + row]; weigh_taut: TautArgs::sums
    Uints sums;         // correct only, in fixed point: four per particle; 0 for floats
    Floats share;       // correct only: [row]; 0 for plain constraints
    Uints blocks;       // lines only: begin and length of each block, with WEFT_CUT_BLOCK
    FrameRef frame;
    LimitsRef limits;
    Floats shifts;         // of coupled constraints: Step::shift_c, then shift_d; 0 for others
    float plain_positive;  // part of C that plain constraints correct while C > 0
    float plain_negative;  // the same while C < 0
    uint stride;
    uint begin;
    uint count;  // constraints; blocks with WEFT_ROWS_LINES
    uint modes;  // WEFT_LAMBDA_… + WEFT_ROWS_…
};

// ConstraintTable::coupled and coupling.
struct CoupleArgs {
    Floats lambda;
    Floats shifts;
    Uints rows;
    Floats numbers;
    FrameRef frame;
    uint stride;
    uint count;
};

struct LineArgs {
    Vec4s position;
    Uints particles;
    Floats fields;
    Floats lambda;
    Uints blocks;
    Vec4s scratch;  // [part · stride + row], two parts
    Vec4s remainder;  // as in ParticleArgs
    FrameRef frame;
    uint stride;
    uint count;  // blocks
    uint lambda_use;
    uint unused;
};

// Masses of taut edges.
struct TautArgs {
    Vec4s position;
    Vec4s start;
    Vec4s sums;  // TautSum, 0 between the passes
    Floats weights;
    uint count;
    uint unused;
};

// Sums of the constraints' corrections.
struct AverageArgs {
    Vec4s position;
    Vec4s corrections;
    Uints sums;  // in fixed point, reset to zero when read; 0 for floats
    Uints offsets;
    Uints items;
    Vec4s remainder;  // as in ParticleArgs
    uint count;
    uint mean;  // 1: divide the sum by the number of terms
};

// A coarse level.
struct LevelArgs {
    Vec4s position;  // of the level's nodes; prolongation: of the particles
    Vec4s origin;
    Vec4s displacement;
    Vec4s finer;    // restriction: positions of the finer level
    Vec4s coarser;  // interpolation and prolongation: displacements of the coarser level; 0 if there is none
    Uints begin;    // restriction: layout of Restriction (solver/model/hierarchy.h)
    Uints nodes;    // likewise; otherwise the parents, [parent · stride + finer node]
    Floats weights;
    Vec4s remainder;  // as in ParticleArgs, of the level's nodes; prolongation: of the particles
    Vec4s particles;  // their positions
    Uints pinned;     // per node: its particle if it is pinned, or WEFT_NOT_PINNED; 0 if none can be attached to a body
    Floats node_weight;      // as in LevelView (cpu/passes.h)
    Floats particle_weight;  // likewise
    uint stride;
    uint count;
    uint heavy;  // likewise
    uint unused;
};
#define WEFT_NOT_PINNED 0xffffffffu

// All constraints of a coarse level with few nodes, sweep by sweep and batch by batch, solved by one workgroup.
struct LevelLimitArgs {
    Vec4s position;  // of the level's nodes
    Vec4s remainder;
    Uints particles;
    Floats fields;
    Floats lambda;
    Uints batches;  // per batch: its first row, then the number of its rows, with WEFT_SERIAL_BATCH if it is serial
    FrameRef frame;
    LimitsRef limits;
    uint stride;
    uint nodes;
    uint batch_count;
    uint sweeps;
    uint lambda_use;  // of the first sweep; the others accumulate
    uint unused;
};

#define WEFT_SERIAL_BATCH 0x80000000u
// In the length of a block of lines: a line may end within it.
#define WEFT_CUT_BLOCK 0x80000000u

// Contact with colliders, and the lists of those near each tile.
struct ContactArgs {
    Vec4s position;
    Vec4s start;
    Vec4s velocity;  // with bodies only
    Vec4s sums;  // [slot · tile + particle in the tile]: ContactSum; 0 with one iteration
    Vec4s contact_log;  // likewise: ContactTrace::moved, then turned; 0 without contact forces
    FrameRef frame;
    CollidersRef colliders;
    NearTileRef tiles;
    Uints slots;  // colliders
    Uints report;
    Uints face_sums;  // FaceContactArgs::sums; 0 without contact of faces
    Vec4s supports;   // [WEFT_SUPPORT_BLOCKS · particle]: normal, offset; rubbed, pushed; carried, collider; friction,
                      // presser; seen, height. 0 without bodies
    uint count;
    uint capacity;  // slots
    uint substep;
    uint first_iteration;
    uint particles;  // those of the points that can have faces; the others are particles in reserve, and anchors
    uint parts;      // WEFT_CONTACT_…
};

// The first pass of contact in a substep. In the first substep of a frame the lists begin with it.
#define WEFT_CONTACT_BEGINS 1u
#define WEFT_SUPPORT_BLOCKS 5u  // of a Support
#define WEFT_CONTACT_BODIES 2u  // the world has bodies
#define WEFT_CONTACT_KEEPS_MARKS 4u  // passes before have marked particles whose faces may touch

// Contact of faces with colliders.
struct FaceContactArgs {
    Vec4s position;
    Vec4s start;
    Uints faces;     // corners in the order of tiles, [corner · stride + face]; the first face of each tile, and the end;
                     // the face of each triangle (FacesByTile)
    Vec4s contacts;  // face_contact.glsl
    Uints sums;      // per particle: pushes by axis, their number or longest, hold, marks; then WEFT_FACE_WORDS and two
                     // lists of particles (face_contact.glsl)
    Vec4s contact_log;  // as in ContactArgs
    Uints offsets;      // triangles around each particle
    Uints items;
    FrameRef frame;
    CollidersRef colliders;
    NearTileRef tiles;
    Uints slots;
    uint stride;
    uint faces_per_tile;
    uint particles;
    uint capacity;  // slots
    uint substep;
    uint sweep;
};

#define WEFT_FACE_CONTACT_BLOCKS 6u  // of four floats per face and slot; with a contact log one more
#define WEFT_FACE_SUM 6u             // words per particle
#define WEFT_NEAR_FACES 1u           // mark: faces of the particle may touch, or contact has moved it
#define WEFT_RETRY_FACES 2u          // mark: a face of the particle touches, or the particle has been held
#define WEFT_LONGEST_EDGE_WORD 3u    // bits of a float, m: WEFT_FACE_WORDS[3]
#define WEFT_FACE_WORDS 5u           // before the lists of held particles
#define WEFT_FACE_SWEEPS 3u  // face_sweeps
#define WEFT_FACE_HOLDS 2u   // face_holds
#define WEFT_MOST_HOLD_ROUNDS 128u  // most_hold_rounds

// Triangles.
struct FaceArgs {
    Vec4s position;
    Vec4s velocity;
    Uints faces;    // [corner · stride + triangle]
    Floats mass;    // kg per triangle
    Vec4s wind;     // m/s per triangle; 0 without wind
    Vec4s by_face;  // results of air, faces and smooth_faces, per triangle
    Vec4s normals;  // smooth_faces only
    FrameRef frame;
    WindRef winds;
    CollidersRef colliders;  // wind only; 0 without colliders
    uint stride;
    uint count;
};

// Sums over the triangles at each particle.
struct AroundArgs {
    Vec4s by_face;
    Uints offsets;
    Uints items;
    Vec4s normals;   // normals only
    Vec4s position;  // from here on push only
    Vec4s start;
    Vec4s velocity;
    Vec4s compensation;
    uint count;
    uint unused;
};

// The state and its last finite copy.
struct KeepArgs {
    Vec4s position;
    Vec4s start;
    Vec4s velocity;
    Vec4s compensation;
    Vec4s good_position;  // w: that of start
    Vec4s good_velocity;
    Vec4s good_compensation;
    Floats weights;  // 1/kg: current inverse masses
    Floats kept;         // ClothModel::kept_floats()
    Floats good_kept;    // 0: a frame does not read those of the frame before
    Vec4s remainder;     // as in ParticleArgs
    Uints report;
    Uints island_report;  // of the island's first cloth: a non-finite number in one cloth rolls all back
    uint count;
    uint kept_count;
    uint first_shift;  // multipliers before it, shifts from it on
    uint unused;
};

struct LimitArgs {
    Vec4s position;
    Uints particles;  // of the stretch constraints
    Floats fields;    // of the same
    Floats lambda;
    Uints span_ends;  // two per span
    Floats span_lengths;
    LimitsRef limits;
    FrameRef frame;
    uint rows;  // with padding
    uint first_dummy;
    uint stride;
    uint spans;
    float softest;  // N/m
    float model_tension;
    float stretched;  // strain per N/m
    float straight_strain;  // solver/plan/tension.h
    float straight;   // N/m: Elasticity::straight
    uint unused0;
    uint unused1;
    uint unused2;
};

#ifdef __cplusplus
}  // namespace weft::vulkan
#else
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer FrameRef {
    FrameIn at;
};
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer PoseRef {
    PoseIn at[];
};
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer WindRef {
    WindIn at[];
};
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer TargetRef {
    TargetIn at[];
};
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer GrabRef {
    GrabIn at[];
};
layout(buffer_reference, std430, buffer_reference_align = 8) buffer LimitsRef {
    LimitsIn at;
};
#endif

#include "vulkan/colliders.data.h"

#endif
