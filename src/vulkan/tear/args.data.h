// Arguments and data of tearing, shared by C++ and GLSL. TearTable and TearLaw explain the arrays.
#ifndef WEFT_VULKAN_TEAR_ARGS_H
#define WEFT_VULKAN_TEAR_ARGS_H

#include "vulkan/args.data.h"

#define WEFT_TEAR_GROUP 128    // the most invocations of a workgroup
#define WEFT_TEAR_KINDS 6      // of constraints: stretch, bend, plate, distance_bend, moment, membrane
#define WEFT_TEAR_ROW_BITS 28  // of the row in an element of row_items; the kind is above

#ifdef __cplusplus
namespace weft::vulkan {
using TearDataRef = std::uint64_t;
using TearKindRef = std::uint64_t;
using TearHeadRef = std::uint64_t;
#else
layout(buffer_reference) buffer TearDataRef;
layout(buffer_reference) buffer TearKindRef;
layout(buffer_reference) buffer TearHeadRef;
#endif

struct TearKindIn {
    Uints particles;  // [slot · stride + row]
    Floats fields;    // [field · stride + row]
    Uints corners;    // [slot · stride + row]
    Uints tie_begin;  // [row]
    Uints ties;       // two corners each
    uint stride;
    uint arity;
    uint field_count;
    uint first_dummy;
};

struct TearHead {
    uint particles;   // of the cloth, copies included
    uint openings;    // of the frame
    uint candidates;  // particles above their limit in this substep
    uint unused;
};

struct TearOpeningIn {
    uint links[2];
    float strayed[2];  // m
};

struct TearData {
    Uints ring;          // per vertex, and one more: its first entry
    Uints entries;       // six per entry: vertex, corner, next, far, next_far, twin
    Floats numbers;      // six per entry: turn (two numbers), angle, length, along (two numbers)
    Floats sides;        // TearLaw::sides
    Floats couplings;    // TearLaw::couplings; null without membranes
    Floats area;         // TearLaw::area
    Floats face_mass;    // kg, per triangle
    Uints faces;         // [corner]
    Vec4s position;      // of the cloth's particles
    Vec4s start;
    Vec4s velocity;
    Vec4s compensation;
    Floats weights;      // 1/kg
    Floats thickness;    // factors; null: all 1
    Floats mass;         // kg
    Uints vertex;        // per particle
    Floats strayed;      // per vertex
    Uints watched;       // per particle: 1 if it is looked at in every substep
    Vec4s loads;         // per particle: load, direction of the tension, 1 if a cut ends there
    Uints chosen;        // per particle: 1 if it opens in this substep
    Uints list;          // candidates, then the particles that open
    Uints fan;           // per entry
    TearKindRef kinds;
    Uints vertices;      // TearTable::vertices
    Floats watch;        // TearLaw::watch
    Floats inverse_resistance;  // per vertex
    Floats seams;        // TearLaw::seams, four per entry; null without seams
    Uints settled;       // OpenedArrays::settled; null if the cloth does not erode
    Uints row_begin;     // per vertex, and one more
    Uints row_items;     // constraints at each vertex
    Uints second;        // TearTable::second
    Floats half_fields;  // per row below `halves`: both compliances of the first half, then of the second half
    Uints blocks;        // of lines: begin and length, with WEFT_CUT_BLOCK
    TearHeadRef head;
    Uints log;           // TearOpeningIn by opening
    uint stride;         // of triangles
    uint block_count;
    uint halves;         // TearTable::half_stride
    uint first_particles;  // at the start of the frame
    uint all_particles;    // with those in reserve
    float inverse_strength[2];
    float energy;
    float inverse_stretch;
    float watched_part;
    uint erodes;
    uint has_seams;
    uint has_couplings;
};

struct TearArgs {
    TearDataRef data;
};

#ifdef __cplusplus
}  // namespace weft::vulkan
#else
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer TearDataRef {
    TearData at;
};
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer TearKindRef {
    TearKindIn at[];
};
layout(buffer_reference, std430, buffer_reference_align = 16) buffer TearHeadRef {
    TearHead at;
};
#endif

#endif
