// The world's colliders on the device, and the lists of those near each tile of particles, shared by C++ and GLSL.
#ifndef WEFT_VULKAN_COLLIDERS_DATA_H
#define WEFT_VULKAN_COLLIDERS_DATA_H

#include "vulkan/args.data.h"

#define WEFT_COLLIDER_TILE 16  // particles in a tile: lane_padding
#define WEFT_TILE_SLACK 0.25   // tile_slack_per_way
#define WEFT_ROOM_TO_STRETCH 1.5  // room_to_stretch
#define WEFT_NO_COLLIDER 0xffffffffu

#define WEFT_COLLIDER_STICKS 1u   // cloth sticks to it
#define WEFT_COLLIDER_SURFACE 2u  // Collider::surface
#define WEFT_COLLIDER_BODY 4u     // its poses are those of a body

#ifdef __cplusplus
namespace weft::vulkan {
using AddressWords = std::uint64_t;
#else
#define AddressWords uvec2  // shaders copy ColliderIn, and some drivers cannot compile copies of references
#endif

struct ColliderIn {
    vec4 numbers;
    float static_friction;  // of the collider alone
    float kinetic_friction;
    uint shape;
    uint flags;             // WEFT_COLLIDER_…
    float adhesion_distance;    // m
    float adhesion_compliance;  // m/N
    AddressWords data;          // of the shape; 0 if its numbers say everything
    uint first_pose;  // in CollidersIn::poses: the pose after n substeps is number first_pose + n · pose_step
    uint pose_step;   // 0: the collider rests in this frame
    float steepness;  // swept.kernel.h
    float roundness;  // m
    float width;  // m, swept.kernel.h
    uint body;             // its number
    uint unused0;
    uint unused1;
};

struct CollidersIn {
    ColliderRef colliders;
    PoseRef poses;
    // A bounding volume hierarchy in depth-first order, two per node. Low corner, and as bits the node at which a search
    // goes on that has finished or rejected this one. High corner, and as bits the collider in the node's box, or
    // 0xffffffff for an inner node. Boxes contain a collider's way in the frame; those that no box contains come last.
    Vec4s nodes;       // without bodies
    BodiesRef bodies;  // 0: none
    uint node_count;
    uint unused;
};

// The list of a tile: the colliders of slots [first, first + count), by ascending number.
struct NearTileIn {
    vec4 low;  // m: box in which the tile's particles are expected to stay during the frame; by how much it is larger
               // because edges are long
    vec4 high;
    uint first;
    uint count;
    uint reach_serial;  // BodiesIn::reach_serial of the list
    uint unused;
};

#ifdef __cplusplus
}  // namespace weft::vulkan
#else
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer ColliderRef {
    ColliderIn at[];
};
layout(buffer_reference, std430, buffer_reference_align = 8) buffer CollidersRef {
    CollidersIn at;
};
layout(buffer_reference, std430, buffer_reference_align = 16) buffer NearTileRef {
    NearTileIn at[];
};
#endif

#include "vulkan/bodies/bodies.data.h"

#endif
