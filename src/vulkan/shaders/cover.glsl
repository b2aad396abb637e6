// Lists the colliders near each tile, as src/cpu/collider_lists.h does. Each pass of contact begins with it, because
// lists made before a tile left its box may miss a collider. Lists change no bit of a result.
#ifndef WEFT_COVER_GLSL
#define WEFT_COVER_GLSL

#include "vulkan/shaders/contact.glsl"

#define WEFT_NO_SLOT 0xffffffffu

const float everywhere = 3e38;

// The tile's particles are [tile_begin(tile), tile_end(tile)).
uint tile_begin(uint tile) { return tile * WEFT_COLLIDER_TILE; }
uint tile_end(uint tile) { return min(tile_begin(tile) + WEFT_COLLIDER_TILE, contact_args.at.count); }

bool has_left_box(uint tile)
{
    vec4 low = contact_args.at.tiles.at[tile].low, high = contact_args.at.tiles.at[tile].high;
    for (uint p = tile_begin(tile); p < tile_end(tile); ++p) {
        vec4 x = load_point(contact_args.at.position, p);
        if (x.w > 0.0 && (any(lessThan(x.xyz, low.xyz)) || any(greaterThan(x.xyz, high.xyz)))) return true;
    }
    return false;
}

// Where the particles are expected to be in the rest of the frame: ColliderPart::box_of. Returns false if none of them
// has a mass, because contact moves only what has one.
//   stretch  m: by how much the box is larger because edges are long
bool find_box(uint tile, float stretch, out vec3 low, out vec3 high)
{
    float left = float(contact_args.at.frame.at.substeps - contact_substep());
    float seconds = contact_args.at.frame.at.h * left, way = 0.0;
    vec3 fall = vec3(contact_args.at.frame.at.gravity_x, contact_args.at.frame.at.gravity_y,
                     contact_args.at.frame.at.gravity_z) * (0.5 * seconds * seconds);
    bool any_mass = false;
    low = vec3(everywhere);
    high = vec3(-everywhere);
    for (uint p = tile_begin(tile); p < tile_end(tile); ++p) {
        vec4 x = load_point(contact_args.at.position, p);
        if (!(x.w > 0.0)) continue;
        any_mass = true;
        vec3 by = x.xyz - contact_args.at.start.at[p].xyz, ahead = x.xyz + by * left + fall;
        low = min(low, min(x.xyz, ahead));
        high = max(high, max(x.xyz, ahead));
        way = max(way, length(by));
    }
    float margin = contact_args.at.frame.at.tile_margin + stretch + WEFT_TILE_SLACK * way * left;
    low = low - margin;
    high = high + margin;
    return any_mass;
}

// Whether the tile's list contains the collider. `slots`: [x, y).
bool is_listed(uvec2 slots, uint collider)
{
    while (slots.x < slots.y) {
        uint middle = (slots.x + slots.y) / 2u, there = contact_args.at.slots.at[middle];
        if (there == collider) return true;
        if (there < collider) slots.x = middle + 1u;
        else slots.y = middle;
    }
    return false;
}

// Whether the shape does not act on the cloth, or the collider rests and stays clear of the ball around the box. The
// latter only for shapes whose distance is exact.
bool misses(uint number, vec3 low, vec3 high)
{
    ColliderIn collider = contact_args.at.colliders.at.colliders.at[number];
    if (!shape_acts(collider, contact_args.at.frame)) return true;
    if (collider.pose_step != 0u || !is_none(uvec2(collider.data))) return false;
    PoseIn pose = pose_after(contact_args.at.colliders, collider, 0u);
    vec3 center = 0.5 * (low + high), normal;
    float radius = 0.5 * length(high - low);
    vec3 local = unrotate(pose.x.xyz, pose.y.xyz, pose.z.xyz, center - pose.position.xyz);
    // Floats have 24 bits. Rounding must not hide a collider.
    float rounding = 1e-4 * radius + 1e-5 * (length(local) + length(center) + length(pose.position.xyz));
    return distance_to(collider, local, normal) > radius + rounding;
}

bool overlap(vec4 low_a, vec4 high_a, vec3 low_b, vec3 high_b)
{
    return all(lessThanEqual(low_a.xyz, high_b)) && all(lessThanEqual(low_b, high_a.xyz));
}

// Number of colliders that may touch the box at any time of the frame and are not in the slots `listed`. Writes them to
// the slots from `to` on, unordered, unless that is WEFT_NO_SLOT.
uint find_colliders(vec3 low, vec3 high, uvec2 listed, uint to)
{
    uint found = 0u;
    for (uint node = 0u; node < contact_args.at.colliders.at.node_count;) {
        vec4 node_low = contact_args.at.colliders.at.nodes.at[2u * node];
        vec4 node_high = contact_args.at.colliders.at.nodes.at[2u * node + 1u];
        uint collider = floatBitsToUint(node_high.w);
        bool inside = overlap(node_low, node_high, low, high);
        node = inside ? node + 1u : floatBitsToUint(node_low.w);
        if (!inside || collider == WEFT_NO_COLLIDER || misses(collider, low, high) || is_listed(listed, collider))
            continue;
        if (to != WEFT_NO_SLOT) contact_args.at.slots.at[to + found] = collider;
        ++found;
    }
    for (uint body = 0u; has_bodies() && body < contact_args.at.colliders.at.bodies.at.count; ++body) {
        vec4 reach_low = contact_args.at.colliders.at.bodies.at.bodies.at[body].reach_low;
        vec4 reach_high = contact_args.at.colliders.at.bodies.at.bodies.at[body].reach_high;
        uint collider = contact_args.at.colliders.at.bodies.at.bodies.at[body].collider;
        if (!overlap(reach_low, reach_high, low, high) || is_listed(listed, collider)) continue;
        if (to != WEFT_NO_SLOT) contact_args.at.slots.at[to + found] = collider;
        ++found;
    }
    return found;
}

// Comb sort: it needs no stack, and a list of n takes about n log n steps.
void sort_slots(uint begin, uint count)
{
    uint gap = count;
    bool swapped = false;
    while (gap > 1u || swapped) {
        gap = max(gap * 10u / 13u, 1u);
        swapped = false;
        for (uint i = begin; i + gap < begin + count; ++i) {
            uint one = contact_args.at.slots.at[i], other = contact_args.at.slots.at[i + gap];
            if (one < other) continue;
            contact_args.at.slots.at[i] = other;
            contact_args.at.slots.at[i + gap] = one;
            swapped = true;
        }
    }
}

// What contact with a slot has added up so far goes along. `from` WEFT_NO_SLOT: a new slot, which starts at 0.
void carry_over(uint from, uint to)
{
    bool keeps = !is_none(uvec2(contact_args.at.sums)) && (contact_args.at.first_iteration == 0u || has_bodies());
    bool traces = !is_none(uvec2(contact_args.at.contact_log)), is_new = from == WEFT_NO_SLOT;
    uint turned = contact_args.at.capacity * WEFT_COLLIDER_TILE;
    if (begins_frame() || !(keeps || traces)) return;  // contact writes them before it reads them
    for (uint i = 0u; i < WEFT_COLLIDER_TILE; ++i) {
        uint at = to * WEFT_COLLIDER_TILE + i, old = is_new ? 0u : from * WEFT_COLLIDER_TILE + i;
        vec4 zero = vec4(0.0);
        if (keeps) contact_args.at.sums.at[at] = is_new ? zero : contact_args.at.sums.at[old];
        if (!traces) continue;
        contact_args.at.contact_log.at[at] = is_new ? zero : contact_args.at.contact_log.at[old];
        contact_args.at.contact_log.at[turned + at] = is_new ? zero : contact_args.at.contact_log.at[turned + old];
    }
}

// Merges the slots `listed` and the `fresh` ones at the end of the new list into the new list, which begins at slot `to`.
void merge_slots(uvec2 listed, uint to, uint fresh)
{
    uint from = listed.x, next = to + (listed.y - listed.x), end = next + fresh;
    for (uint slot = to; slot < end; ++slot) {
        uint before = from < listed.y ? contact_args.at.slots.at[from] : WEFT_NO_SLOT;
        uint added = next < end ? contact_args.at.slots.at[next] : WEFT_NO_SLOT;
        bool was_listed = before < added;
        contact_args.at.slots.at[slot] = min(before, added);
        carry_over(was_listed ? from : WEFT_NO_SLOT, slot);
        if (was_listed) ++from;
        else ++next;
    }
}

// Adds to the tile's list what may touch the box. Returns false if there are too few slots.
bool extend_list(uint tile, uvec2 listed, vec3 low, vec3 high)
{
    uint before = listed.y - listed.x, fresh = 0u, to = WEFT_NO_SLOT;
    for (uint round = 0u; round < 2u; ++round) {  // counts, then writes
        fresh = find_colliders(low, high, listed, to == WEFT_NO_SLOT ? to : to + before);
        if (round == 1u || fresh == 0u) break;
        to = atomicAdd(contact_args.at.report.at[WEFT_REPORT_NEAR_SLOTS], before + fresh);
        uint capacity = contact_args.at.capacity;
        if (before + fresh > capacity || to > capacity - (before + fresh)) return false;
    }
    if (fresh == 0u) return true;
    sort_slots(to + before, fresh);
    merge_slots(listed, to, fresh);
    contact_args.at.tiles.at[tile].first = to;
    contact_args.at.tiles.at[tile].count = before + fresh;
    return true;
}

void run_cover(uint tile)
{
    bool begins = begins_frame(), bodies_left = false;
    uint serial = 0u;
    if (has_bodies()) {
        serial = contact_args.at.colliders.at.bodies.at.reach_serial;
        bodies_left = contact_args.at.tiles.at[tile].reach_serial != serial;
        contact_args.at.tiles.at[tile].reach_serial = serial;
    }
    bool left = begins || has_left_box(tile);
    // As ColliderPart::cover().
    float widest = contact_args.at.frame.at.widest_face, before = begins ? 0.0 : contact_args.at.tiles.at[tile].low.w;
    float longest = longest_edge_now(), stretch = before;
    bool stretched = longest - widest > stretch;
    if (stretched) stretch = WEFT_ROOM_TO_STRETCH * longest - widest;
    if (!left && !bodies_left && !stretched) return;
    uvec2 listed = begins ? uvec2(0u) : slots_near(contact_args.at.tiles, tile_begin(tile));
    if (begins) contact_args.at.tiles.at[tile].first = contact_args.at.tiles.at[tile].count = 0u;
    vec3 low = contact_args.at.tiles.at[tile].low.xyz, high = contact_args.at.tiles.at[tile].high.xyz;
    bool any_mass = all(lessThanEqual(low, high)) && low.x > -everywhere;
    if (any_mass && !begins) low = low - (stretch - before), high = high + (stretch - before);
    if (left) {
        vec3 low_now, high_now;
        any_mass = find_box(tile, stretch, low_now, high_now);
        low = any_mass && !begins ? min(low, low_now) : low_now;
        high = any_mass && !begins ? max(high, high_now) : high_now;
    }
    // A frame with numbers that are not finite is rolled back.
    bool finite = is_finite(vec4(low, 0.0)) && is_finite(vec4(high, 0.0));
    if (any_mass && finite && !extend_list(tile, listed, low, high)) {
        atomicOr(contact_args.at.report.at[WEFT_REPORT_BITS], WEFT_REPORT_NEAR_FULL);
        finite = false;
    }
    if (!finite) low = vec3(-everywhere), high = vec3(everywhere);  // no further search in this frame
    contact_args.at.tiles.at[tile].low = vec4(low, stretch);
    contact_args.at.tiles.at[tile].high = vec4(high, 0.0);
}

#endif
