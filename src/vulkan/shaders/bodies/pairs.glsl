// Pairs of bodies and colliders whose boxes overlap, and their contacts (src/cpu/body_contacts.h has the same on the CPU).
#ifndef WEFT_BODY_PAIRS_GLSL
#define WEFT_BODY_PAIRS_GLSL

#include "vulkan/shaders/bodies/bodies.glsl"

shared uint found_pairs;

bool has_features(uint collider)
{
    return WEFT_BODIES.features.at[collider].points + WEFT_BODIES.features.at[collider].edges > 0u;
}
void add_pair(uint features, uint shape)
{
    if (!has_features(features) ||
        !features_meet(WEFT_BODIES.features.at[features].kind, WEFT_BODIES.features.at[shape].kind, features < shape))
        return;
    uint at = atomicAdd(found_pairs, 1u);
    if (at >= WEFT_BODIES.pair_room) return;
    WEFT_BODIES.pairs.at[2u * at] = features;
    WEFT_BODIES.pairs.at[2u * at + 1u] = shape;
}

bool boxes_overlap(vec4 low_a, vec4 high_a, vec4 low_b, vec4 high_b)
{
    return all(lessThanEqual(low_a.xyz, high_b.xyz)) && all(lessThanEqual(low_b.xyz, high_a.xyz));
}

void pair_with_bodies(uint body)
{
    uint mine = WEFT_BODY(body).collider;
    for (uint other = 0u; other < body; ++other) {
        if (!boxes_overlap(WEFT_BODY(body).reach_low, WEFT_BODY(body).reach_high, WEFT_BODY(other).reach_low,
                           WEFT_BODY(other).reach_high))
            continue;
        add_pair(mine, WEFT_BODY(other).collider);
        add_pair(WEFT_BODY(other).collider, mine);
    }
}
void pair_with_colliders(uint body)
{
    uint mine = WEFT_BODY(body).collider;
    for (uint node = 0u; node < args.colliders.at.node_count;) {
        vec4 low = args.colliders.at.nodes.at[2u * node], high = args.colliders.at.nodes.at[2u * node + 1u];
        bool inside = boxes_overlap(low, high, WEFT_BODY(body).reach_low, WEFT_BODY(body).reach_high);
        uint collider = floatBitsToUint(high.w);
        if (inside && collider != WEFT_NO_COLLIDER) {
            add_pair(mine, collider);
            add_pair(collider, mine);
        }
        node = inside ? node + 1u : floatBitsToUint(low.w);
    }
}

bool pair_less(uint a, uint b)
{
    uvec2 one = uvec2(WEFT_BODIES.pairs.at[2u * a], WEFT_BODIES.pairs.at[2u * a + 1u]);
    uvec2 other = uvec2(WEFT_BODIES.pairs.at[2u * b], WEFT_BODIES.pairs.at[2u * b + 1u]);
    return one.x < other.x || (one.x == other.x && one.y < other.y);
}
void swap_pairs(uint a, uint b)
{
    for (uint k = 0u; k < 2u; ++k) {
        uint one = WEFT_BODIES.pairs.at[2u * a + k];
        WEFT_BODIES.pairs.at[2u * a + k] = WEFT_BODIES.pairs.at[2u * b + k];
        WEFT_BODIES.pairs.at[2u * b + k] = one;
    }
}

// Bitonic sort (Batcher 1968) of a number of pairs that is a power of two.
void sort_pairs(uint size)
{
    for (uint span = 2u; span <= size; span *= 2u) {
        for (uint reach = span / 2u; reach > 0u; reach /= 2u) {
            for (uint i = me(); i < size / 2u; i += WEFT_BODY_GROUP) {
                uint a = 2u * reach * (i / reach) + i % reach, b = a + reach;
                bool rises = (a & span) == 0u;
                if (rises ? pair_less(b, a) : pair_less(a, b)) swap_pairs(a, b);
            }
            workgroup_barrier();
        }
    }
}

// All pairs of which the boxes overlap now, sorted.
void find_pairs()
{
    if (me() == 0u) found_pairs = 0u;
    workgroup_barrier();
    for (uint body = me(); body < WEFT_BODIES.count; body += WEFT_BODY_GROUP) {
        pair_with_bodies(body);
        pair_with_colliders(body);
    }
    workgroup_barrier();
    uint count = min(found_pairs, WEFT_BODIES.pair_room), size = 1u;
    while (size < count) size *= 2u;
    for (uint i = count + me(); i < size; i += WEFT_BODY_GROUP)
        WEFT_BODIES.pairs.at[2u * i] = WEFT_BODIES.pairs.at[2u * i + 1u] = 0xffffffffu;
    if (me() == 0u) {
        WEFT_BODIES.pair_count = count;
        WEFT_BODIES.wanted_pairs = max(WEFT_BODIES.wanted_pairs, found_pairs);
    }
    workgroup_barrier();
    sort_pairs(size);
}

// --- Contacts of a substep ---

// Of a pair of a body and a collider the body gives how far both are apart; of two bodies the one with the features.
float margin_of_pair(uint pair)
{
    uint features = WEFT_BODIES.pairs.at[2u * pair], shape = WEFT_BODIES.pairs.at[2u * pair + 1u];
    uint first_body = body_at(features), shape_body = body_at(shape);
    bool first = first_body != WEFT_NO_BODY;
    uint ball = first ? features : shape, solid = first ? shape : features;
    uint body = first ? first_body : shape_body, other_body = first ? shape_body : WEFT_NO_BODY;
    BodySide mine = side_of(ball, body), other = side_of(solid, other_body);
    vec3 center = mine.moved.center;
    Step step = substep_of_bodies();
    float way = way_of_body(mine, radius_of(body), step);
    if (other_body != WEFT_NO_BODY) way += way_of_body(other, radius_of(other_body), step);
    else way += way_of_collider(other.poses, center);
    return body_margin(solid_of(collider_at(solid)), other.poses, center, radius_of(body), way);
}

FlatFaces faces_of(uint collider)
{
    FeaturesIn of = WEFT_BODIES.features.at[collider];
    return FlatFaces(ShapeBlocks(uvec2(WEFT_BODIES.faces)), int(of.first_face), int(of.faces), of.roundness);
}

// Which face of the pair's shape its features are on: face_toward(), or -1.
int facing_of_pair(uint pair)
{
    uint a = WEFT_BODIES.pairs.at[2u * pair], b = WEFT_BODIES.pairs.at[2u * pair + 1u];
    FeaturesIn of = WEFT_BODIES.features.at[a];
    if (of.edges == 0u) return -1;
    FeatureBalls balls = FeatureBalls(ShapeBlocks(uvec2(WEFT_BODIES.points)), int(of.first_point), int(of.points));
    return face_toward(faces_of(b), balls, side_of(a, body_at(a)).poses, side_of(b, body_at(b)).poses);
}

// Finds the near pairs, and numbers the places where their features may touch: one of each point, two of each edge.
// Returns the number of places.
uint number_features()
{
    uint total = 0u;
    for (uint begin = 0u; begin < WEFT_BODIES.pair_count; begin += WEFT_BODY_GROUP) {
        uint pair = begin + me(), mine = 0u, all;
        if (pair < WEFT_BODIES.pair_count) {
            float margin = margin_of_pair(pair);
            WEFT_BODIES.margins.at[pair] = margin;
            uint features = WEFT_BODIES.pairs.at[2u * pair];
            if (margin >= 0.0) {
                mine = WEFT_BODIES.features.at[features].points + 2u * WEFT_BODIES.features.at[features].edges;
                WEFT_BODIES.facing.at[pair] = uint(facing_of_pair(pair));
            }
        }
        uint before = sum_before(mine, all);
        if (pair < WEFT_BODIES.pair_count) WEFT_BODIES.tasks.at[pair] = total + before;
        total += all;
    }
    workgroup_barrier();
    return total;
}

// The pair of a numbered place: the last one that begins at or before it. Pairs that are not near have no features, and
// begin where the next one does.
uint pair_of_task(uint task)
{
    uint begin = 0u, end = WEFT_BODIES.pair_count;
    while (begin + 1u < end) {
        uint middle = (begin + end) / 2u;
        if (WEFT_BODIES.tasks.at[middle] <= task) begin = middle;
        else end = middle;
    }
    return begin;
}

float restitution_of(uint body)
{
    if (body == WEFT_NO_BODY) return 0.0;
    vec4 center = WEFT_BODY(body).center;
    return center.w;
}

BodyTouch touch_of(BodyRowIn row)
{
    return BodyTouch(row.local_a.xyz, row.local_b.xyz, row.normal.xyz, row.local_a.w, row.local_b.w, row.normal.w,
                     row.numbers.x, row.numbers.y, row.numbers.z, row.numbers.w, row.friction.w, row.friction.xyz);
}
BodyTouch load_touch(uint r)
{
    vec4 local_a = WEFT_BODIES.rows.at[r].local_a, local_b = WEFT_BODIES.rows.at[r].local_b;
    vec4 normal = WEFT_BODIES.rows.at[r].normal, friction = WEFT_BODIES.rows.at[r].friction;
    vec4 numbers = WEFT_BODIES.rows.at[r].numbers;
    return BodyTouch(local_a.xyz, local_b.xyz, normal.xyz, local_a.w, local_b.w, normal.w, numbers.x, numbers.y,
                     numbers.z, numbers.w, friction.w, friction.xyz);
}

// m/s: what gravity adds in two substeps. What is slower does not bounce.
float slow_speed()
{
    vec3 gravity = gravity_of_bodies();
    return 2.0 * WEFT_BODIES.h * sqrt(dot(gravity, gravity));
}

bool find_touch(uint task, out BodyRowIn row)
{
    uint pair = pair_of_task(task), a = WEFT_BODIES.pairs.at[2u * pair], b = WEFT_BODIES.pairs.at[2u * pair + 1u];
    uint place = task - WEFT_BODIES.tasks.at[pair];
    FeaturesIn features = WEFT_BODIES.features.at[a];
    float margin = WEFT_BODIES.margins.at[pair];
    uint body_a = body_at(a), body_b = body_at(b);
    BodySide first = side_of(a, body_a), second = side_of(b, body_b);
    ColliderIn mine = collider_at(a), theirs = collider_at(b);
    Solid solid = solid_of(theirs);
    FlatFaces faces = faces_of(b);
    int face = int(WEFT_BODIES.facing.at[pair]);
    vec4 ball = vec4(0.0);
    bool may = true;
    if (place < features.points) {
        ball = WEFT_BODIES.points.at[features.first_point + place];
    } else {
        uint half_edge = place - features.points, edge = 2u * (features.first_edge + half_edge / 2u);
        vec4 from = WEFT_BODIES.edges.at[edge], to = WEFT_BODIES.edges.at[edge + 1u];
        float part = touching_part(solid, faces, face, first.poses, second.poses,
                                   BodyEdge(from.xyz, to.xyz, from.w, to.w), margin, (half_edge & 1u) == 1u);
        may = part >= 0.0;
        ball = from + (to - from) * part;
    }
    BodyTouch touch;
    if (!may || !touch_body(solid, faces, face, first, second, ball.xyz, ball.w, margin, substep_of_bodies(), touch))
        return false;
    row.a = a;
    row.b = b;
    row.body_a = body_a;
    row.body_b = body_b;
    row.local_a = vec4(touch.local_a, touch.radius);
    row.local_b = vec4(touch.local_b, touch.gap_at_start);
    row.normal = vec4(touch.normal, touch.approach);
    row.place = place;
    row.friction = vec4(touch.friction, touch.push);
    row.numbers = vec4(sqrt(mine.static_friction * theirs.static_friction),
                       sqrt(mine.kinetic_friction * theirs.kinetic_friction),
                       max(restitution_of(body_a), restitution_of(body_b)), 0.0);
    return true;
}

shared uint first_row[WEFT_MOST_BODIES];  // by body: its first row that has no level yet
shared uint placed_rows, left_rows;

// Sorts the rows into levels. Rows that share a body keep their order, and those of a level share none, so the result is
// that of one row after another.
void order_rows(uint first, uint rows)
{
    uint end = first + rows;
    if (me() == 0u) {
        placed_rows = 0u;
        WEFT_BODIES.levels.at[0] = 0u;
    }
    for (uint r = first + me(); r < end; r += WEFT_BODY_GROUP) WEFT_BODIES.rows.at[r].numbers.w = -1.0;  // has no level
    uint level = 0u;
    shared_barrier();
    while (placed_rows < rows) {
        for (uint body = me(); body < WEFT_MOST_BODIES; body += WEFT_BODY_GROUP) first_row[body] = 0xffffffffu;
        workgroup_barrier();
        for (uint r = first + me(); r < end; r += WEFT_BODY_GROUP) {
            if (WEFT_BODIES.rows.at[r].numbers.w == 0.0) continue;
            uint a = WEFT_BODIES.rows.at[r].body_a, b = WEFT_BODIES.rows.at[r].body_b;
            if (a != WEFT_NO_BODY) atomicMin(first_row[a], r);
            if (b != WEFT_NO_BODY) atomicMin(first_row[b], r);
        }
        shared_barrier();
        for (uint r = first + me(); r < end; r += WEFT_BODY_GROUP) {
            if (WEFT_BODIES.rows.at[r].numbers.w == 0.0) continue;
            uint a = WEFT_BODIES.rows.at[r].body_a, b = WEFT_BODIES.rows.at[r].body_b;
            if ((a != WEFT_NO_BODY && first_row[a] != r) || (b != WEFT_NO_BODY && first_row[b] != r)) continue;
            WEFT_BODIES.rows.at[r].numbers.w = 0.0;
            WEFT_BODIES.order.at[atomicAdd(placed_rows, 1u)] = r;
        }
        shared_barrier();
        ++level;
        if (me() == 0u) WEFT_BODIES.levels.at[level] = placed_rows;
        shared_barrier();
    }
    if (me() == 0u) {
        WEFT_BODIES.first_row = first;
        WEFT_BODIES.row_count = rows;
        WEFT_BODIES.level_count = level;
    }
    workgroup_barrier();
}

// --- Sweeps over the contacts ---

#define WEFT_SWEEP_GO_ON 0
#define WEFT_SWEEP_PROJECT 1
#define WEFT_SWEEP_BOUNCE 2
#define WEFT_SWEEP_LIFT 3

vec3 arm_of(uint body, vec3 touched) { return touched - WEFT_BODY(body).place.xyz; }

// Pushes both sides by an impulse, or only hits or shifts them.
void apply_to_sides(uint r, uint how, vec3 touched, vec3 impulse)
{
    uint a = WEFT_BODIES.rows.at[r].body_a, b = WEFT_BODIES.rows.at[r].body_b;
    if (a != WEFT_NO_BODY) change_one(a, how, BodyPush(impulse, cross(arm_of(a, touched), impulse)));
    if (b != WEFT_NO_BODY) change_one(b, how, BodyPush(-impulse, cross(arm_of(b, touched), -impulse)));
}

BodySide first_side(uint r) { return side_of(WEFT_BODIES.rows.at[r].a, WEFT_BODIES.rows.at[r].body_a); }
BodySide second_side(uint r) { return side_of(WEFT_BODIES.rows.at[r].b, WEFT_BODIES.rows.at[r].body_b); }

void give_row(uint r)
{
    vec3 touched;
    vec3 by = given_by(load_touch(r), first_side(r), touched);
    if (dot(by, by) > 0.0) apply_to_sides(r, WEFT_PUSH, touched, by * WEFT_BODIES.inv_h);
}

void project_row(uint r)
{
    BodyTouch touch = load_touch(r);
    vec3 touched;
    vec3 by = project_bodies(touch, first_side(r), second_side(r), touched);
    WEFT_BODIES.rows.at[r].friction = vec4(touch.friction, touch.push);
    if (dot(by, by) > 0.0) apply_to_sides(r, WEFT_PUSH, touched, by * WEFT_BODIES.inv_h);
}

void bounce_row(uint r)
{
    BodyTouch touch = load_touch(r);
    if (!(touch.push > 0.0)) return;
    vec3 touched;
    vec3 impulse = bounce_bodies(touch, side_now(WEFT_BODIES.rows.at[r].a, WEFT_BODIES.rows.at[r].body_a),
                                 side_now(WEFT_BODIES.rows.at[r].b, WEFT_BODIES.rows.at[r].body_b), slow_speed(),
                                 substep_of_bodies(), touched);
    WEFT_BODIES.rows.at[r].numbers.w = touch.taken;
    apply_to_sides(r, WEFT_HIT, touched, impulse);
}

void lift_row(uint r)
{
    vec3 touched;
    vec3 by = lift_bodies(load_touch(r), first_side(r), second_side(r), WEFT_BODIES.depenetration, touched);
    if (dot(by, by) > 0.0) apply_to_sides(r, WEFT_SHIFT, touched, by * WEFT_BODIES.inv_h);
}

void sweep_rows(uint kind)
{
    for (uint level = 0u; level < WEFT_BODIES.level_count; ++level) {
        uint end = WEFT_BODIES.levels.at[level + 1u];
        for (uint i = WEFT_BODIES.levels.at[level] + me(); i < end; i += WEFT_BODY_GROUP) {
            uint r = WEFT_BODIES.order.at[i];
            if (kind == WEFT_SWEEP_GO_ON) give_row(r);
            else if (kind == WEFT_SWEEP_PROJECT) project_row(r);
            else if (kind == WEFT_SWEEP_BOUNCE) bounce_row(r);
            else lift_row(r);
        }
        workgroup_barrier();
    }
}

bool comes_before(uint r, BodyRowIn row)
{
    uint a = WEFT_BODIES.rows.at[r].a, b = WEFT_BODIES.rows.at[r].b;
    if (a != row.a) return a < row.a;
    if (b != row.b) return b < row.b;
    return WEFT_BODIES.rows.at[r].place < row.place;
}

// Lets a row begin with what it gave in the substep before. Rows are in the order of their keys.
void go_on(inout BodyRowIn row)
{
    uint first = WEFT_BODIES.first_row, end = first + WEFT_BODIES.row_count, begin = first, stop = end;
    while (begin < stop) {
        uint middle = (begin + stop) / 2u;
        if (comes_before(middle, row)) begin = middle + 1u;
        else stop = middle;
    }
    if (begin == end || WEFT_BODIES.rows.at[begin].a != row.a || WEFT_BODIES.rows.at[begin].b != row.b ||
        WEFT_BODIES.rows.at[begin].place != row.place)
        return;
    BodyTouch touch = touch_of(row);
    go_on_from(load_touch(begin), slow_speed(), touch);
    row.friction = vec4(touch.friction, touch.push);
}

void find_contacts()
{
    uint tasks = number_features(), rows = 0u;
    uint first = WEFT_BODIES.first_row == 0u ? WEFT_BODIES.row_room : 0u;
    for (uint begin = 0u; begin < tasks; begin += WEFT_BODY_GROUP) {
        BodyRowIn row;
        uint task = begin + me(), all;
        bool touches = false;
        if (task < tasks) touches = find_touch(task, row);
        if (touches) go_on(row);
        uint at = rows + sum_before(touches ? 1u : 0u, all);
        if (touches && at < WEFT_BODIES.row_room) WEFT_BODIES.rows.at[first + at] = row;
        rows += all;
    }
    if (me() == 0u) WEFT_BODIES.wanted_rows = max(WEFT_BODIES.wanted_rows, rows);
    workgroup_barrier();
    order_rows(first, min(rows, WEFT_BODIES.row_room));
    sweep_rows(WEFT_SWEEP_GO_ON);
}

#endif
