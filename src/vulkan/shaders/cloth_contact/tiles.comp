#version 450
// Passes with one workgroup per tile: finding what has left its listed trajectory, and the tiles that are near others
// (collide/pair_search.cpp has the same on the host).
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/cloth_contact/contact.glsl"
#include "vulkan/primitives/args.data.h"
#include "vulkan/shaders/workgroup_barrier.glsl"

// Ticks that a list is made for at most. A longer one holds more pairs and is made less often.
const uint longest_lifetime = 12u;
// Part of the slack that particles of a tile may leave its mean motion by while a list lasts.
const float most_spread = 1.0;
// Motion per tick, in slacks, below which a tile counts as resting: its list has no end.
const float resting = 0.1;
// How far, in slacks, the motion within a tick may differ from the velocity for the list to follow the velocity.
const float follows_velocity = 0.48;
const uint never = 0xffffffffu;

uint me() { return gl_LocalInvocationID.x; }

shared vec3 scratch[WEFT_GROUP];

vec3 largest_of_group(vec3 x)
{
    barrier();
    scratch[me()] = x;
    for (uint half_size = WEFT_GROUP / 2; half_size > 0u; half_size /= 2u) {
        barrier();
        if (me() < half_size) scratch[me()] = max(scratch[me()], scratch[me() + half_size]);
    }
    barrier();
    return scratch[0];
}
vec3 sum_of_group(vec3 x)
{
    barrier();
    scratch[me()] = x;
    for (uint half_size = WEFT_GROUP / 2; half_size > 0u; half_size /= 2u) {
        barrier();
        if (me() < half_size) scratch[me()] += scratch[me() + half_size];
    }
    barrier();
    return scratch[0];
}

#ifdef WEFT_TRACKS

uint vertex_at(uint tile, uint i) { return WEFT_TILE_VERTICES * tile + i; }

// Where the particle goes in this substep.
vec3 goal_of(uint p)
{
    return args.search == WEFT_SEARCH_MOTION ? contact.position.at[p].xyz : contact.asked.at[p].xyz;
}

// The trajectory follows the velocity rather than the motion of this tick, and runs midway between the two ends: at
// rest the constraints pull a pile together by the same amount in every tick and contact pushes it back, which is no
// motion. In the second search it covers all places between the two ends, for this tick only. Every thread has at most
// one vertex.
void follow(uint tile, uint tick)
{
    uint count = contact.tiles.at[tile].vertices, i = me();
    bool mine = i < count, anywhere = args.search == WEFT_SEARCH_ANYWHERE;
    uint p = contact.particles.at[vertex_at(tile, mine ? i : 0u)];
    vec3 from = contact.start.at[p].xyz, moved = goal_of(p) - from, v = contact.velocity.at[p].xyz * contact.frame.at.h;
    vec3 most = largest_of_group(mine ? vec3(length(moved - v), length(v), length(moved)) : vec3(0.0));
    bool along_velocity = !anywhere && most.x < follows_velocity * slack_now(tile);
    bool moving = !along_velocity || most.y > resting * slack_now(tile);
    float around = anywhere ? 0.5 * length(moved) : 0.0;
    if (anywhere || !moving) v = vec3(0.0);
    else if (!along_velocity) v = moved;
    vec3 mean = sum_of_group(mine ? v : vec3(0.0)) / float(count);
    float spread = largest_of_group(mine ? vec3(length(v - mean)) : vec3(0.0)).x;
    if (mine) {
        contact.places.at[vertex_at(tile, i)] = vec4(from + (moved - v) * 0.5, around);
        contact.velocities.at[vertex_at(tile, i)] = vec4(v, 0.0);
    }
    if (me() > 0u) return;
    // A list that outlived its purpose is followed by a longer one, one that failed early by a shorter one.
    uint listed = contact.tracked.at[tile].listed, lifetime = contact.tracked.at[tile].lifetime;
    uint age = tick - listed, adapted = max(1u, age >= lifetime ? age + 2u : age);
    lifetime = listed == 0u ? 4u : moving ? min(longest_lifetime, adapted) : longest_lifetime;
    float ticks = most_spread * slack_now(tile) / (spread + 1e-9);
    if (ticks < float(lifetime)) lifetime = max(1u, uint(ticks));
    if (anywhere) lifetime = 1u;
    contact.tracked.at[tile].listed = tick;
    contact.tracked.at[tile].lifetime = lifetime;
    contact.tracked.at[tile].until = moving ? tick + lifetime : never;
    contact.tracked.at[tile].mean = vec4(mean, slack_now(tile));
    contact.tracked.at[tile].center.w = spread;
    contact.tracked.at[tile].extent.w = slack_now(tile) + (anywhere ? 0.5 * most.z : 0.0);
}

// The box around all places of the tile's vertices while its lists last, at the start of the tick.
void bound(uint tile, uint tick)
{
    uint i = me();
    bool mine = i < contact.tiles.at[tile].vertices, moving = contact.tracked.at[tile].until != never;
    vec4 place = contact.places.at[vertex_at(tile, mine ? i : 0u)];
    vec3 v = contact.velocities.at[vertex_at(tile, mine ? i : 0u)].xyz;
    vec3 now = place.xyz + v * float(tick - contact.tracked.at[tile].listed);
    float away = place.w;
    if (moving) away += length(v - contact.tracked.at[tile].mean.xyz) * float(contact.tracked.at[tile].lifetime);
    vec3 high = largest_of_group(now + away), low = -largest_of_group(away - now);
    if (me() > 0u) return;
    contact.tracked.at[tile].center.xyz = 0.5 * (low + high);
    contact.tracked.at[tile].extent.xyz = 0.5 * (high - low);
}

// Marks the tile if its vertices have left its listed trajectory.
void run_track(uint tile)
{
    bool anywhere = args.search == WEFT_SEARCH_ANYWHERE;
    if (is_idle_search()) return;
    uint tick = head.tick, listed = contact.tracked.at[tile].listed, i = me();
    bool mine = i < contact.tiles.at[tile].vertices, stays = true;
    vec3 strays = vec3(0.0);
    if (mine) {
        uint p = contact.particles.at[vertex_at(tile, i)];
        vec4 place = contact.places.at[vertex_at(tile, i)];
        vec3 v = contact.velocities.at[vertex_at(tile, i)].xyz, start = contact.start.at[p].xyz, goal = goal_of(p);
        float since = float(tick - listed);
        vec3 now = place.xyz + v * since, then = now + v;
        float at_start = length(start - (anywhere ? then : now)) - place.w, at_end = length(goal - then) - place.w;
        // Pushes may move the particles from where the constraints left them.
        float slack = slack_when_listed(tile), most = anywhere ? slack : slack - cap_of_tile(tile);
        stays = at_start <= slack && at_end <= most;
        strays = vec3(max(at_start, at_end));
        if (!anywhere && i < contact.tiles.at[tile].own_vertices) {
            contact.reached.at[p] = contact.position.at[p];
            contact.part.at[p] = floatBitsToUint(1.0);
        }
    }
    bool expired = listed == 0u || contact.tracked.at[tile].until <= tick || contact.search_always == 1u;
    bool outdated = expired || largest_of_group(stays ? vec3(0.0) : vec3(1.0)).x > 0.0;
    float stray = largest_of_group(strays).x;
    if (me() == 0u) {
        contact.tracked.at[tile].outdated = outdated ? 1u : 0u;
        contact.tracked.at[tile].extent.w = stray;
        if (outdated) head.outdated = 1u;
    }
    if (outdated) follow(tile, tick);
    workgroup_barrier();
    bound(tile, tick);
}

// Sets head.uncovered if a particle was sent back and may have been beyond what its list covers, on any part of its way.
void run_check(uint tile)
{
    uint i = me();
    if (i >= contact.tiles.at[tile].vertices) return;
    uint p = contact.particles.at[vertex_at(tile, i)];
    vec4 place = contact.places.at[vertex_at(tile, i)];
    float ticks = float(head.tick + 1u - contact.tracked.at[tile].listed);
    vec3 then = place.xyz + contact.velocities.at[vertex_at(tile, i)].xyz * ticks;
    bool back = contact.retreats.at[p] > 0u || is_carried(p);
    vec3 farthest = contact.position.at[p].xyz;
    if (back) farthest = base_of(p);
    float slack = slack_when_listed(tile), most = back ? slack - contact.most_aside * own_cap_of_tile(tile) : slack;
    if (!(length(farthest - then) - place.w <= most)) head.uncovered = 1u;
}

#else

// The way of a tile's box while a list can last.
void way_of(uint tile, out vec3 low, out vec3 high)
{
    vec3 center = contact.tracked.at[tile].center.xyz, extent = contact.tracked.at[tile].extent.xyz;
    vec3 last = center + contact.tracked.at[tile].mean.xyz * float(longest_lifetime);
    low = min(center, last) - extent;
    high = max(center, last) + extent;
}

// The box around the ways of a group of tiles.
void run_bound_group(uint group)
{
    if (is_idle_search() || (args.search == WEFT_SEARCH_MOTION && head.outdated == 0u)) return;
    vec3 low = vec3(1e30), high = vec3(-1e30);
    uint tile = group * WEFT_TILES_TOGETHER + me();
    if (me() < WEFT_TILES_TOGETHER && tile < contact.tile_count) {
        vec3 own_low, own_high;
        way_of(tile, own_low, own_high);
        // A box that is not a number is near nothing.
        if (all(lessThan(abs(own_low), vec3(1e30))) && all(lessThan(abs(own_high), vec3(1e30))))
            low = own_low, high = own_high;
    }
    high = largest_of_group(high);
    low = -largest_of_group(-low);
    if (me() > 0u) return;
    contact.groups.at[2u * group] = vec4(low, 0.0);
    contact.groups.at[2u * group + 1u] = vec4(high, 0.0);
}

bool are_near(uint a, uint b, float apart)
{
    vec3 shift = (contact.tracked.at[b].mean.xyz - contact.tracked.at[a].mean.xyz) * (0.5 * float(longest_lifetime));
    vec3 away = abs(contact.tracked.at[a].center.xyz - contact.tracked.at[b].center.xyz - shift);
    vec3 most = contact.tracked.at[a].extent.xyz + contact.tracked.at[b].extent.xyz + abs(shift) + apart;
    return all(lessThanEqual(away, most));
}

shared uint meets[WEFT_GROUP];

bool can_meet(uint a, uint b)
{
    if ((contact.tiles.at[a].kind & contact.tiles.at[b].kind & WEFT_TILE_OF_SURFACE) != 0u) return false;
    if (contact.tiles.at[a].cloth == contact.tiles.at[b].cloth) return true;
    return (contact.tiles.at[a].groups & contact.tiles.at[b].collides_with) != 0u &&
           (contact.tiles.at[b].groups & contact.tiles.at[a].collides_with) != 0u;
}

// Appends the pairs of an outdated tile and every tile that may come near it.
void run_pair_tiles(uint a)
{
    if (is_idle_search() || contact.tracked.at[a].outdated == 0u) return;
    vec3 low, high;
    way_of(a, low, high);
    float thickest = 0.5 * (contact.tiles.at[a].thickness + contact.thickest);
    float apart = thickest + slack_when_listed(a) + contact.most_slack + contact.frame.at.surface_motion;
    for (uint first = 0u; first < contact.group_count; first += WEFT_GROUP) {
        uint group = first + me();
        meets[me()] = 0u;
        if (group < contact.group_count &&
            all(lessThanEqual(low - apart, contact.groups.at[2u * group + 1u].xyz)) &&
            all(lessThanEqual(contact.groups.at[2u * group].xyz, high + apart)))
            meets[me()] = 1u;
        barrier();
        for (uint k = 0u; k < min(WEFT_GROUP, contact.group_count - first); ++k) {
            if (meets[k] == 0u) continue;
            uint b = (first + k) * WEFT_TILES_TOGETHER + me();
            if (me() >= WEFT_TILES_TOGETHER || b >= contact.tile_count) continue;
            if (b < a && contact.tracked.at[b].outdated == 1u) continue;
            float less = 0.5 * (contact.thickest - contact.tiles.at[b].thickness);
            if (!can_meet(a, b) || !are_near(a, b, apart - less)) continue;
            uint at = atomicAdd(head.tile_pairs, 1u);
            if (at >= contact.tile_pair_capacity) continue;
            contact.tile_pairs.at[2u * at] = min(a, b);
            contact.tile_pairs.at[2u * at + 1u] = max(a, b);
        }
        barrier();
    }
}

#endif

void main()
{
    if (group_index() < WEFT_GROUPS) WEFT_PASS(group_index());
}
