#version 450
// Begins new lists, if they are needed: stores where the particles are, and a box around each tile. One invocation per
// tile.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/particle_contact/spheres.glsl"

void main()
{
    uint tile = invocation();
    if (tile >= spheres.tile_count || head.outdated == 0u) return;
    if (tile == 0u) {
        head.known = 1u;
        head.listed = 0u;
        ++head.searches;
    }
    vec3 low = vec3(1e30), high = vec3(-1e30);
    for (uint i = 0u; i < spheres.tiles.at[tile].count; ++i) {
        uint slot = tile * WEFT_PARTICLE_TILE + i;
        vec4 x = spheres.position.at[spheres.particles.at[slot]];
        spheres.listed.at[slot] = x;
        low = min(low, x.xyz);
        high = max(high, x.xyz);
    }
    spheres.boxes.at[2u * tile] = vec4(low, 0.0);
    spheres.boxes.at[2u * tile + 1u] = vec4(high, 0.0);
}
