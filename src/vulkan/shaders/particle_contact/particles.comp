#version 450
// Passes with one invocation per place in a tile.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/particle_contact/spheres.glsl"

// Finds whether a particle has moved so far that the lists do not hold any more.
void run_track(uint tile, uint p)
{
    if (invocation() == 0u) {
        head.contacts = 0u;
        if (args.first_of_frame == 1u) head.searches = 0u, head.wanted = 0u;
    }
    spheres.pushes.at[p] = 0u;
    vec4 now = spheres.position.at[p], listed = spheres.listed.at[invocation()];
    vec3 moved = now.xyz - listed.xyz;
    float most = 0.5 * spheres.tiles.at[tile].margin, moved2 = dot(moved, moved);
    if (spheres.search_always == 1u || head.known == 0u || !is_finite(moved2) || moved2 > most * most)
        head.outdated = 1u;
}

// What the pushes of the particle add up to. Clears the sum.
bool take_push(uint p, out vec3 push)
{
    ivec3 sum;
    for (uint k = 0u; k < 3u; ++k) sum[k] = int(take_sum(spheres.sums, p, k));
    push = vec3(sum) * float(1.0 / WEFT_PUSH_QUANTA_PER_METER);
    return sum != ivec3(0);
}

void run_move(uint tile, uint p)
{
    vec3 push;
    if (!take_push(p, push)) return;
    vec4 x = spheres.position.at[p];
    spheres.position.at[p] = vec4(x.xyz + push, x.w);
}

// The velocity follows from the motion since the start of the substep. With the start moved, pushes do not make cloth
// bounce.
void run_settle(uint tile, uint p)
{
    vec3 push;
    if (!take_push(p, push)) return;
    vec4 x = spheres.start.at[p];
    spheres.start.at[p] = vec4(x.xyz + push, x.w);
}

void main()
{
    uint slot = invocation(), tile = slot / WEFT_PARTICLE_TILE;
    if (tile >= spheres.tile_count || slot % WEFT_PARTICLE_TILE >= spheres.tiles.at[tile].count) return;
    WEFT_PASS(tile, spheres.particles.at[slot]);
}
