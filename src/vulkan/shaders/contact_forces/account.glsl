// Data of the contact that an invocation works on.
#ifndef WEFT_ACCOUNT_GLSL
#define WEFT_ACCOUNT_GLSL

#include "vulkan/shaders/primitives/tiles.glsl"
#include "vulkan/contact_forces/args.data.h"

#include "physics/lanes.glsl"

#include "physics/contact/contact_forces.kernel.h"

layout(push_constant) uniform Push { ContactListArgs args; };

// Contact data of the packet's cloth, read in place (vulkan/shaders/commands.glsl).
#define WEFT_ACCOUNT args.accounts.at[packet.cloth]

#define WEFT_REPORT_NON_FINITE 2u

vec3 quanta_of(vec3 v, float momentum)
{
    return vec3(to_impulse_quanta(v.x * momentum), to_impulse_quanta(v.y * momentum), to_impulse_quanta(v.z * momentum));
}

#endif
