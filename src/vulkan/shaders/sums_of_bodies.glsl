// What contact adds to the sums of a body (bodies.data.h), and a body as a contact sees it.
#ifndef WEFT_SUMS_OF_BODIES_GLSL
#define WEFT_SUMS_OF_BODIES_GLSL

#include "vulkan/shaders/sum_words.glsl"

// Each overflow of the low word adds one to the high word, so the sum does not depend on the order.
void add_to_body_sum(BodiesRef bodies, uint body, uint sum, float quanta)
{
    uvec2 words = words_of(quanta);
    if (words == uvec2(0u)) return;
    uint at = WEFT_BODY_SUM_WORDS * body + 2u * sum;
    uint before = atomicAdd(bodies.at.sums.at[at], words.x);
    uint high = words.y + (before + words.x < before ? 1u : 0u);
    if (high != 0u) atomicAdd(bodies.at.sums.at[at + 1u], high);
}

// N s, at a point in the world.
void add_impulse_to_body(BodiesRef bodies, uint body, vec3 impulse, vec3 x)
{
    vec3 twist = cross(x - bodies.at.bodies.at[body].place.xyz, impulse);
    for (uint axis = 0u; axis < 3u; ++axis) {
        add_to_body_sum(bodies, body, axis, to_impulse_quanta(impulse[axis]));
        add_to_body_sum(bodies, body, 3u + axis, to_impulse_quanta(twist[axis]));
    }
}

// Adds the opposite of what a contact did to a particle, which is now at `x`.
void add_to_body(BodiesRef bodies, uint body, vec3 by, vec3 x, float w)
{
    add_impulse_to_body(bodies, body, by * contact_momentum(w, bodies.at.inv_h), x);
}

bool feels_cloth(BodiesRef bodies, uint body) { return bodies.at.bodies.at[body].feels_cloth != 0u; }

void add_touch(BodiesRef bodies, uint body)
{
    atomicAdd(bodies.at.sums.at[WEFT_BODY_SUM_WORDS * body + WEFT_BODY_SUM_TOUCHES], 1u);
}

// As one of the contacts with cloth sees it. A body that does not feel cloth does not give way.
MovedBody moved_body(BodiesRef bodies, uint body)
{
    vec4 v = bodies.at.bodies.at[body].v, moments = bodies.at.bodies.at[body].moments;
    float contacts = feels_cloth(bodies, body) ? v.w : 0.0;
    return MovedBody(contacts, moments.w, bodies.at.bodies.at[body].place.xyz,
                     bodies.at.bodies.at[body].ix.xyz, bodies.at.bodies.at[body].iy.xyz,
                     bodies.at.bodies.at[body].iz.xyz);
}

#endif
