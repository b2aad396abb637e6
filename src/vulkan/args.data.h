// What shaders are told, one struct per kind of pass, read by C++ and by GLSL: the same bytes are pushed as constants
// with a dispatch, or lie in memory where one dispatch runs many commands. None is larger than 120 bytes: with the two
// numbers that are pushed behind it, every device has room for it.
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
using PoseRef = std::uint64_t;
using WindRef = std::uint64_t;
using HeldRef = std::uint64_t;
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
layout(buffer_reference) buffer PoseRef;
layout(buffer_reference) buffer WindRef;
layout(buffer_reference) buffer HeldRef;
layout(buffer_reference) buffer LimitsRef;
#endif

// --- What a frame brings ---

struct FrameIn {
    float h;          // s    length of the substep
    float inv_h;      // 1/s
    float inv_h2;     // 1/s2
    float max_speed;  // m/s
    float gravity_x;  // m/s2
    float gravity_y;
    float gravity_z;
    float viscous;         // s2   retardation time times the frame that damping acts for
    float half_thickness;  // m
    float depenetration;   // m    of a substep
    float drag;            // kg/m3
    float lift;
    float listing;
    uint colliders;
    uint winds;
    uint movers;
    float strain_per_lambda;  // 1/m  times the rest length, of the last frame's lambda of stretch; 0: there is none
    uint again;               // 1: the frame has been run before, from the same state, and a list was full
    uint unused1;
    uint unused2;
};

struct ColliderIn {
    vec4 numbers;
    float static_friction;  // of the pair
    float kinetic_friction;
    uint shape;
    uint sticks;  // 1: cloth sticks to it
    float adhesion_distance;    // m
    float adhesion_compliance;  // m/N
    uint unused0;
    uint unused1;
};

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
    float turbulence;
    float noise_per_meter;
    float noise_time;
    uint kind;
};

struct HeldIn {
    vec4 local;  // m, in the mover's frame
    uint particle;
    uint mover;
    uint unused0;
    uint unused1;
};

// What one-sided rows allow for in a frame.
struct LimitsIn {
    float tension;  // N/m
    float allowed;
};

// --- What a pass works on ---

// Particles one by one.
struct ParticleArgs {
    Vec4s position;
    Vec4s start;
    Vec4s velocity;
    Vec4s carry;
    FrameRef frame;
    Uints report;
    uint count;
    uint unused;
};

struct HoldArgs {
    Vec4s position;
    HeldRef held;
    PoseRef poses;  // of the movers
    FrameRef frame;
    uint count;
    uint substep;
};

// What becomes of lambda, which restarts at 0 in every substep.
#define WEFT_LAMBDA_DISCARD 0
#define WEFT_LAMBDA_STORE 1
#define WEFT_LAMBDA_ACCUMULATE 2

// How rows are handed out.
#define WEFT_ROWS_SINGLE 0  // one to an invocation
#define WEFT_ROWS_SERIAL 1  // all to the first, in order
#define WEFT_ROWS_LINES 2   // line by line, in order along each

// Rows of one kind: a batch, or all of them.
struct RowArgs {
    Vec4s position;
    Vec4s velocity;     // of damp
    Uints particles;    // [slot · stride + row]
    Floats fields;      // [field · stride + row]
    Floats lambda;      // [multiplier · stride + row]; 0 where nobody keeps it
    Vec4s corrections;  // of correct: [slot · stride + row]
    Uints sums;         // of correct, in fixed point: four per particle; 0 for floats
    Floats share;       // of correct: [row]; 0 for plain constraints
    Uints blocks;       // of lines: begin and length of each block
    FrameRef frame;
    LimitsRef limits;
    float plain_positive;  // part that plain constraints undo while C > 0
    float plain_negative;
    uint stride;
    uint begin;
    uint count;  // rows; of lines, blocks
    uint lambda_use;
    uint hand_out;
    uint unused;
};

struct LineArgs {
    Vec4s position;
    Uints particles;
    Floats fields;
    Floats lambda;
    Uints blocks;
    Vec4s scratch;  // [part · stride + row]: two
    FrameRef frame;
    uint stride;
    uint count;  // blocks
    uint lambda_use;
    uint unused;
};

// Sums of what rows want.
struct AverageArgs {
    Vec4s position;
    Vec4s corrections;
    Uints sums;  // in fixed point, zero again when read; 0 for floats
    Uints offsets;
    Uints items;
    uint count;
    uint mean;  // 1: the sum divided by its terms
};

// A coarse level.
struct LevelArgs {
    Vec4s position;  // of the level's nodes, or of particles that are spread to
    Vec4s origin;
    Vec4s displacement;
    Vec4s finer;    // collect: where the finer ones are
    Vec4s coarser;  // lift and spread: displacements of the coarser level; 0 if there is none
    Uints begin;    // collect: as Restriction has it
    Uints nodes;    // likewise; or the parents, [parent · stride + finer node]
    Floats weights;
    uint stride;
    uint count;
};

struct ContactArgs {
    Vec4s position;
    Vec4s start;
    Vec4s sums;  // [collider · capacity + particle]; 0 with one iteration
    Vec4s felt;  // [collider · capacity + particle]: moved of ContactTrace, and then turned; 0 without feedback
    FrameRef frame;
    ColliderRef colliders;
    PoseRef poses;  // [substep · colliders + collider]
    uint count;
    uint capacity;
    uint substep;
    uint first_iteration;
};

// Triangles.
struct FaceArgs {
    Vec4s position;
    Vec4s velocity;
    Uints faces;    // [corner · stride + triangle]
    Floats mass;    // kg per triangle
    Vec4s wind;     // m/s per triangle; 0 where the air stands still
    Vec4s by_face;  // what air and faces find, per triangle
    FrameRef frame;
    WindRef winds;
    uint stride;
    uint count;
};

// Sums over the triangles at each particle.
struct AroundArgs {
    Vec4s by_face;
    Uints offsets;
    Uints items;
    Vec4s normals;   // of normals
    Vec4s position;  // of push, from here on
    Vec4s start;
    Vec4s velocity;
    Vec4s carry;
    uint count;
    uint unused;
};

// The state and its last good copy.
struct KeepArgs {
    Vec4s position;
    Vec4s start;
    Vec4s velocity;
    Vec4s carry;
    Vec4s good_position;  // w: of start
    Vec4s good_velocity;
    Vec4s good_carry;
    Floats weights;  // 1/kg: inverse masses as they are
    Floats lambda;   // of stretch
    Uints report;
    Uints island_report;  // of the first cloth of the island: what is not finite in one takes all back
    uint count;
    uint lambdas;
};

struct LimitArgs {
    Vec4s position;
    Uints particles;  // of the rows of stretch
    Floats rest;
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
    uint unused;
};

#ifdef __cplusplus
}  // namespace weft::vulkan
#else
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer FrameRef {
    FrameIn at;
};
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer ColliderRef {
    ColliderIn at[];
};
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer PoseRef {
    PoseIn at[];
};
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer WindRef {
    WindIn at[];
};
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer HeldRef {
    HeldIn at[];
};
layout(buffer_reference, std430, buffer_reference_align = 8) buffer LimitsRef {
    LimitsIn at;
};
#endif

#endif
