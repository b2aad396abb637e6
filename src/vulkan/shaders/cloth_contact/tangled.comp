#version 450
// A pass with one invocation per pair of an edge and a triangle that were found to pass through each other.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/cloth_contact/pairs.glsl"

vec3 start_of(uint p)
{
    vec4 x = contact.start.at[p];
    return x.xyz;
}

PassingEdge passing_edge(TangledPairIn pair)
{
    return edge_through_triangle(start_of(pair.a), start_of(pair.b), start_of(pair.c), start_of(pair.d),
                                 start_of(pair.e));
}

// Calls visit(particle, weight) for the five particles.
#define WEFT_EACH_OF_FIVE(visit, pair, edge) \
    visit(pair.a, edge.w0);                  \
    visit(pair.b, edge.w1);                  \
    visit(pair.c, edge.w2);                  \
    visit(pair.d, edge.w3);                  \
    visit(pair.e, edge.w4);

void run_share_untangling(uint i)
{
    TangledPairIn pair = contact.tangled.at[i];
    PassingEdge edge = passing_edge(pair);
    if (!edge.passes) return;
    WEFT_EACH_OF_FIVE(add_share, pair, edge)
}

// See ClothContact::untangle() of the CPU backend.
void run_push_untangling(uint i)
{
    TangledPairIn pair = contact.tangled.at[i];
    PassingEdge edge = passing_edge(pair);
    if (!edge.passes) return;
    float resistance = 0.0;
    vec3 moved = vec3(0.0), direction = vec3(pair.x, pair.y, pair.z);
#define WEFT_ADD(p, weight)                                                      \
    resistance += contact_resistance(inverse_mass_of(p), weight, share_of(p));   \
    moved = moved + (place_of(p) - start_of(p)) * (weight)
    WEFT_EACH_OF_FIVE(WEFT_ADD, pair, edge)
#undef WEFT_ADD
    float missing = contact.untangling_speed * contact.frame.at.h - dot(moved, direction);
    if (!(missing > 0.0) || !(resistance > 1e-12)) return;
    vec3 push = direction * (missing / resistance);
#define WEFT_ADD(p, weight) \
    add_to(contact.sums, p, push * ((weight) * inverse_mass_of(p)), WEFT_PUSH_QUANTA_PER_METER)
    WEFT_EACH_OF_FIVE(WEFT_ADD, pair, edge)
#undef WEFT_ADD
}

void main()
{
    if (invocation() < contact.tangled_count.at[0]) WEFT_PASS(invocation());
}
