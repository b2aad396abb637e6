// What the passes that read contacts back are told, read by C++ and by GLSL.
#ifndef WEFT_VULKAN_FEEDBACK_ARGS_H
#define WEFT_VULKAN_FEEDBACK_ARGS_H

#include "vulkan/primitives/args.data.h"

// Of a cloth and a collider: low and high word of each axis of momentum, then of angular momentum; then how many
// contacts there are.
#define WEFT_SUM_WORDS 16
#define WEFT_SUM_CONTACTS 12

#define WEFT_RECORD_WORDS 8  // solver/state/feedback.h has them

#ifdef __cplusplus
namespace weft::vulkan {
using AccountRef = std::uint64_t;
using PacketRef = std::uint64_t;
#else
layout(buffer_reference) buffer AccountRef;
layout(buffer_reference) buffer PacketRef;
#endif

// Of a cloth.
struct AccountIn {
    Vec4s position;
    Vec4s moved;   // [collider · capacity + particle], as is the next one (feedback.kernel.h)
    Vec4s turned;
    Uints report;
    FrameRef frame;
    Uints sums;    // per collider
    uint capacity;
    uint particles;
};

// What a workgroup works on: neighboring particles of a cloth, and a collider. Packets are in the order of the list.
struct PacketIn {
    uint cloth;
    uint collider;
    uint first;
    uint unused;
};

struct ContactListArgs {
    AccountRef accounts;
    PacketRef packets;
    Uints flags;     // per invocation: 1 where there is a contact; scanned: how many up to there
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
