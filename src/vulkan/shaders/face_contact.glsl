// Contact of the cloth's faces with the colliders near their tiles (face.kernel.h). A face and a collider of its tile have
// a place of their own for a contact, so that results do not depend on the order of invocations.
#ifndef WEFT_FACE_CONTACT_GLSL
#define WEFT_FACE_CONTACT_GLSL

#include "vulkan/shaders/contact.glsl"
#include "vulkan/shaders/sums_of_bodies.glsl"

uint face_substep() { return face_contact_args.at.substep + substeps_before; }
bool meets_bodies() { return !is_none(uvec2(face_contact_args.at.colliders.at.bodies)); }
bool logs_faces() { return !is_none(uvec2(face_contact_args.at.contact_log)); }

// A face by its number in the order of tiles.
uvec3 corners_of_face(uint f)
{
    uint stride = face_contact_args.at.stride;
    return uvec3(face_contact_args.at.faces.at[f], face_contact_args.at.faces.at[stride + f],
                 face_contact_args.at.faces.at[2u * stride + f]);
}
uint tile_of_face(uvec3 corner) { return min(corner.x, min(corner.y, corner.z)) / WEFT_COLLIDER_TILE; }
uint first_face_of(uint tile) { return face_contact_args.at.faces.at[3u * face_contact_args.at.stride + tile]; }
// Of a triangle, or 0xffffffff for one that has been removed.
uint face_of_triangle(uint t)
{
    uint tiles = (face_contact_args.at.particles + WEFT_COLLIDER_TILE - 1u) / WEFT_COLLIDER_TILE;
    return face_contact_args.at.faces.at[3u * face_contact_args.at.stride + tiles + 1u + t];
}

// Blocks per place: weights of the first two corners and friction; normal and offset; start and the gap there; ContactSum;
// displacement by the sweep before, and whether there is a contact: 0 none, 1 a slow one, 2 one on the way; gaps of the
// corners at the start; with a log, the lever.
uint blocks_of_contact() { return logs_faces() ? WEFT_FACE_CONTACT_BLOCKS + 1u : WEFT_FACE_CONTACT_BLOCKS; }
uint place_of_contact(uint slot, uint f, uint tile)
{
    return blocks_of_contact() * (slot * face_contact_args.at.faces_per_tile + f - first_face_of(tile));
}
float state_of_contact(uint place) { return face_contact_args.at.contacts.at[place + 4u].w; }

void store_contact(uint place, FaceRow row)
{
    face_contact_args.at.contacts.at[place] =
        vec4(row.weights.xy, row.static_friction, row.kinetic_friction);
    face_contact_args.at.contacts.at[place + 1u] = vec4(row.normal, row.offset);
    face_contact_args.at.contacts.at[place + 2u] = vec4(row.start, row.gap_at_start);
    face_contact_args.at.contacts.at[place + 3u] = vec4(0.0);
    face_contact_args.at.contacts.at[place + 4u] = vec4(vec3(0.0), row.swept > 0.0 ? 2.0 : 1.0);
    face_contact_args.at.contacts.at[place + 5u] = vec4(row.corner_gaps, 0.0);
    if (logs_faces()) face_contact_args.at.contacts.at[place + 6u] = vec4(row.lever, 0.0);
}
FaceRow load_contact(uint place)
{
    vec4 packed = face_contact_args.at.contacts.at[place], plane = face_contact_args.at.contacts.at[place + 1u],
         start = face_contact_args.at.contacts.at[place + 2u];
    FaceRow row;
    row.weights = vec3(packed.xy, 1.0 - packed.x - packed.y);
    row.static_friction = packed.z;
    row.kinetic_friction = packed.w;
    row.normal = plane.xyz;
    row.offset = plane.w;
    row.start = start.xyz;
    row.gap_at_start = start.w;
    row.depenetration = face_contact_args.at.frame.at.depenetration;
    row.swept = state_of_contact(place) > 1.0 ? 1.0 : 0.0;
    return row;
}

struct FacePoints {
    Corners x, start;
    vec3 w;  // inverse masses
};
FacePoints points_of_face(uvec3 corner)
{
    vec4 a = load_point(face_contact_args.at.position, corner.x), b = load_point(face_contact_args.at.position, corner.y),
         c = load_point(face_contact_args.at.position, corner.z);
    FacePoints face;
    face.x = Corners(a.xyz, b.xyz, c.xyz);
    face.start = Corners(face_contact_args.at.start.at[corner.x].xyz, face_contact_args.at.start.at[corner.y].xyz,
                         face_contact_args.at.start.at[corner.z].xyz);
    face.w = vec3(a.w, b.w, c.w);
    return face;
}

bool reaches(ColliderIn collider)
{
    return cloth_reaches_faces(face_contact_args.at.frame, collider.roundness);
}
bool is_moved_by_cloth(ColliderIn collider)
{
    return is_body(collider) && feels_cloth(face_contact_args.at.colliders.at.bodies, collider.body);
}

// Returns a contact that does not touch if the face is far away.
//   nearest  m: a face that comes no nearer than this touches only on its way
//   deepest  m: of face_contact()
FaceContact contact_of(ColliderIn collider, ContactBody body, FacePoints face, float nearest, float deepest)
{
    Solid solid = solid_of(collider);
    Corners local = to_body(body, face.x), local_at_start = to_body_at_start(body, face.start);
    FacePoint center = face_point(solid, local, center_weights());
    FaceContact none = FaceContact(false, false, false, center.weights, center.normal, vec3(0.0), 0.0, 0.0, 1.0, 0.0);
    if (!face_may_touch(local_at_start, local, center, solid, nearest)) return none;
    return face_contact(solid, local_at_start, local, center, nearest_of_faces(body.half_thickness), body.half_thickness,
                        deepest);
}

// Words after the sums: whether faces may pass a collider after the pushes; the lengths of two lists of held particles;
// the longest edge in the frame, if it is longer than usual; whether faces may have passed anything in the frame; the
// lists.
uint fast_word() { return WEFT_FACE_SUM * face_contact_args.at.particles; }
uint length_of_held(uint list) { return fast_word() + 1u + list; }
uint longest_edge_word() { return fast_word() + WEFT_LONGEST_EDGE_WORD; }
uint met_fast_word() { return fast_word() + WEFT_LONGEST_EDGE_WORD + 1u; }
uint first_held(uint list) { return fast_word() + WEFT_FACE_WORDS + list * face_contact_args.at.particles; }

// Marks of a particle (WEFT_NEAR_FACES of contact.glsl, WEFT_RETRY_FACES).
uint marks_of(uint p) { return face_contact_args.at.sums.at[WEFT_FACE_SUM * p + 5u]; }
bool any_marked(uvec3 corner, uint mark)
{
    return ((marks_of(corner.x) | marks_of(corner.y) | marks_of(corner.z)) & mark) != 0u;
}
void mark_to_retry(uint p) { atomicOr(face_contact_args.at.sums.at[WEFT_FACE_SUM * p + 5u], WEFT_RETRY_FACES); }

// In the first substep of a frame, and after one in which cloth met something fast.
void run_longest_edge(uint f)
{
    if (face_substep() > 0u && face_contact_args.at.sums.at[met_fast_word()] == 0u) return;
    FacePoints face = points_of_face(corners_of_face(f));
    float longest = max(longest_edge(face.x), longest_edge(face.start));
    if (longest > face_contact_args.at.frame.at.widest_face)
        atomicMax(face_contact_args.at.sums.at[longest_edge_word()], floatBitsToUint(longest));
}

void run_find_faces(uint f)
{
    uvec3 corner = corners_of_face(f);
    uint tile = tile_of_face(corner);
    uvec2 slots = slots_near(face_contact_args.at.tiles, tile * WEFT_COLLIDER_TILE);
    for (uint slot = slots.x; slot < slots.y; ++slot)
        face_contact_args.at.contacts.at[place_of_contact(slot, f, tile) + 4u].w = 0.0;
    if (!any_marked(corner, WEFT_NEAR_FACES)) return;
    FacePoints face = points_of_face(corner);
    float half_thickness = half_thickness_of_face(face_contact_args.at.frame, corner);
    for (uint slot = slots.x; slot < slots.y; ++slot) {
        uint place = place_of_contact(slot, f, tile);
        ColliderIn collider = face_contact_args.at.colliders.at.colliders.at[face_contact_args.at.slots.at[slot]];
        if (!reaches(collider)) continue;
        ContactBody body = body_of(face_contact_args.at.colliders, collider, face_contact_args.at.frame, face_substep(),
                                   half_thickness);
        FaceContact contact = contact_of(collider, body, face, nearest_of_faces(half_thickness), -body.half_thickness);
        bool moved = is_moved_by_cloth(collider), fast = is_fast(contact, moved);
        if (fast) atomicOr(face_contact_args.at.sums.at[fast_word()], 1u);
        if (fast && contact.touches) {
            mark_to_retry(corner.x);
            mark_to_retry(corner.y);
            mark_to_retry(corner.z);
        }
        if (!touches_beside_corners(contact)) continue;
        store_contact(place, face_row(body, contact, face.x, face.start, to_body(body, face.x)));
        if (moved) add_touch(face_contact_args.at.colliders.at.bodies, collider.body);
    }
}

void add_to_faces(uint particle, vec3 push)
{
    float size2 = dot(push, push);
    if (!is_push(size2)) return;
    for (uint axis = 0u; axis < 3u; ++axis)
        atomicAdd(face_contact_args.at.sums.at[WEFT_FACE_SUM * particle + axis],
                  uint(int(to_contact_quanta(push[axis], WEFT_PUSH_QUANTA_PER_METER))));
    uint size = uint(int(to_contact_quanta(sqrt(size2), WEFT_PUSH_QUANTA_PER_METER))) + 1u;
    atomicMax(face_contact_args.at.sums.at[WEFT_FACE_SUM * particle + 3u], size);
}

ColliderIn collider_of_slot(uint slot)
{
    return face_contact_args.at.colliders.at.colliders.at[face_contact_args.at.slots.at[slot]];
}

// How far a body has moved its point that was at `point` when the contacts were found.
vec3 carried_since_found(uint body, vec3 point)
{
    PoseIn found = pose_of_body(face_contact_args.at.colliders.at.bodies, body, WEFT_BODY_FOUND);
    PoseIn now = pose_of_body(face_contact_args.at.colliders.at.bodies, body, WEFT_BODY_NOW);
    vec3 local = unrotate(found.x.xyz, found.y.xyz, found.z.xyz, point - found.position.xyz);
    return (rotate(now.x.xyz, now.y.xyz, now.z.xyz, local) + now.position.xyz) - point;
}

void run_push_faces(uint f)
{
    uvec3 corner = corners_of_face(f);
    uint tile = tile_of_face(corner);
    uvec2 slots = slots_near(face_contact_args.at.tiles, tile * WEFT_COLLIDER_TILE);
    for (uint slot = slots.x; slot < slots.y; ++slot) {
        uint place = place_of_contact(slot, f, tile);
        float state = state_of_contact(place);
        if (!(state > 0.0)) continue;
        FacePoints face = points_of_face(corner);
        FaceRow row = load_contact(place);
        vec3 point = point_of(face.x, row.weights);
        vec3 a, b, c, by;
        if (face_contact_args.at.sweep == WEFT_FACE_SWEEPS) {
            vec3 gaps = face_contact_args.at.contacts.at[place + 5u].xyz;
            float nearest = nearest_of_faces(half_thickness_of_face(face_contact_args.at.frame, corner));
            by = vec3(face_retreat(row, point, face.x.a, gaps.x, nearest),
                      face_retreat(row, point, face.x.b, gaps.y, nearest),
                      face_retreat(row, point, face.x.c, gaps.z, nearest));
            a = row.normal * by.x;
            b = row.normal * by.y;
            c = row.normal * by.z;
        } else {
            float inverse_mass = 0.0;
            for (uint k = 0u; k < 3u; ++k) inverse_mass = inverse_mass + face.w[k] * row.weights[k] * row.weights[k];
            vec4 kept = face_contact_args.at.contacts.at[place + 3u];
            ContactSum sum = ContactSum(kept.xyz, kept.w);
            ColliderIn collider = collider_of_slot(slot);
            if (is_moved_by_cloth(collider)) {
                by = face_displacement_of_body(row, point, inverse_mass, sum, carried_since_found(collider.body, point),
                                               moved_body(face_contact_args.at.colliders.at.bodies, collider.body));
            } else {
                by = face_displacement(row, point, inverse_mass, sum);
            }
            face_contact_args.at.contacts.at[place + 3u] = vec4(sum.friction, sum.push);
            a = by * (face.w.x * row.weights.x);
            b = by * (face.w.y * row.weights.y);
            c = by * (face.w.z * row.weights.z);
        }
        face_contact_args.at.contacts.at[place + 4u] = vec4(by, state);
        if (face.w.x > 0.0) add_to_faces(corner.x, a);
        if (face.w.y > 0.0) add_to_faces(corner.y, b);
        if (face.w.z > 0.0) add_to_faces(corner.z, c);
    }
}

// Adds to the log of a particle and a collider.
void log_push(uint p, uint collider, vec3 by, vec3 lever)
{
    uvec2 slots = slots_near(face_contact_args.at.tiles, p);
    uint turned = face_contact_args.at.capacity * WEFT_COLLIDER_TILE;
    for (uint slot = slots.x; slot < slots.y; ++slot) {
        if (face_contact_args.at.slots.at[slot] != collider) continue;
        uint at = place_in_slot(slot, p);
        face_contact_args.at.contact_log.at[at].xyz = face_contact_args.at.contact_log.at[at].xyz + by;
        face_contact_args.at.contact_log.at[turned + at].xyz =
            face_contact_args.at.contact_log.at[turned + at].xyz + cross(lever, by);
        return;
    }
}

// What the collider did to a particle that is at `x`: adds it to the log, and the opposite to the collider if it is a body.
void note_push(uint p, uint collider, vec3 by, vec3 lever, vec4 x)
{
    if (logs_faces()) log_push(p, collider, by * heavier(face_contact_args.at.frame, p, x.w), lever);
    ColliderIn of = face_contact_args.at.colliders.at.colliders.at[collider];
    if (is_moved_by_cloth(of))
        add_to_body(face_contact_args.at.colliders.at.bodies, of.body, by, x.xyz + by, x.w);
}

// The particle's next face after `f`, by number, or 0xffffffff.
uint next_face_of(uint p, uint f)
{
    uint next = 0xffffffffu, end = face_contact_args.at.offsets.at[p + 1u];
    for (uint k = face_contact_args.at.offsets.at[p]; k < end; ++k) {
        uint other = face_of_triangle(face_contact_args.at.items.at[k]);
        if (other > f || f == 0xffffffffu) next = min(next, other);
    }
    return next;
}

// What the contacts of the particle's faces do to it, one after another, in the order of faces.
void note_pushes(uint p, float share, vec4 x)
{
    bool last = face_contact_args.at.sweep == WEFT_FACE_SWEEPS;
    for (uint f = next_face_of(p, 0xffffffffu); f != 0xffffffffu; f = next_face_of(p, f)) {
        uvec3 corner = corners_of_face(f);
        uint tile = tile_of_face(corner), mine = corner.x == p ? 0u : corner.y == p ? 1u : 2u;
        uvec2 slots = slots_near(face_contact_args.at.tiles, tile * WEFT_COLLIDER_TILE);
        for (uint slot = slots.x; slot < slots.y; ++slot) {
            uint place = place_of_contact(slot, f, tile);
            if (!(state_of_contact(place) > 0.0)) continue;
            FaceRow row = load_contact(place);
            vec3 by = face_contact_args.at.contacts.at[place + 4u].xyz;
            vec3 push = last ? row.normal * by[mine] : by * row.weights[mine];
            vec3 lever = logs_faces() ? face_contact_args.at.contacts.at[place + 6u].xyz : vec3(0.0);
            note_push(p, face_contact_args.at.slots.at[slot], push * share, lever, x);
        }
    }
}

void run_move_faces(uint p)
{
    uint longest = face_contact_args.at.sums.at[WEFT_FACE_SUM * p + 3u];
    if (longest == 0u) return;
    vec4 x = load_point(face_contact_args.at.position, p);
    vec3 total = vec3(0.0);
    for (uint axis = 0u; axis < 3u; ++axis) {
        total[axis] = float(int(face_contact_args.at.sums.at[WEFT_FACE_SUM * p + axis])) * float(1.0 / WEFT_PUSH_QUANTA_PER_METER);
        face_contact_args.at.sums.at[WEFT_FACE_SUM * p + axis] = 0u;
    }
    face_contact_args.at.sums.at[WEFT_FACE_SUM * p + 3u] = 0u;
    bool last = face_contact_args.at.sweep == WEFT_FACE_SWEEPS;
    float share = face_share(float(longest) * float(1.0 / WEFT_PUSH_QUANTA_PER_METER), total);
    if (logs_faces() || meets_bodies()) note_pushes(p, last ? share : share * x.w, x);
    store_point(face_contact_args.at.position, p, vec4(x.xyz + total * share, x.w));
}

void append_held(uint list, uint p)
{
    uint at = atomicAdd(face_contact_args.at.sums.at[length_of_held(list)], 1u);
    face_contact_args.at.sums.at[first_held(list) + at] = p;
}

#define WEFT_NO_LIST 2u
void hold_corner(uint p, uint mark, uint list)
{
    uint before = atomicMax(face_contact_args.at.sums.at[WEFT_FACE_SUM * p + 4u], mark);
    if (before == 0u && list != WEFT_NO_LIST) append_held(list, p);
}

// Marks the particles of a face that has passed.
//   first  the particles go the part of their way before the touch, otherwise none
//   list   of held particles, to which they are added
void hold_face(uint f, uvec3 corner, bool first, uint list)
{
    uint tile = tile_of_face(corner);
    FacePoints face = points_of_face(corner);
    float half_thickness = half_thickness_of_face(face_contact_args.at.frame, corner);
    uvec2 slots = slots_near(face_contact_args.at.tiles, tile * WEFT_COLLIDER_TILE);
    for (uint slot = slots.x; slot < slots.y; ++slot) {
        uint number = face_contact_args.at.slots.at[slot];
        ColliderIn collider = face_contact_args.at.colliders.at.colliders.at[number];
        if (!reaches(collider) || (list != WEFT_NO_LIST && is_moved_by_cloth(collider))) continue;
        ContactBody body = body_of(face_contact_args.at.colliders, collider, face_contact_args.at.frame, face_substep(),
                                   half_thickness);
        float nearest = nearest_of_faces(half_thickness);
        FaceContact contact = contact_of(collider, body, face, 0.0, least_after_pushes(nearest));
        if (!has_passed(contact, nearest)) continue;
        uint part = first ? uint(floor(contact.time * float(WEFT_HOLD_PARTS))) : 0u;
        uint mark = (uint(WEFT_HOLD_PARTS) - part + 1u) * WEFT_HOLD_COLLIDERS + number % WEFT_HOLD_COLLIDERS;
        hold_corner(corner.x, mark, list);
        hold_corner(corner.y, mark, list);
        hold_corner(corner.z, mark, list);
    }
}

void run_hold_faces(uint f)
{
    if (face_contact_args.at.sums.at[fast_word()] == 0u) return;
    uvec3 corner = corners_of_face(f);
    if (any_marked(corner, WEFT_RETRY_FACES)) hold_face(f, corner, face_contact_args.at.sweep == 0u, WEFT_NO_LIST);
}

// Moves a particle that is held. Returns whether faces around it may pass now: not beside a body that cloth moves, because
// what it gave way to is not known here.
bool settle_face_particle(uint p)
{
    uint mark = face_contact_args.at.sums.at[WEFT_FACE_SUM * p + 4u];
    if (mark == 0u) return false;
    face_contact_args.at.sums.at[WEFT_FACE_SUM * p + 4u] = 0u;
    vec4 x = load_point(face_contact_args.at.position, p);
    if (!(x.w > 0.0)) return false;
    uint number = mark % WEFT_HOLD_COLLIDERS;
    float part = float(uint(WEFT_HOLD_PARTS) - (mark / WEFT_HOLD_COLLIDERS - 1u)) / float(WEFT_HOLD_PARTS);
    ColliderIn collider = face_contact_args.at.colliders.at.colliders.at[number];
    ContactBody body = body_of(face_contact_args.at.colliders, collider, face_contact_args.at.frame, face_substep(), 0.0);
    vec3 place = held_place(body, to_body_at_start(body, face_contact_args.at.start.at[p].xyz), to_body(body, x.xyz), part);
    if (place == x.xyz) return false;
    note_push(p, number, place - x.xyz, x.xyz - body.position, x);
    store_point(face_contact_args.at.position, p, vec4(place, x.w));
    return !is_moved_by_cloth(collider);
}

void run_settle_faces(uint p)
{
    if (!settle_face_particle(p)) return;
    mark_to_retry(p);
    if (face_contact_args.at.sweep + 1u == WEFT_FACE_HOLDS) append_held(0u, p);
}

#endif
