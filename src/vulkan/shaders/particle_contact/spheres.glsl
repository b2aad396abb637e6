// Common start of the shaders of contact between particles. The passes and their order are in
// vulkan/particle_contact/particle_contact.cpp, the law in physics/particle_contact/particle_contact.md.
#ifndef WEFT_SPHERES_GLSL
#define WEFT_SPHERES_GLSL

#include "vulkan/shaders/common.glsl"
#include "vulkan/particle_contact/args.data.h"

layout(push_constant) uniform Push { ParticleContactArgs args; };

#define spheres args.data.at
#define head args.data.at.head.at

uint group_index() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }
uint me() { return gl_LocalInvocationID.x; }

void add_push(uint p, vec3 push)
{
    for (uint k = 0u; k < 3u; ++k)
        atomicAdd(spheres.sums.at[4u * p + k], uint(int(to_contact_quanta(push[k], WEFT_PUSH_QUANTA_PER_METER))));
}

#endif
