#version 450
// Opens edges at the particles whose load is largest within two edges. One workgroup.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/tear/tear_cloth.glsl"

shared uint counts[WEFT_TEAR_GROUP];
shared uint chosen_count, first_opening, end_opening;

uint me() { return gl_LocalInvocationID.x; }
void synchronize()
{
    memoryBarrierBuffer();
    barrier();
}

// Writes the chosen particles to the list, in ascending order. Each invocation looks through a range of particles.
void list_chosen()
{
    uint count = tear_head.particles, each = (count + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
    uint begin = min(me() * each, count), end = min(begin + each, count), mine = 0u;
    for (uint p = begin; p < end; ++p) mine += tear_data.chosen.at[p];
    counts[me()] = mine;
    barrier();
    uint at = 0u;
    for (uint i = 0u; i < me(); ++i) at += counts[i];
    if (me() == gl_WorkGroupSize.x - 1u) chosen_count = at + mine;
    for (uint p = begin; p < end; ++p) {
        if (tear_data.chosen.at[p] == 0u) continue;
        tear_data.list.at[at++] = p;
        tear_data.chosen.at[p] = 0u;
    }
    synchronize();
}

void open_all()
{
    TearCloth c = TearCloth(0u);
    first_opening = tear_head.openings;
    for (uint i = 0u; i < min(chosen_count, WEFT_TEAR_MOST_OPENINGS); ++i) {
        uint p = tear_data.list.at[i];
        TearOpening o = tear_opening(c, p, tear_kept_load(c, p));
        if (o.first == WEFT_TEAR_NONE || !tear_open(c, o)) continue;
        uint at = 4u * tear_head.openings++;
        tear_data.log.at[at] = o.first;
        tear_data.log.at[at + 1u] = o.second;
        tear_data.log.at[at + 2u] = floatBitsToUint(o.first_strayed);
        tear_data.log.at[at + 3u] = floatBitsToUint(o.second_strayed);
    }
    end_opening = tear_head.openings;
    tear_head.candidates = 0u;
}

uint vertex_of_opening(TearCloth c, uint opening, uint k)
{
    TearOpening o = tear_no_opening();
    o.first = tear_data.log.at[4u * opening];
    o.second = tear_data.log.at[4u * opening + 1u];
    return tear_opened_vertex(c, o, k);
}

// Particles at the vertex have other masses now, unless they are pinned. Those around them are watched from now on.
void update_particles(TearCloth c, uint vertex)
{
    for (uint i = tear_ring(c, vertex); i < tear_ring(c, vertex + 1u); ++i) {
        uint corner = tear_corner(c, i), p = tear_face(c, corner);
        if (tear_data.weights.at[p] > 0.0) tear_data.weights.at[p] = 1.0 / tear_mass(c, p);
        tear_data.position.at[p].w = tear_data.weights.at[p];
        for (uint k = 0u; k < 3u; ++k) tear_data.watched.at[tear_corner_of(c, tear_triangle(c, corner), k)] = 1u;
    }
}

void main()
{
    TearCloth c = TearCloth(0u);
    uint candidates = tear_head.candidates;
    if (candidates == 0u) return;
    for (uint i = me(); i < candidates; i += gl_WorkGroupSize.x) {
        uint p = tear_data.list.at[i];
        if (tear_is_largest(c, p, tear_kept_load(c, p))) tear_data.chosen.at[p] = 1u;
    }
    synchronize();
    list_chosen();
    if (me() == 0u) open_all();
    synchronize();
    uint openings = end_opening - first_opening;
    for (uint i = me(); i < openings; i += gl_WorkGroupSize.x) {
        for (uint k = 0u; k < 3u; ++k) {
            uint vertex = vertex_of_opening(c, first_opening + i, k);
            if (vertex != WEFT_TEAR_NONE) update_particles(c, vertex);
        }
    }
    for (uint i = 0u; i < 3u * openings; ++i) {
        uint vertex = vertex_of_opening(c, first_opening + i / 3u, i % 3u);
        if (vertex == WEFT_TEAR_NONE) continue;
        for (uint r = tear_data.row_begin.at[vertex] + me(); r < tear_data.row_begin.at[vertex + 1u]; r += gl_WorkGroupSize.x) {
            uint item = tear_data.row_items.at[r];
            tear_update_row(c, item >> WEFT_TEAR_ROW_BITS, item & ((1u << WEFT_TEAR_ROW_BITS) - 1u));
        }
    }
}
