// Arguments and data of contact between particles, shared by C++ and GLSL.
#ifndef WEFT_VULKAN_PARTICLE_CONTACT_ARGS_H
#define WEFT_VULKAN_PARTICLE_CONTACT_ARGS_H

#include "vulkan/seams.data.h"

#define WEFT_PARTICLE_TILE 32   // particles in a tile
#define WEFT_PARTICLE_BLOCK 16  // particles that share friction
#define WEFT_PARTICLE_GROUP 128 // invocations of a workgroup

#ifdef __cplusplus
namespace weft::vulkan {
using SphereDataRef = std::uint64_t;
using SphereTileRef = std::uint64_t;
using SpherePairRef = std::uint64_t;
using SphereHeadRef = std::uint64_t;
using SphereReportsRef = std::uint64_t;
#else
layout(buffer_reference) buffer SphereDataRef;
layout(buffer_reference) buffer SphereTileRef;
layout(buffer_reference) buffer SpherePairRef;
layout(buffer_reference) buffer SphereHeadRef;
layout(buffer_reference) buffer SphereReportsRef;
#endif

struct SphereTileIn {
    uint count;
    uint cloth;
    uint with_alike;  // SearchedParticles
    uint groups;      // CollisionFilter
    uint collides_with;
    float diameter;   // m, of its largest particle
    float margin;     // m
    float less_at_rest;
};

struct SpherePairIn {
    uint one;
    uint two;
    float diameter;  // m
    float depth;     // m, by which the sweeps of the current substep have pushed; negative: the pair does not overlap
};

struct SphereHead {
    uint outdated;  // 1: the lists are to be made in this substep
    uint known;     // 1: they have been made
    uint listed;    // pairs, including those without room
    uint contacts;  // of the substep
    // Of the frame.
    uint searches;
    uint wanted;  // largest number of pairs
};

struct SphereData {
    Vec4s position;  // of the world, by particle
    Vec4s start;
    Vec4s friction;  // by block of particles: square roots of both coefficients
    Uints pushes;    // by particle: number of overlaps
    Uints sums;      // four per particle, in quanta
    Uints particles; // by place in a tile: in the world
    Vec4s rest;      // by place in a tile; w: diameter, m
    Vec4s listed;    // by place in a tile: where the lists were made
    Vec4s boxes;     // two per tile: low and high corner, where the lists were made
    SphereTileRef tiles;
    SpherePairRef pairs;
    SphereHeadRef head;
    FrameRef frame;  // of any of the cloths
    SphereReportsRef reports;
    Uints seam_first;  // by particle of the world; this and the following: see Seams of collide/seams.h
    SeamEntryRef seam_entries;
    uint tile_count;
    uint capacity;  // pairs
    uint report_count;
    float part_at_rest;
    uint search_always;
    uint has_seams;  // 1: there are seams
};

struct ParticleContactArgs {
    SphereDataRef data;
    uint first_of_frame;  // 1: the first substep
    float deep;           // of the sweep: ParticleSweep
    float recovery_speed;
    float split;
};

#ifdef __cplusplus
}  // namespace weft::vulkan
#else
layout(buffer_reference, std430, buffer_reference_align = 16) buffer SphereDataRef {
    SphereData at;
};
layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer SphereTileRef {
    SphereTileIn at[];
};
layout(buffer_reference, std430, buffer_reference_align = 16) buffer SpherePairRef {
    SpherePairIn at[];
};
layout(buffer_reference, std430, buffer_reference_align = 4) buffer SphereHeadRef {
    SphereHead at;
};
layout(buffer_reference, std430, buffer_reference_align = 8) readonly buffer SphereReportsRef {
    uvec2 at[];  // Uints
};
#endif

#endif
