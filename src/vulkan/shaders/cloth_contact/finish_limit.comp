#version 450
// Does what the parallel rounds of the limit left to do. One workgroup.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/cloth_contact/pairs.glsl"
#include "vulkan/shaders/workgroup_barrier.glsl"

shared uint sends_back, stuck;

void main()
{
    if (is_idle()) return;
    uint me = gl_LocalInvocationID.x, last = slot(WEFT_LIMIT_ROUNDS - 1u);
    uint stuck_before = 0u;
    for (uint round = 0u; round < WEFT_LIMIT_ROUNDS; ++round)
        if (head.sent_back[slot(round)] == 0u) stuck_before = max(stuck_before, head.stuck[slot(round)]);
    if (head.sent_back[last] == 0u) {
        if (me == 0u) head.tangled = max(head.tangled, stuck_before);
        return;
    }
    while (true) {
        workgroup_barrier();
        if (me == 0u) sends_back = stuck = 0u;
        workgroup_barrier();
        for (uint i = me; i < near_count(); i += gl_WorkGroupSize.x) {
            uint found = mark_lost(i);
            if (found == 1u) sends_back = 1u;
            if (found == 2u) atomicAdd(stuck, 1u);
        }
        workgroup_barrier();
        if (sends_back == 0u) break;
        for (uint tile = 0u; tile < contact.tile_count; ++tile)
            for (uint v = me; v < contact.tiles.at[tile].own_vertices; v += gl_WorkGroupSize.x)
                send_back(contact.particles.at[WEFT_TILE_VERTICES * tile + v]);
    }
    if (me == 0u) head.tangled = max(head.tangled, stuck);
}
