#version 450
// A pass over the particles of all tiles. One workgroup per tile.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/cloth_contact/pairs.glsl"

// What contact moves stays within what the lists cover.
vec3 in_reach(uint p, vec3 x)
{
    vec3 away = x - contact.reached.at[p].xyz;
    float length2 = dot(away, away), cap = cap_of(p);
    if (length2 > cap * cap) x = contact.reached.at[p].xyz + away * (cap / sqrt(length2));
    return x;
}

void run_clamp(uint p) { contact.position.at[p].xyz = in_reach(p, place_of(p)); }

void run_move(uint p)
{
    uint share = contact.share.at[p];
    contact.share.at[p] = 0u;
    if (is_skipped() || share == 0u) return;
    vec3 x = place_of(p) + sum_of(contact.scaled_sums, p, WEFT_PUSH_QUANTA_PER_METER);
    clear_sum(contact.sums, p);
    clear_sum(contact.scaled_sums, p);
    contact.position.at[p].xyz = in_reach(p, x);
}

void run_untangle(uint p)
{
    if (contact.share.at[p] == 0u) return;
    contact.share.at[p] = 0u;
    vec3 moved = sum_of(contact.sums, p, WEFT_PUSH_QUANTA_PER_METER);
    clear_sum(contact.sums, p);
    float most = contact.untangling_speed * contact.frame.at.h, length2 = dot(moved, moved);
    if (length2 > most * most) moved = moved * (most / sqrt(length2));
    contact.position.at[p].xyz = place_of(p) + moved;
}

// See ClothContact::brake() of the CPU backend.
void run_brake(uint p)
{
    if (head.brakes == 0u) return;
    float part = uintBitsToFloat(contact.part.at[p]);
    if (!(part < 1.0) || !(inverse_mass_of(p) > 0.0)) return;
    vec3 from = contact.start.at[p].xyz;
    contact.position.at[p].xyz = from + (place_of(p) - from) * part;
}

void begin_limit(uint p)
{
    contact.retreats.at[p] = 0u;
    if (!of_surface(p)) contact.carrier.at[p] = 0u;
}

void run_ask(uint p)
{
    contact.asked.at[p] = contact.position.at[p];
    begin_limit(p);
}

void run_send_back(uint p)
{
    if (is_idle() || head.sent_back[slot(args.round)] == 0u) return;
    send_back(p);
}

// The second search covers all places that the limit may choose, so the limit starts again.
void run_ask_again(uint p)
{
    if (head.uncovered == 0u) return;
    contact.position.at[p].xyz = contact.asked.at[p].xyz;
    begin_limit(p);
}

void run_count(uint p)
{
    if (contact.retreats.at[p] == 0u) return;
    atomicAdd(head.limited, 1u);
    if (contact.records_marks == 1u) contact.contact_marks.at[p] |= WEFT_MARK_LIMITED;
}

void run_slow(uint p)
{
    if (contact.share.at[p] == 0u) return;
    contact.share.at[p] = 0u;
    contact.velocity.at[p].xyz = contact.velocity.at[p].xyz + sum_of(contact.sums, p, WEFT_SPEED_QUANTA_PER_METER);
    clear_sum(contact.sums, p);
}

void main()
{
    uint tile = group_index(), i = gl_LocalInvocationID.x;
    if (tile >= contact.tile_count || i >= contact.tiles.at[tile].own_vertices) return;
    WEFT_PASS(contact.particles.at[WEFT_TILE_VERTICES * tile + i]);
}
