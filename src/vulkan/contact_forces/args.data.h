// Arguments of the passes that read contacts back, shared by C++ and GLSL.
#ifndef WEFT_VULKAN_CONTACT_FORCES_ARGS_H
#define WEFT_VULKAN_CONTACT_FORCES_ARGS_H

#include "vulkan/primitives/args.data.h"

// Sums of one cloth and one collider: low and high word of each axis of momentum, then of angular momentum; then the
// number of contacts.
#define WEFT_SUM_WORDS 16
#define WEFT_SUM_CONTACTS 12

#define WEFT_RECORD_WORDS 8  // ContactRecord in solver/state/contact_forces.h

#ifdef __cplusplus
namespace weft::vulkan {
using AccountRef = std::uint64_t;
using PacketRef = std::uint64_t;
#else
layout(buffer_reference) buffer AccountRef;
layout(buffer_reference) buffer PacketRef;
#endif

// Contact data of one cloth.
struct AccountIn {
    Vec4s position;
    Vec4s moved;  // [slot · tile + particle in the tile], as is `turned` (contact_forces.kernel.h)
    Vec4s turned;
    Uints report;
    FrameRef frame;
    Uints sums;  // per collider
    NearTileRef tiles;
    Uints slots;  // colliders
    uint tile_count;
    uint particles;
    uint first_slot;  // slots of all cloths are numbered one after another, as are pairs of a cloth and a collider
    uint first_pair;
};

// Work of one workgroup: consecutive tiles of a cloth.
struct PacketIn {
    uint cloth;
    uint first;
};

struct ContactListArgs {
    AccountRef accounts;
    PacketRef packets;
    // Keys to sort the slots by, and the slots. Those that no list uses come last and have the number 0xffffffff.
    Uints pairs;
    Uints tiles;
    Uints slots;
    Uints flags;     // per slot and particle: 1 for a contact; after the scan: number of contacts up to this one
    Uints contacts;  // the list
    uint cloths;
    uint packet_count;
    uint slot_count;
    uint room;  // contacts
};

#ifdef __cplusplus
}  // namespace weft::vulkan
#else
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer AccountRef {
    AccountIn at[];
};
layout(buffer_reference, std430, buffer_reference_align = 8) readonly buffer PacketRef {
    PacketIn at[];
};
#endif

#endif
