#version 460
// Bounding box of an object's vertices: minimum and maximum as integers that have the order of the floats.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#define WEFT_OWN_PUSH
#include "render/shading/frame.data.h"

layout(local_size_x = 64) in;
layout(buffer_reference, std430, buffer_reference_align = 4) buffer Bounds { uint at[]; };
layout(push_constant, std430) uniform Push {
    ObjectRef object;
    Bounds bounds;
    uint count;
} push;

uint ordered(float x) {
    uint bits = floatBitsToUint(x);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

void main() {
    uint stride = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    vec3 least = vec3(3e38), most = vec3(-3e38);
    for (uint i = gl_GlobalInvocationID.x; i < push.count; i += stride) {
        vec3 p = push.object.data.positions.at[i].xyz;
        vec3 q = push.object.data.transform[0].xyz * p.x + push.object.data.transform[1].xyz * p.y +
                 push.object.data.transform[2].xyz * p.z + push.object.data.transform[3].xyz;
        if (any(isnan(q)) || any(isinf(q))) continue;
        least = min(least, q);
        most = max(most, q);
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (least[axis] > most[axis]) continue;
        atomicMin(push.bounds.at[axis], ordered(least[axis]));
        atomicMax(push.bounds.at[3 + axis], ordered(most[axis]));
    }
}
