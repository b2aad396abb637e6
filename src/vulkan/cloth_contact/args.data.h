// Arguments and data of contact between cloths, shared by C++ and GLSL.
#ifndef WEFT_VULKAN_CLOTH_CONTACT_ARGS_H
#define WEFT_VULKAN_CLOTH_CONTACT_ARGS_H

#include "vulkan/seams.data.h"

// Sizes of a tile (collide/tiles.h), and tiles per group of tiles.
#define WEFT_TILE_VERTICES 96
#define WEFT_TILE_EDGES 128
#define WEFT_TILE_TRIANGLES 64
#define WEFT_TILES_TOGETHER 64

#define WEFT_CAP_OF_SURFACE 1e9  // m: cap_of_surface
#define WEFT_MOST_CARRIED 28.0   // caps: most_carried
#define WEFT_CONTACT_ROUNDS 4        // contact_rounds
#define WEFT_CONTACT_EXTRA_SWEEPS 4  // contact_extra_sweeps
// Rounds of the limit that run in parallel. What they leave to do, one workgroup does.
#define WEFT_LIMIT_ROUNDS 6
#define WEFT_LIMIT_SLIDES 4    // limit_slides
#define WEFT_LIMIT_HALVINGS 3  // limit_halvings
#define WEFT_MOST_RETREATS (WEFT_LIMIT_SLIDES + WEFT_LIMIT_HALVINGS + 1)

// The two kinds of search of a substep, and their lists of near pairs.
#define WEFT_SEARCH_MOTION 0    // for the motion to where the constraints left the particles
#define WEFT_SEARCH_ANYWHERE 1  // for all places on the way there, because the limit sent particles back

// Flags of a near pair.
#define WEFT_PAIR_OF_EDGES 1u
#define WEFT_PAIR_PUSHED 2u  // in this substep

// ContactMark of solver/state/contact_marks.h.
#define WEFT_MARK_TOUCHES 1u
#define WEFT_MARK_LIMITED 2u
#define WEFT_MARK_TANGLED 4u

#ifdef __cplusplus
namespace weft::vulkan {
using ContactDataRef = std::uint64_t;
using ContactTileRef = std::uint64_t;
using TrackedTileRef = std::uint64_t;
using ListedPairRef = std::uint64_t;
using TangledPairRef = std::uint64_t;
using Uvec4s = std::uint64_t;
using ContactHeadRef = std::uint64_t;
using ReportsRef = std::uint64_t;
using PosesOfCarriersRef = std::uint64_t;
struct uvec4 {
    uint x, y, z, w;
};
#else
layout(buffer_reference) buffer ContactDataRef;
layout(buffer_reference) buffer ContactTileRef;
layout(buffer_reference) buffer TrackedTileRef;
layout(buffer_reference) buffer ListedPairRef;
layout(buffer_reference) buffer TangledPairRef;
layout(buffer_reference) buffer Uvec4s;
layout(buffer_reference) buffer ContactHeadRef;
layout(buffer_reference) buffer ReportsRef;
layout(buffer_reference) buffer PosesOfCarriersRef;
#endif

// A tile of a cloth. Its vertices, edges and triangles are in arrays of fixed size per tile.
struct ContactTileIn {
    uint vertices;
    uint own_vertices;
    uint edges;
    uint triangles;
    uint cloth;
    float thickness;  // m, of its thickest vertex
    float static_friction;
    float kinetic_friction;
    uint groups;  // CollisionFilter
    uint collides_with;
    float slack;  // m: how far a vertex may be from its listed trajectory
    uint kind;  // WEFT_TILE_…
};

#define WEFT_TILE_OF_SURFACE 1u  // of a collider: it has pairs with cloths alone
#define WEFT_TILE_THIN 2u        // is_thin()

// The trajectory that a tile's lists were made for (TileState of collide/pair_search.h), and where it is now.
struct TrackedTile {
    vec4 center;  // m; of the box around its vertices, at the start of the tick; w: spread
    vec4 extent;  // m: half of the box's size; w: stray
    vec4 mean;    // m per tick: mean velocity; w: m, the slack when it was listed
    uint listed;  // tick; 0: never
    uint until;   // tick from which on its lists are not valid
    uint lifetime;
    uint outdated;
};

struct ListedPair {
    uvec4 particle;
    uint one;  // tile of side one; the highest bit is set for a pair of edges
    uint two;  // tile of side two
    float thickness;  // m
    float spare;      // m: by how much the distance exceeded the thickness when it was listed
};

// An edge and a triangle that pass through each other (TangledPair of collide/tangle.h).
struct TangledPairIn {
    uint a;
    uint b;
    uint c;
    uint d;
    uint e;
    float x;  // direction
    float y;
    float z;
};

// Workgroups of an indirect dispatch.
struct GroupsIn {
    uint x;
    uint y;
    uint z;
};

struct ContactHead {
    // Of the substep.
    GroupsIn keep_groups;
    GroupsIn list_groups;
    GroupsIn listed_groups;
    GroupsIn near_groups0;  // by search
    GroupsIn near_groups1;
    uint tick;
    uint outdated;    // 1: there are outdated tiles
    uint tile_pairs;  // pairs of tiles to search
    uint list;        // which half of the listed pairs is in use
    uint listed0;     // number of pairs in each half
    uint listed1;
    uint near0;       // near pairs, by search
    uint near1;
    uint substep;
    uint brakes;      // 1: the brake slows particles, so the search for the motion runs again
    uint uncovered;   // 1: the search for all places is needed
    uint contacts;
    uint lost[WEFT_CONTACT_EXTRA_SWEEPS];  // 1: some pair loses its gap before this extra sweep
    uint sent_back[2 * WEFT_LIMIT_ROUNDS];  // 1: the round sends particles back; [search · rounds + round]
    uint stuck[2 * WEFT_LIMIT_ROUNDS];      // pairs that sending back does not separate
    // Of the frame.
    uint searches;
    uint limited;
    uint tangled;
    uint tangled_particle;  // the lowest number of a particle in a tangled pair
    // Largest numbers in the frame, including those without room.
    uint wanted_tile_pairs;
    uint wanted_listed;
    uint wanted_near;
};

struct ContactData {
    Vec4s position;  // of the world, by particle; likewise start, velocity
    Vec4s start;
    Vec4s velocity;
    Vec4s reached;  // where the constraints left the particles
    Vec4s asked;    // before the limit
    Vec4s rest;     // w: how far pushes may move the particle if no surface moves, m
    Floats thickness;  // m, by particle; null if that of no cloth varies
    Uints share;  // sums of weights, in quanta
    Uints sums;   // in quanta: four per particle
    Uints scaled_sums;
    Uints part;      // of its motion that the brake leaves to the particle: the bits of a float from 0 to 1
    Uints retreats;  // how often the limit has sent the particle back
    Vec4s slide;     // motion that the limit leaves to a particle that slides
    Uints marks;     // 1: to be sent back
    Uints carrier;       // the moving surface that carries the particle, or to which it belongs, counted from 1; 0: none
    Uints next_carrier;  // that the limit asks to carry the particle; 0: none
    PosesOfCarriersRef carriers;
    Uints contact_marks;  // WEFT_MARK_…; none unless records_marks
    ContactTileRef tiles;
    TrackedTileRef tracked;
    Vec4s places;      // by vertex of the tiles; w: m that the lists cover around the trajectory
    Vec4s velocities;  // m per tick
    Uints particles;   // by vertex of the tiles: in the world
    Uints edges;       // two vertices of the tile, 8 bits each
    Uints triangles;   // three
    Vec4s groups;      // by group of tiles: low and high corner of their boxes
    Uints tile_pairs;  // two tiles each
    ListedPairRef listed;  // two halves of listed_capacity
    // Near pairs, by search:
    Uvec4s near_particles;
    Vec4s near_weights;  // of the closest points
    Vec4s near_normals;  // w: thickness, m
    Vec4s near_starts;   // gap between the sides along the normal and distance at the start, m; friction, static and kinetic
    Vec4s near_pushes;   // kg m; w: depth, m, > 0 where the current sweep pushes
    Uints near_kinds;    // WEFT_PAIR_…
    ContactHeadRef head;
    FrameRef frame;  // of any of the cloths
    ReportsRef reports;
    Uints tangled_count;  // one number; this and the following: see Tangle of collide/tangle.h
    TangledPairRef tangled;
    Uints tangle_first;
    Uints tangle_near;
    Uints seam_first;  // by particle of the world; this and the following: see Seams of collide/seams.h
    SeamEntryRef seam_entries;
    uint untangles;  // 1: the four arrays exist
    uint tile_count;
    uint group_count;
    uint report_count;
    uint tile_pair_capacity;
    uint listed_capacity;
    uint near_capacity;
    uint widest;  // largest number of workgroups along an axis
    float thickest;  // m: of all cloths
    float most_slack;  // m: of all tiles
    float cap_part;    // caps in slacks
    float recovery_speed;  // m/s
    float gap_floor;
    float brake_depth;  // in caps
    float most_aside;   // in caps, as is the next one
    float carry_margin;
    float split;
    float untangling_speed;  // m/s
    uint search_always;
    uint records_marks;
    uint has_seams;  // 1: there are seams
};

struct ClothContactArgs {
    ContactDataRef data;
    uint round;
    uint search;
};

#ifdef __cplusplus
}  // namespace weft::vulkan
#else
layout(buffer_reference, std430, buffer_reference_align = 16) buffer ContactDataRef {
    ContactData at;
};
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer ContactTileRef {
    ContactTileIn at[];
};
layout(buffer_reference, std430, buffer_reference_align = 16) buffer TrackedTileRef {
    TrackedTile at[];
};
layout(buffer_reference, std430, buffer_reference_align = 16) buffer ListedPairRef {
    ListedPair at[];
};
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer TangledPairRef {
    TangledPairIn at[];
};
layout(buffer_reference, std430, buffer_reference_align = 16) buffer Uvec4s {
    uvec4 at[];
};
layout(buffer_reference, std430, buffer_reference_align = 4) buffer ContactHeadRef {
    ContactHead at;
};
layout(buffer_reference, std430, buffer_reference_align = 8) readonly buffer ReportsRef {
    uvec2 at[];  // Uints
};
layout(buffer_reference, std430, buffer_reference_align = 8) readonly buffer PosesOfCarriersRef {
    uvec2 at[];  // PoseRef
};
#endif

#endif
