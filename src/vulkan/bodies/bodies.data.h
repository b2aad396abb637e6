// Rigid bodies on the device, shared by C++ and GLSL. One workgroup moves all of them.
#ifndef WEFT_VULKAN_BODIES_DATA_H
#define WEFT_VULKAN_BODIES_DATA_H

#include "vulkan/args.data.h"

#define WEFT_MOST_BODIES 256
#define WEFT_BODY_GROUP 128  // invocations of the workgroup

// Words of the sums of a body: low and high word of each axis of impulse, then of twist; then the number of contacts.
#define WEFT_BODY_SUM_WORDS 16
#define WEFT_BODY_SUM_TOUCHES 12

// Poses of a body in BodiesIn::poses.
#define WEFT_BODY_POSES 4
#define WEFT_BODY_BEFORE 0  // at the start of the substep
#define WEFT_BODY_NOW 1
#define WEFT_BODY_FOUND 2   // when contacts of faces were found
#define WEFT_BODY_PLACED 3  // when attached points were placed

// Passes over bodies.
#define WEFT_BODIES_BEGIN 0    // of a frame
#define WEFT_BODIES_PREDICT 1
#define WEFT_BODIES_COUNT 2
#define WEFT_BODIES_MOVE 3
#define WEFT_BODIES_FINISH 4   // a substep

#ifdef __cplusplus
namespace weft::vulkan {
using BodyRef = std::uint64_t;
using BodyRowRef = std::uint64_t;
using FeaturesRef = std::uint64_t;
using BodyReportsRef = std::uint64_t;
#else
layout(buffer_reference) buffer BodyRef;
layout(buffer_reference) buffer BodyRowRef;
layout(buffer_reference) buffer FeaturesRef;
layout(buffer_reference) buffer BodyReportsRef;
#endif

struct BodyIn {
    vec4 place;  // BodyState
    vec4 turn;
    vec4 velocity;
    vec4 spin;
    vec4 v_dropped;
    vec4 x_dropped;
    vec4 moments;           // w: 1/kg, inverse mass
    vec4 products;          // w: m, radius around the center of mass
    vec4 inverse_moments;   // w: factor on the velocity in a substep
    vec4 inverse_products;  // w: factor on the spin
    vec4 center;            // m, of mass, in the body's frame; w: restitution
    vec4 v;                 // m/s at the start of the substep; w: contacts that share the body
    vec4 rate;              // rad/s likewise
    vec4 ix;                // columns of the inverse tensor of inertia, world axes
    vec4 iy;
    vec4 iz;
    vec4 reach_low;  // m: where it is expected in the rest of the frame; empty: nowhere yet
    vec4 reach_high;
    uint collider;
    uint feels_cloth;
    uint attached;  // points of cloth that are attached to it
    uint unused;
};

// The features of a collider: parts of BodiesIn::points, edges and faces.
struct FeaturesIn {
    uint first_point;
    uint points;
    uint first_edge;
    uint edges;
    uint first_face;
    uint faces;
    float roundness;  // m, of the faces
    int kind;         // WEFT_FEATURES_…
};

// BodyTouch, and what it is between.
struct BodyRowIn {
    uint a;       // colliders
    uint b;
    uint body_a;  // bodies, or 0xffffffff
    uint body_b;
    uint place;   // number of the place on the features where it may touch
    uint unused[3];
    vec4 local_a;   // w: radius
    vec4 local_b;   // w: gap at the start
    vec4 normal;    // w: approach
    vec4 friction;  // w: push
    vec4 numbers;   // static and kinetic friction, restitution, what bounces have taken
};

struct BodiesIn {
    BodyRef bodies;
    Uints sums;
    PoseRef poses;         // by body: WEFT_BODY_POSES
    FeaturesRef features;  // by collider
    Vec4s points;          // place and radius
    Vec4s edges;           // two blocks each: an end and its radius
    Vec4s faces;           // normal and offset
    Uints pairs;           // two words each: the colliders of features and shape
    Floats margins;        // by pair: body_margin()
    Uints facing;          // by pair: face_toward() of a near one
    Uints tasks;           // by pair: number of places on features, of the near pairs before it, where one may touch
    BodyRowRef rows;    // room for those of two substeps
    Uints order;        // rows, level by level; those of a level share no body
    Uints levels;       // where each level begins in `order`, and the end
    BodyReportsRef reports;  // of all cloths
    uint count;
    uint report_count;
    uint pair_room;  // a power of two
    uint row_room;
    float h;
    float inv_h;
    float inv_h2;
    float depenetration;  // m
    float gravity_x;      // m/s2
    float gravity_y;
    float gravity_z;
    uint substeps;
    // From here on the device writes.
    uint reach_serial;  // changes when a body has left its box, so that lists of near colliders may lack it
    uint pair_count;
    uint first_row;  // of the substep
    uint row_count;
    uint level_count;
    uint wanted_pairs;  // the most in the frame
    uint wanted_rows;
    uint not_finite;
};

// WEFT_BODY_… of the pass; sweeps of WEFT_BODIES_MOVE and WEFT_BODIES_FINISH over contacts of bodies.
struct BodiesArgs {
    CollidersRef colliders;
    uint pass;
    uint substep;
    uint sweeps;
    uint places;  // of WEFT_BODIES_MOVE: 1 if attached points are placed after it
};

#ifdef __cplusplus
}  // namespace weft::vulkan
#else
layout(buffer_reference, std430, buffer_reference_align = 16) buffer BodyRef {
    BodyIn at[];
};
layout(buffer_reference, std430, buffer_reference_align = 16) buffer BodyRowRef {
    BodyRowIn at[];
};
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer FeaturesRef {
    FeaturesIn at[];
};
layout(buffer_reference, std430, buffer_reference_align = 8) readonly buffer BodyReportsRef {
    uvec2 at[];
};
layout(buffer_reference, std430, buffer_reference_align = 8) buffer BodiesRef {
    BodiesIn at;
};
#endif

#endif
