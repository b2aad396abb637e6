#version 450
// Lists the pairs of features of two tiles that can come within their thickness. One workgroup per pair of tiles.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/cloth_contact/contact.glsl"

// Features of one side whose boxes come near the other tile.
struct Culled {
    vec4 center;  // w: number of the feature
    vec3 extent;
};
shared Culled culled[2][WEFT_TILE_EDGES];
shared uint culled_count[2];
shared vec4 now[2][WEFT_TILE_VERTICES];  // places at this tick; w: how far the trajectory leaves the tile's mean motion

uint me() { return gl_LocalInvocationID.x; }
uint threads() { return gl_WorkGroupSize.x; }

// Tile and vertices of a feature.
uint tile_of[2];
vec3 shift;   // half of the way of the second tile relative to the first while the list lasts
vec3 widen;   // how much farther boxes reach
float add;    // m: pairs whose distance is at most this more than their thickness are listed

const uint vertex_kind = 0u, edge_kind = 1u, triangle_kind = 2u;

uint features(uint which, uint kind)
{
    uint tile = tile_of[which];
    if (kind == vertex_kind) return contact.tiles.at[tile].own_vertices;
    return kind == edge_kind ? contact.tiles.at[tile].edges : contact.tiles.at[tile].triangles;
}

// Vertices of the tile; the last one is repeated.
uvec3 corners(uint which, uint kind, uint i)
{
    uint tile = tile_of[which];
    if (kind == vertex_kind) return uvec3(i);
    uint packed = kind == edge_kind ? contact.edges.at[WEFT_TILE_EDGES * tile + i]
                                    : contact.triangles.at[WEFT_TILE_TRIANGLES * tile + i];
    uvec3 all = uvec3(packed, packed >> 8, packed >> 16) & 255u;
    return kind == edge_kind ? all.xyy : all;
}

uint particle_at(uint which, uint vertex) { return contact.particles.at[WEFT_TILE_VERTICES * tile_of[which] + vertex]; }

// `which`: the tile; its relative way is `sign` times the shift.
void cull(uint side, uint which, uint kind, float sign)
{
    vec3 other_center = contact.tracked.at[tile_of[1u - which]].center.xyz;
    vec3 other_extent = contact.tracked.at[tile_of[1u - which]].extent.xyz;
    uint count = features(which, kind);
    for (uint i = me(); i < count; i += threads()) {
        uvec3 v = corners(which, kind, i);
        vec4 p = now[which][v.x], q = now[which][v.y], r = now[which][v.z];
        vec3 low = min(p.xyz, min(q.xyz, r.xyz)), high = max(p.xyz, max(q.xyz, r.xyz));
        Culled box = Culled(vec4(0.5 * (low + high), uintBitsToFloat(i)),
                            0.5 * (high - low) + max(p.w, max(q.w, r.w)));
        vec3 away = abs(box.center.xyz - other_center - sign * shift);
        if (!all(lessThan(away, box.extent + other_extent + widen))) continue;
        culled[side][atomicAdd(culled_count[side], 1u)] = box;
    }
}

// m: of the thickest pair.
float thickness_of_tiles()
{
    return 0.5 * (contact.tiles.at[tile_of[0]].thickness + contact.tiles.at[tile_of[1]].thickness);
}

// A feature is as thick as its thinnest corner.
float thickness_of_pair(bool edges, uvec4 p)
{
    if (is_none(uvec2(contact.thickness))) return thickness_of_tiles();
    float x = contact.thickness.at[p.x], y = contact.thickness.at[p.y], z = contact.thickness.at[p.z],
          w = contact.thickness.at[p.w];
    return edges ? 0.5 * (min(x, y) + min(z, w)) : 0.5 * (x + min(y, min(z, w)));
}

float through(uint p, uint q) { return seam_distance(contact.seam_first, contact.seam_entries, p, q); }

float distance_through_seam(bool edges, uvec4 p)
{
    float least = min(through(p.x, p.z), through(p.x, p.w));
    return min(least, edges ? min(through(p.y, p.z), through(p.y, p.w)) : through(p.x, p.y));
}

// `one`: the tile of side one.
void add_pair(bool edges, uint one, uint first, uint second)
{
    uvec3 a = corners(one, edges ? edge_kind : vertex_kind, first);
    uvec3 b = corners(1u - one, edges ? edge_kind : triangle_kind, second);
    uvec4 p = edges ? uvec4(particle_at(one, a.x), particle_at(one, a.y), particle_at(1u - one, b.x),
                            particle_at(1u - one, b.y))
                    : uvec4(particle_at(one, a.x), particle_at(1u - one, b.x), particle_at(1u - one, b.y),
                            particle_at(1u - one, b.z));
    if (p.x == p.z || p.x == p.w) return;
    if (edges ? p.y == p.z || p.y == p.w : p.x == p.y) return;
    vec4 x0 = now[one][a.x], x1 = edges ? now[one][a.y] : now[1u - one][b.x];
    vec4 x2 = edges ? now[1u - one][b.x] : now[1u - one][b.y], x3 = edges ? now[1u - one][b.y] : now[1u - one][b.z];
    float distance = pair_distance(edges, x0.xyz, x1.xyz, x2.xyz, x3.xyz);
    float away = edges ? max(x0.w, x1.w) + max(x2.w, x3.w) : x0.w + max(x1.w, max(x2.w, x3.w));
    float least = distance - away - add, thickness = thickness_of_pair(edges, p);
    if (!(least < thickness)) return;
    // Neighbors on one cloth keep at most half of their distance at rest, or a thickness above the edge length would
    // push them apart. Features that coincide at rest have no side, so they are left out.
    if (contact.tiles.at[tile_of[0]].cloth == contact.tiles.at[tile_of[1]].cloth) {
        float at_rest = pair_distance(edges, contact.rest.at[p.x].xyz, contact.rest.at[p.y].xyz,
                                      contact.rest.at[p.z].xyz, contact.rest.at[p.w].xyz);
        thickness = min(thickness, at_rest * 0.5);
        if (!(least < thickness && at_rest > 0.0)) return;
    }
    // The same holds near a seam, for the distance through its stitches.
    if (contact.has_seams == 1u) {
        float at_rest = distance_through_seam(edges, p);
        thickness = min(thickness, at_rest * 0.5);
        if (!(least < thickness && at_rest > 0.0)) return;
    }
    uint at = head.list == 0u ? atomicAdd(head.listed0, 1u) : atomicAdd(head.listed1, 1u);
    if (at >= contact.listed_capacity) return;
    contact.listed.at[listed_index(head.list, at)] =
        ListedPair(p, tile_of[one] | (edges ? 0x80000000u : 0u), tile_of[1u - one], thickness, distance - thickness);
}

void list_kind(bool edges, uint one)
{
    barrier();
    if (me() < 2u) culled_count[me()] = 0u;
    barrier();
    // Relative to the first tile, the second one moves by twice the shift.
    float sign = one == 0u ? 1.0 : -1.0;
    cull(0u, one, edges ? edge_kind : vertex_kind, sign);
    cull(1u, 1u - one, edges ? edge_kind : triangle_kind, -sign);
    barrier();
    uint count = culled_count[0] * culled_count[1];
    bool same = tile_of[0] == tile_of[1];
    for (uint k = me(); k < count; k += threads()) {
        Culled a = culled[0][k / culled_count[1]], b = culled[1][k % culled_count[1]];
        if (!all(lessThan(abs(a.center.xyz - b.center.xyz - sign * shift), a.extent + b.extent + widen))) continue;
        uint first = floatBitsToUint(a.center.w), second = floatBitsToUint(b.center.w);
        if (same && edges && first >= second) continue;
        add_pair(edges, one, first, second);
    }
}

// The shorter of the two remaining times; shorter still for tiles that meet at speed, whose list would hold all that
// they fly past. Then the faster tile is searched again at its end.
void choose_horizon()
{
    uint tick = head.tick, never = 0xffffffffu;
    vec3 means[2];
    uint ticks = 12u;  // longest_lifetime
    for (uint i = 0u; i < 2u; ++i) {
        means[i] = contact.tracked.at[tile_of[i]].mean.xyz;
        uint until = contact.tracked.at[tile_of[i]].until;
        if (until != never) ticks = min(ticks, until - tick);
    }
    vec3 relative = means[1] - means[0];
    float slack = slack_when_listed(tile_of[0]) + slack_when_listed(tile_of[1]);
    float speed = length(relative), most = 0.5 * slack;
    if (speed * float(ticks) > most) {
        ticks = max(1u, uint(most / speed));
        uint faster = dot(means[0], means[0]) > dot(means[1], means[1]) ? 0u : 1u;
        if (me() == 0u) atomicMin(contact.tracked.at[tile_of[faster]].until, tick + ticks);
    }
    vec3 moved = relative * float(ticks);
    shift = 0.5 * moved;
    add = slack + length(moved);
    widen = vec3(thickness_of_tiles() + slack) + abs(shift);
}

void main()
{
    uint pair = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    if (pair >= min(head.tile_pairs, contact.tile_pair_capacity)) return;
    tile_of[0] = contact.tile_pairs.at[2u * pair];
    tile_of[1] = contact.tile_pairs.at[2u * pair + 1u];
    choose_horizon();
    for (uint which = 0u; which < 2u; ++which) {
        uint tile = tile_of[which];
        bool moving = contact.tracked.at[tile].until != 0xffffffffu;
        float ticks = float(head.tick - contact.tracked.at[tile].listed);
        for (uint i = me(); i < contact.tiles.at[tile].vertices; i += threads()) {
            vec4 place = contact.places.at[WEFT_TILE_VERTICES * tile + i];
            vec3 v = contact.velocities.at[WEFT_TILE_VERTICES * tile + i].xyz;
            float away = place.w;
            if (moving) away += length(v - contact.tracked.at[tile].mean.xyz) * float(contact.tracked.at[tile].lifetime);
            now[which][i] = vec4(place.xyz + v * ticks, away);
        }
    }
    list_kind(false, 0u);
    if (tile_of[0] != tile_of[1]) list_kind(false, 1u);
    list_kind(true, 0u);
}
