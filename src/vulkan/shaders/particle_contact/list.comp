#version 450
// Lists the pairs of each tile with itself and with the tiles of higher numbers, if new lists are needed. One workgroup
// per tile.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/particle_contact/spheres.glsl"

// Pairs may be this much farther apart, because rounding makes distances inexact: a factor on the margin, and a part of
// the largest coordinate.
const float widened_margin = 1.001, rounding_of_place = 4e-6;

shared vec4 place[WEFT_PARTICLE_TILE], rest[WEFT_PARTICLE_TILE];
shared uint near[WEFT_PARTICLE_GROUP];
shared uint near_count;

float reach_of(SphereTileIn a, SphereTileIn b, vec3 x)
{
    float largest = max(abs(x.x), max(abs(x.y), abs(x.z)));
    return widened_margin * 0.5 * (a.margin + b.margin) + rounding_of_place * largest;
}

bool may_meet(uint one, uint two, SphereTileIn a)
{
    SphereTileIn b = spheres.tiles.at[two];
    if (a.with_alike == 0u && b.with_alike == 0u) return false;
    if (a.cloth != b.cloth && ((a.groups & b.collides_with) == 0u || (b.groups & a.collides_with) == 0u)) return false;
    vec4 low_a = spheres.boxes.at[2u * one], high_a = spheres.boxes.at[2u * one + 1u];
    vec4 low_b = spheres.boxes.at[2u * two], high_b = spheres.boxes.at[2u * two + 1u];
    float reach = 0.5 * (a.diameter + b.diameter) + reach_of(a, b, max(abs(low_a.xyz), abs(high_a.xyz)));
    return all(lessThanEqual(low_a.xyz, high_b.xyz + reach)) && all(lessThanEqual(low_b.xyz, high_a.xyz + reach));
}

void list_pair(uint one, uint two, uint i, uint j, SphereTileIn a, SphereTileIn b)
{
    uint slot = two * WEFT_PARTICLE_TILE + j;
    vec4 x = spheres.listed.at[slot];
    vec3 between = place[i].xyz - x.xyz;
    vec4 y = spheres.rest.at[slot];
    float diameter = 0.5 * (rest[i].w + y.w);
    if (a.cloth == b.cloth) {
        vec3 apart = rest[i].xyz - y.xyz;
        diameter = diameter_of_pair(diameter, sqrt(dot(apart, apart)), spheres.part_at_rest, a.less_at_rest);
    }
    if (spheres.has_seams == 1u)
        diameter = min(diameter, spheres.part_at_rest * seam_distance(spheres.seam_first, spheres.seam_entries,
                                                                      spheres.particles.at[one * WEFT_PARTICLE_TILE + i],
                                                                      spheres.particles.at[slot]));
    if (!(diameter > 0.0) || !(sqrt(dot(between, between)) < diameter + reach_of(a, b, x.xyz))) return;
    uint at = atomicAdd(head.listed, 1u);
    if (at >= spheres.capacity) return;
    spheres.pairs.at[at] = SpherePairIn(spheres.particles.at[one * WEFT_PARTICLE_TILE + i], spheres.particles.at[slot],
                                        diameter, -1.0);
}

void list_tiles(uint one, uint two, SphereTileIn a)
{
    SphereTileIn b = spheres.tiles.at[two];
    for (uint k = me(); k < WEFT_PARTICLE_TILE * WEFT_PARTICLE_TILE; k += WEFT_PARTICLE_GROUP) {
        uint i = k / WEFT_PARTICLE_TILE, j = k % WEFT_PARTICLE_TILE;
        if (i < a.count && j < b.count && (one != two || i < j)) list_pair(one, two, i, j, a, b);
    }
}

void main()
{
    uint one = group_index();
    if (one >= spheres.tile_count || head.outdated == 0u) return;
    SphereTileIn a = spheres.tiles.at[one];
    if (me() < WEFT_PARTICLE_TILE) {
        place[me()] = spheres.listed.at[one * WEFT_PARTICLE_TILE + me()];
        rest[me()] = spheres.rest.at[one * WEFT_PARTICLE_TILE + me()];
    }
    for (uint first = one; first < spheres.tile_count; first += WEFT_PARTICLE_GROUP) {
        if (me() == 0u) near_count = 0u;
        barrier();
        uint two = first + me();
        if (two < spheres.tile_count && may_meet(one, two, a)) near[atomicAdd(near_count, 1u)] = two;
        barrier();
        uint count = near_count;
        for (uint k = 0u; k < count; ++k) list_tiles(one, near[k], a);
        barrier();
    }
}
