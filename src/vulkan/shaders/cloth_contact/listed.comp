#version 450
// Passes over listed pairs.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/cloth_contact/contact.glsl"

// Copies the pairs of tiles that need no search to the other half of the list.
void run_keep(uint i)
{
    uint from = 1u - head.list;
    if (i >= listed_count(from)) return;
    ListedPair pair = contact.listed.at[listed_index(from, i)];
    if (contact.tracked.at[pair.one & 0x7fffffffu].outdated == 1u || contact.tracked.at[pair.two].outdated == 1u) return;
    uint at = head.list == 0u ? atomicAdd(head.listed0, 1u) : atomicAdd(head.listed1, 1u);
    if (at < contact.listed_capacity) contact.listed.at[listed_index(head.list, at)] = pair;
}

// How much closer the sides can be than when they were listed, for all places that they take in this tick.
float approach_of(uint a, uint b)
{
    float ticks = float(head.tick + 1u - max(contact.tracked.at[a].listed, contact.tracked.at[b].listed));
    float relative = contact.tracked.at[a].center.w + contact.tracked.at[b].center.w +
                     length(contact.tracked.at[b].mean.xyz - contact.tracked.at[a].mean.xyz);
    return ticks * relative + contact.tracked.at[a].extent.w + contact.tracked.at[b].extent.w;
}

// See Tangle::joins() of collide/tangle.h.
bool tangle_joins(uint p, uint q)
{
    uint i = contact.tangle_first.at[p], j = contact.tangle_first.at[q];
    uint i_end = contact.tangle_first.at[p + 1u], j_end = contact.tangle_first.at[q + 1u];
    bool joins = false;
    while (!joins && i < i_end && j < j_end) {
        uint of_p = contact.tangle_near.at[i], of_q = contact.tangle_near.at[j];
        joins = of_p / 2u == of_q / 2u && of_p != of_q;
        if (of_p < of_q) ++i;
        else ++j;
    }
    return joins;
}

// Features near a pair that passes through each other do so freely.
bool has_side(uvec4 p, bool edges)
{
    if (contact.untangles == 0u) return true;
    if (tangle_joins(p.x, p.z) || tangle_joins(p.x, p.w)) return false;
    if (edges) return !(tangle_joins(p.y, p.z) || tangle_joins(p.y, p.w));
    return !tangle_joins(p.x, p.y);
}

// Selects the pairs that contact or the limit may have to act on.
void run_near(uint i)
{
    if (i >= listed_count(head.list)) return;
    ListedPair pair = contact.listed.at[listed_index(head.list, i)];
    uint one = pair.one & 0x7fffffffu;
    bool edges = pair.one != one;
    float reach = cap_of_tile(one) + cap_of_tile(pair.two);  // of both
    if (pair.spare > approach_of(one, pair.two) + reach) return;
    vec3 x0 = contact.start.at[pair.particle.x].xyz, x1 = contact.start.at[pair.particle.y].xyz;
    vec3 x2 = contact.start.at[pair.particle.z].xyz, x3 = contact.start.at[pair.particle.w].xyz;
    ClosestPoints points;
    if (edges) points = closest_edge_edge(x0, x1, x2, x3);
    else points = closest_vertex_triangle(x0, x1, x2, x3);
    vec3 n = points.normal;
    if ((contact.tiles.at[one].kind | contact.tiles.at[pair.two].kind) != 0u)
        n = edges ? normal_edge_edge(points, x0, x1, x2, x3) : normal_vertex_triangle(points, x1, x2, x3);
    // Relative to the first particle, so that rounding does not grow with the distance from the origin.
    vec4 start = vec4(0.0, dot(x1 - x0, n), dot(x2 - x0, n), dot(x3 - x0, n));
    vec4 reached = vec4(dot(contact.reached.at[pair.particle.x].xyz - x0, n),
                        dot(contact.reached.at[pair.particle.y].xyz - x0, n),
                        dot(contact.reached.at[pair.particle.z].xyz - x0, n),
                        dot(contact.reached.at[pair.particle.w].xyz - x0, n));
    float gap = edges ? gap_edge_edge(start.x, start.y, start.z, start.w)
                      : gap_vertex_triangle(start.x, start.y, start.z, start.w);
    vec4 low = min(start, reached), high = max(start, reached);
    // The least gap that any positions between start and end can have.
    float worst = edges ? min(low.x, low.y) - max(high.z, high.w) : low.x - max(high.y, max(high.z, high.w));
    vec4 weight = vec4(points.w0, points.w1, points.w2, points.w3);
    bool is_near = dot(weight, reached) < pair.thickness + reach ||
                   worst < pair.thickness * contact.gap_floor + 2.0 * reach;
    if (!is_near || !has_side(pair.particle, edges)) return;
    uint at = args.search == 0u ? atomicAdd(head.near0, 1u) : atomicAdd(head.near1, 1u);
    if (at >= contact.near_capacity) return;
    float rest = sqrt(contact.tiles.at[one].static_friction * contact.tiles.at[pair.two].static_friction);
    float slide = sqrt(contact.tiles.at[one].kinetic_friction * contact.tiles.at[pair.two].kinetic_friction);
    uint to = near_index(at);
    contact.near_particles.at[to] = pair.particle;
    contact.near_weights.at[to] = weight;
    contact.near_normals.at[to] = vec4(n, pair.thickness);
    contact.near_starts.at[to] = vec4(gap, points.distance, rest, slide);
    contact.near_kinds.at[to] = edges ? WEFT_PAIR_OF_EDGES : 0u;
}

void main() { WEFT_PASS(invocation()); }
