#version 450
// Writes the keys by which the slots of each tile's list are sorted. One invocation per tile.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/contact_forces/account.glsl"

void main()
{
    if (workgroup() >= args.packet_count) return;
    uint cloth = args.packets.at[workgroup()].cloth, tile = args.packets.at[workgroup()].first + gl_LocalInvocationID.x;
    if (tile >= args.accounts.at[cloth].tile_count) return;
    uint first = args.accounts.at[cloth].tiles.at[tile].first, count = args.accounts.at[cloth].tiles.at[tile].count;
    for (uint slot = first; slot < first + count; ++slot) {
        uint at = args.accounts.at[cloth].first_slot + slot;
        args.pairs.at[at] = args.accounts.at[cloth].first_pair + args.accounts.at[cloth].slots.at[slot];
        args.tiles.at[at] = tile;
        args.slots.at[at] = at;
    }
}
