// Passes over near pairs.
#ifndef WEFT_CLOTH_CONTACT_PAIRS_GLSL
#define WEFT_CLOTH_CONTACT_PAIRS_GLSL

#include "vulkan/shaders/cloth_contact/contact.glsl"

// Calls visit(particle, weight) for the four particles.
#define WEFT_EACH(visit, particle, weight) \
    visit(particle.x, weight.x);           \
    visit(particle.y, weight.y);           \
    visit(particle.z, weight.z);           \
    visit(particle.w, weight.w);

// The whole vector is read: from reads of three and of the fourth component of one vector, llvmpipe 22.3 makes a wrong
// one.
vec3 place_of(uint p)
{
    vec4 x = contact.position.at[p];
    return x.xyz;
}

// How far pushes may move the particle, m.
float cap_of(uint p) { return carried_cap(own_cap_of(p)); }
float inverse_mass_of(uint p)
{
    vec4 x = contact.position.at[p];
    return x.w;
}

// A near pair as it was at the start of the substep.
struct Pair {
    uvec4 particle;
    vec4 weight;
    vec3 normal;
    float thickness;
    float gap;
    float distance;
    bool edges;
};

Pair load_pair(uint i)
{
    uint at = near_index(i);
    vec4 normal = contact.near_normals.at[at], start = contact.near_starts.at[at];
    return Pair(contact.near_particles.at[at], contact.near_weights.at[at], normal.xyz, normal.w, start.x, start.y,
                (contact.near_kinds.at[at] & WEFT_PAIR_OF_EDGES) != 0u);
}

bool pair_comes_near(Pair pair)
{
    uvec4 p = pair.particle;
    vec3 x0 = contact.start.at[p.x].xyz, x1 = contact.start.at[p.y].xyz;
    vec3 x2 = contact.start.at[p.z].xyz, x3 = contact.start.at[p.w].xyz;
    return comes_near(pair.edges, x0, x1, x2, x3, place_of(p.x) - x0, place_of(p.y) - x1, place_of(p.z) - x2,
                      place_of(p.w) - x3, pair.distance, pair.thickness);
}

// The particles' coordinates along the normal, relative to the first of them.
vec4 coordinates(Pair pair)
{
    vec3 first = place_of(pair.particle.x);
    return vec4(0.0, dot(place_of(pair.particle.y) - first, pair.normal),
                dot(place_of(pair.particle.z) - first, pair.normal),
                dot(place_of(pair.particle.w) - first, pair.normal));
}

float gap_along(Pair pair, vec4 along)
{
    return pair.edges ? gap_edge_edge(along.x, along.y, along.z, along.w)
                      : gap_vertex_triangle(along.x, along.y, along.z, along.w);
}

// Whether the pair loses its gap, and `depth` m more.
bool loses(Pair pair, vec4 along, float depth)
{
    return loses_gap(gap_along(pair, along) + depth, pair.gap, pair.thickness * contact.gap_floor) &&
           pair_comes_near(pair);
}

// Where the limit would have to act, more sweeps follow the last round. Number of such a sweep.
bool is_extra() { return args.round >= WEFT_CONTACT_ROUNDS; }
uint extra() { return args.round - WEFT_CONTACT_ROUNDS; }

void add_share(uint p, float weight) { atomicAdd(contact.share.at[p], uint(to_weight_quanta(weight))); }

void run_overlaps(uint i)
{
    if (is_extra() && extra() > 0u && head.lost[extra() - 1u] == 0u) return;
    if (i >= near_count()) return;
    Pair pair = load_pair(i);
    vec4 along = coordinates(pair), weight = pair.weight;
    if (is_extra() && loses(pair, along, 0.0)) head.lost[extra()] = 1u;
    float gap = weight.y * along.y + weight.z * along.z + weight.w * along.w;
    float overlap =
        cloth_overlap(gap, pair.distance, pair.thickness, contact.recovery_speed * contact.frame.at.h);
    bool pushes = overlap < 0.0 && (!pair.edges || closest_inside_edges(weight.x, weight.y, weight.z, weight.w)) &&
                  pair_comes_near(pair);
    contact.near_pushes.at[near_index(i)] = vec4(0.0, 0.0, 0.0, pushes ? -overlap : 0.0);
    if (!pushes) return;
    WEFT_EACH(add_share, pair.particle, weight)
}

bool is_skipped() { return is_extra() && head.lost[extra()] == 0u; }

// Mass splitting: see ClothContact::find_pushes() of the CPU backend.
void run_pushes(uint i)
{
    if (is_skipped() || i >= near_count()) return;
    uint at = near_index(i);
    vec4 old = contact.near_pushes.at[at];
    float depth = old.w;
    if (!(depth > 0.0)) return;
    contact.near_kinds.at[at] |= WEFT_PAIR_PUSHED;
    if (args.round + 1u == WEFT_CONTACT_ROUNDS) atomicAdd(head.contacts, 1u);
    uvec4 particle = contact.near_particles.at[at];
    vec4 weight = contact.near_weights.at[at], start = contact.near_starts.at[at];
    vec3 n = contact.near_normals.at[at].xyz, moved = vec3(0.0);
    float resistance = 0.0;
    vec4 x;
#define WEFT_ADD(p, weight)                                         \
    x = contact.position.at[p];                                     \
    moved = moved + (x.xyz - contact.start.at[p].xyz) * (weight);   \
    resistance += contact_resistance(x.w, weight, share_of(p) * contact.split)
    WEFT_EACH(WEFT_ADD, particle, weight)
#undef WEFT_ADD
    vec3 push = vec3(0.0);
    if (resistance > 1e-12) {
        vec3 rub = cloth_friction(moved, n, depth, start.z, start.w);
        push = (n * depth - rub) * (1.0 / resistance);
    }
    contact.near_pushes.at[at] = vec4(push, depth);
#define WEFT_ADD(p, weight) \
    add_to(contact.sums, p, push * ((weight) * inverse_mass_of(p)), WEFT_PUSH_QUANTA_PER_METER)
    WEFT_EACH(WEFT_ADD, particle, weight)
#undef WEFT_ADD
}

// Pairs that push alike would open too far.
void run_scale(uint i)
{
    if (is_skipped() || i >= near_count()) return;
    uint at = near_index(i);
    vec4 pushed = contact.near_pushes.at[at];
    vec3 push = pushed.xyz;
    float depth = pushed.w;
    if (!(depth > 0.0)) return;
    uvec4 particle = contact.near_particles.at[at];
    vec4 weight = contact.near_weights.at[at];
    vec3 n = contact.near_normals.at[at].xyz;
    float opened = 0.0;
#define WEFT_ADD(p, weight)                                                  \
    sum = sum_of(contact.sums, p, WEFT_PUSH_QUANTA_PER_METER);               \
    opened += (weight) * (n.x * sum.x + n.y * sum.y + n.z * sum.z)
    vec3 sum;
    WEFT_EACH(WEFT_ADD, particle, weight)
#undef WEFT_ADD
    if (opened > depth) push = push * (depth / opened);
#define WEFT_ADD(p, weight) \
    add_to(contact.scaled_sums, p, push * ((weight) * inverse_mass_of(p)), WEFT_PUSH_QUANTA_PER_METER)
    WEFT_EACH(WEFT_ADD, particle, weight)
#undef WEFT_ADD
}

// --- Brake and limit ---

uint slot(uint round) { return args.search * WEFT_LIMIT_ROUNDS + round; }
bool is_idle() { return args.search == WEFT_SEARCH_ANYWHERE && head.uncovered == 0u; }

void slow(uint p, float part) { atomicMin(contact.part.at[p], floatBitsToUint(part)); }

// Slows pairs that lose their gap by more than contact can take back.
void run_find_deep(uint i)
{
    if (i >= near_count()) return;
    Pair pair = load_pair(i);
    vec4 along = coordinates(pair);
    float depth = contact.brake_depth * min(cap_of(pair.particle.x), cap_of(pair.particle.w));  // of both sides
    if (!loses(pair, along, depth)) return;
    float part = part_to_depth(gap_along(pair, along), pair.gap, pair.thickness * contact.gap_floor, depth);
    slow(pair.particle.x, part);
    slow(pair.particle.y, part);
    slow(pair.particle.z, part);
    slow(pair.particle.w, part);
    head.brakes = 1u;
}

float motion_of(uint p, vec3 n) { return dot(place_of(p) - contact.start.at[p].xyz, n); }

LeastMotions least_motions(Pair pair)
{
    uvec4 p = pair.particle;
    vec3 n = pair.normal;
    float m0 = motion_of(p.x, n), m1 = motion_of(p.y, n), m2 = motion_of(p.z, n), m3 = motion_of(p.w, n);
    float w0 = inverse_mass_of(p.x), w1 = inverse_mass_of(p.y), w2 = inverse_mass_of(p.z), w3 = inverse_mass_of(p.w);
    float spare = pair.gap - min(pair.gap, pair.thickness * contact.gap_floor);
    if (pair.edges) return least_motions_edge_edge(m0, m1, m2, m3, w0, w1, w2, w3, spare);
    return least_motions_vertex_triangle(m0, m1, m2, m3, w0, w1, w2, w3, spare);
}

vec3 slide_of(uint p)
{
    if (contact.retreats.at[p] == 0u) return contact.asked.at[p].xyz - base_of(p);
    vec4 slide = contact.slide.at[p];
    return slide.xyz;
}

// Asks a particle to go back: if it comes closer to the other side than it may, or anyway. Returns whether it can.
// `away`: unit, away from the other side; `least`: how far it has to move along it, m.
bool retreat(uint p, vec3 away, float least, bool anyway)
{
    uint retreats = contact.retreats.at[p];
    if (retreats == WEFT_MOST_RETREATS || !(inverse_mass_of(p) > 0.0)) return false;
    if (retreats < WEFT_LIMIT_SLIDES) {
        float missing = least - dot(slide_of(p) + (base_of(p) - contact.start.at[p].xyz), away);
        if (!(missing > 0.0) && !anyway) return false;
        add_to(contact.sums, p, away * max(missing, 0.0), WEFT_PUSH_QUANTA_PER_METER);
        atomicAdd(contact.share.at[p], 1u);
    }
    contact.marks.at[p] = 1u;
    return true;
}

bool retreat_all(Pair pair, LeastMotions least, bool anyway)
{
    vec3 n = pair.normal;
    bool helps = retreat(pair.particle.x, n, least.one, anyway);
    helps = retreat(pair.particle.y, pair.edges ? n : -n, pair.edges ? least.one : least.two, anyway) || helps;
    helps = retreat(pair.particle.z, -n, least.two, anyway) || helps;
    helps = retreat(pair.particle.w, -n, least.two, anyway) || helps;
    return helps;
}

void record_mark(uvec4 particle, uint mark)
{
    atomicOr(contact.contact_marks.at[particle.x], mark);
    atomicOr(contact.contact_marks.at[particle.y], mark);
    atomicOr(contact.contact_marks.at[particle.z], mark);
    atomicOr(contact.contact_marks.at[particle.w], mark);
}

// The particle, or the largest number for one of a collider's surface.
uint of_cloth(uint p) { return of_surface(p) ? 0xffffffffu : p; }

bool of_moving_surface(uint p) { return contact.carrier.at[p] > 0u && of_surface(p); }
bool touches_moving_surface(uvec4 p)
{
    return of_moving_surface(p.x) || of_moving_surface(p.y) || of_moving_surface(p.z) || of_moving_surface(p.w);
}
uint carrier_of(uvec4 p)
{
    return max(max(contact.carrier.at[p.x], contact.carrier.at[p.y]),
               max(contact.carrier.at[p.z], contact.carrier.at[p.w]));
}
bool moves_with(uint p, uint carrier)
{
    return contact.carrier.at[p] == carrier && (of_surface(p) || contact.retreats.at[p] == WEFT_MOST_RETREATS);
}
// Whether all particles of the pair move with the same surface.
bool all_carried(uvec4 p)
{
    uint carrier = carrier_of(p);
    return carrier > 0u && moves_with(p.x, carrier) && moves_with(p.y, carrier) && moves_with(p.z, carrier) &&
           moves_with(p.w, carrier);
}
bool carry_one(uint p, uint carrier)
{
    if (contact.carrier.at[p] > 0u || !(inverse_mass_of(p) > 0.0)) return false;
    float most = cap_of(p) - contact.carry_margin * own_cap_of(p);
    vec3 by = carried_place(p, carrier) - contact.start.at[p].xyz;
    if (!(dot(by, by) <= most * most)) return false;
    atomicMax(contact.next_carrier.at[p], carrier);
    contact.marks.at[p] = 1u;
    return true;
}
bool carry(uvec4 p)
{
    uint carrier = carrier_of(p);
    if (carrier == 0u) return false;
    bool helps = carry_one(p.x, carrier);
    helps = carry_one(p.y, carrier) || helps;
    helps = carry_one(p.z, carrier) || helps;
    return carry_one(p.w, carrier) || helps;
}

// Marks the particles of a pair that has lost its gap. Returns 0 if the pair has its gap, 1 if it sends particles back,
// 2 if none of them can go back any further.
uint mark_lost(uint i)
{
    Pair pair = load_pair(i);
    if (!loses(pair, coordinates(pair), 0.0)) return 0u;
    uvec4 p = pair.particle;
    if (all_carried(p)) return 0u;
    if (touches_moving_surface(p) && carry(p)) return 1u;
    LeastMotions least = least_motions(pair);
    bool helps = retreat_all(pair, least, false) || retreat_all(pair, least, true) || carry(p);
    if (!helps) {
        atomicMin(head.tangled_particle, min(min(of_cloth(p.x), of_cloth(p.y)), min(of_cloth(p.z), of_cloth(p.w))));
        if (contact.records_marks == 1u) record_mark(p, WEFT_MARK_TANGLED);
    }
    return helps ? 1u : 2u;
}

void run_find_lost(uint i)
{
    if (is_idle() || (args.round > 0u && head.sent_back[slot(args.round - 1u)] == 0u)) return;
    if (i >= near_count()) return;
    uint found = mark_lost(i);
    if (found == 1u) head.sent_back[slot(args.round)] = 1u;
    if (found == 2u) atomicAdd(head.stuck[slot(args.round)], 1u);
}

// See ClothContact::set_back() of the CPU backend.
void send_back(uint p)
{
    if (contact.marks.at[p] == 0u) return;
    contact.marks.at[p] = 0u;
    if (contact.next_carrier.at[p] > 0u) {
        contact.carrier.at[p] = contact.next_carrier.at[p];
        contact.next_carrier.at[p] = 0u;
        contact.retreats.at[p] = 0u;
        contact.share.at[p] = 0u;
        clear_sum(contact.sums, p);
        contact.position.at[p].xyz = contact.asked.at[p].xyz;
        return;
    }
    vec3 from = base_of(p), asked = contact.asked.at[p].xyz - from, slide = slide_of(p);
    uint share = contact.share.at[p], retreats = contact.retreats.at[p] + 1u;
    if (share > 0u) {
        slide = slide + sum_of(contact.sums, p, WEFT_PUSH_QUANTA_PER_METER) * (1.0 / float(share));
        clear_sum(contact.sums, p);
        contact.share.at[p] = 0u;
    }
    contact.slide.at[p] = vec4(slide, 0.0);
    contact.retreats.at[p] = retreats;
    uint halvings = retreats > WEFT_LIMIT_SLIDES ? retreats - WEFT_LIMIT_SLIDES : 0u;
    vec3 left = slide_near(asked, slide, contact.most_aside * own_cap_of(p)) * (1.0 / float(1u << halvings));
    contact.position.at[p].xyz = retreats == WEFT_MOST_RETREATS ? from : from + left;
}

// --- Marks ---

void run_mark_touching(uint i)
{
    if (i >= near_count() || (contact.near_kinds.at[near_index(i)] & WEFT_PAIR_PUSHED) == 0u) return;
    record_mark(contact.near_particles.at[near_index(i)], WEFT_MARK_TOUCHES);
}

// --- Velocities ---

void run_share_speeds(uint i)
{
    if (i >= near_count() || (contact.near_kinds.at[near_index(i)] & WEFT_PAIR_PUSHED) == 0u) return;
    uvec4 particle = contact.near_particles.at[near_index(i)];
    vec4 weight = contact.near_weights.at[near_index(i)];
    WEFT_EACH(add_share, particle, weight)
}

// Takes the velocity with which pushed pairs separate. Masses are split in full, so that one pass never takes too much.
void run_take_speeds(uint i)
{
    if (i >= near_count() || (contact.near_kinds.at[near_index(i)] & WEFT_PAIR_PUSHED) == 0u) return;
    uvec4 particle = contact.near_particles.at[near_index(i)];
    vec4 weight = contact.near_weights.at[near_index(i)];
    vec3 n = contact.near_normals.at[near_index(i)].xyz;
    float speed = 0.0, resistance = 0.0;
    vec3 v;
#define WEFT_ADD(p, weight)                                    \
    v = contact.velocity.at[p].xyz;                            \
    speed += (weight) * (n.x * v.x + n.y * v.y + n.z * v.z);   \
    resistance += contact_resistance(inverse_mass_of(p), weight, share_of(p))
    WEFT_EACH(WEFT_ADD, particle, weight)
#undef WEFT_ADD
    if (!(speed > 0.0) || !(resistance > 1e-12)) return;
    vec3 change = n * -(speed / resistance);
#define WEFT_ADD(p, weight) \
    add_to(contact.sums, p, change * ((weight) * inverse_mass_of(p)), WEFT_SPEED_QUANTA_PER_METER)
    WEFT_EACH(WEFT_ADD, particle, weight)
#undef WEFT_ADD
}

#endif
