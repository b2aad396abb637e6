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
    Vec4s moved;   // [collider · capacity + particle], as is `turned` (contact_forces.kernel.h)
    Vec4s turned;
    Uints report;
    FrameRef frame;
    Uints sums;    // per collider
    uint capacity;
    uint particles;
};

// Work of one workgroup: consecutive particles of a cloth, and a collider. Packets are in the order of the list.
struct PacketIn {
    uint cloth;
    uint collider;
    uint first;
    uint unused;
};

struct ContactListArgs {
    AccountRef accounts;
    PacketRef packets;
    Uints flags;     // per invocation: 1 for a contact; after the scan: number of contacts up to this one
    Uints contacts;  // the list
    uint count;      // packets
    uint room;       // contacts
};

#ifdef __cplusplus
}  // namespace weft::vulkan
#else
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer AccountRef {
    AccountIn at[];
};
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer PacketRef {
    PacketIn at[];
};
#endif

#endif
