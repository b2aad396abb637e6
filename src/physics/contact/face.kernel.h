// Contact of a triangle of cloth with a collider: where the collider's distance is least on the triangle, and when the
// triangle first touches (law: contact.md). One text for all shapes.

struct Corners {
    vec3 a, b, c;
};

WEFT_FN Corners to_body(ContactBody body, Corners x)
{
    Corners local;
    local.a = to_body(body, x.a);
    local.b = to_body(body, x.b);
    local.c = to_body(body, x.c);
    return local;
}
WEFT_FN Corners to_body_at_start(ContactBody body, Corners x)
{
    Corners local;
    local.a = to_body_at_start(body, x.a);
    local.b = to_body_at_start(body, x.b);
    local.c = to_body_at_start(body, x.c);
    return local;
}
WEFT_FN vec3 point_of(Corners x, vec3 weights) { return x.a * weights.x + x.b * weights.y + x.c * weights.z; }
WEFT_FN Corners between(Corners from, Corners to, real time)
{
    Corners x;
    x.a = from.a + (to.a - from.a) * time;
    x.b = from.b + (to.b - from.b) * time;
    x.c = from.c + (to.c - from.c) * time;
    return x;
}
WEFT_FN real longest_of(vec3 a, vec3 b, vec3 c) { return sqrt(max(dot(a, a), max(dot(b, b), dot(c, c)))); }
// The longest way of a corner.
WEFT_FN real longest_way(Corners from, Corners to)
{
    return longest_of(to.a - from.a, to.b - from.b, to.c - from.c);
}
WEFT_FN real longest_edge(Corners x) { return longest_of(x.b - x.a, x.c - x.b, x.a - x.c); }
// The largest distance of a corner from a point.
WEFT_FN real radius_around(Corners x, vec3 center) { return longest_of(x.a - center, x.b - center, x.c - center); }

struct FacePoint {
    vec3 weights;   // of the corners
    real distance;  // m
    vec3 normal;    // in the body's frame
};

WEFT_FN FacePoint face_point(Solid solid, Corners x, vec3 weights)
{
    FacePoint point;
    point.weights = weights;
    point.distance = solid_distance(solid, point_of(x, weights), point.normal);
    return point;
}
WEFT_FN FacePoint choose(mask m, FacePoint yes, FacePoint no)
{
    FacePoint point;
    point.weights = select(m, yes.weights, no.weights);
    point.distance = select(m, yes.distance, no.distance);
    point.normal = select(m, yes.normal, no.normal);
    return point;
}
WEFT_FN FacePoint nearer(FacePoint one, FacePoint other) { return choose(other.distance < one.distance, other, one); }
WEFT_FN vec3 center_weights() { return vec3(real(1.0 / 3.0), real(1.0 / 3.0), real(1.0 / 3.0)); }

// m: how near the middle surface of a face may come to a body. Particles stay half a thickness away. With less for faces,
// those of a fine mesh on a smooth body touch nothing.
WEFT_FN real nearest_of_faces(real half_thickness) { return real(0.5) * half_thickness; }

// Whether a body may touch a face whose corners it does not: it has edges or corners, or a ball that touches the corners
// reaches far beyond their plane.
//   circle  radius of the circle around the face, m
WEFT_FN mask reaches_faces(real roundness, real half_thickness, real nearest, real circle)
{
    real radius = roundness + half_thickness;
    mask small = !(circle < radius);
    real rest = select(small, real(0), (radius - circle) * (radius + circle));
    real sagitta = circle * circle / (radius + sqrt(rest));
    return small || sagitta > half_thickness - nearest;
}

// Whether a particle is so near a body that one of its triangles may touch it. A triangle that touches at the end of the
// substep is nearer than `nearest` there, and one that touches on its way is nearer than twice its longest way. The point
// that touches is no farther from the nearest corner than 1/√3 of the longest edge, and from any corner than that edge. If
// a triangle touches, this holds for at least one corner: for the nearest one, if the longest way is short, or for the one
// with the longest way.
//   distance, way  of the particle, m;  widest  no edge is longer, m
WEFT_FN mask faces_may_touch(Solid solid, real distance, real way, real nearest, real widest)
{
    real short_way = real(0.1) * widest;
    real reach = select(way < short_way, real(0.5774) * widest + real(2) * short_way, widest + real(2) * way);
    return distance < nearest + reach * solid.steepness;
}

// What a triangle cannot come nearer than, if the slope of the distance only grows. `point`: any point of it.
WEFT_FN real lowest_of(Corners x, FacePoint point)
{
    vec3 at = point_of(x, point.weights);
    return point.distance + min(dot(point.normal, x.a - at), min(dot(point.normal, x.b - at), dot(point.normal, x.c - at)));
}

// A part of a straight line on the triangle that holds the line's least distance.
struct Interval {
    FacePoint low, high;
};

// The least distance between two points of the triangle. Each step goes to where the tangents at the ends of the interval
// meet: a distance whose slope only grows lies above both.
//   best   the nearest point so far; takes what is nearer
WEFT_FN Interval search_between(Solid solid, Corners x, Interval ends, inout_(FacePoint) best, real enough, mask searches)
{
    for (int step = 0; step < 3 && any(searches); ++step) {
        vec3 along = point_of(x, ends.high.weights) - point_of(x, ends.low.weights);
        real fall = dot(ends.low.normal, along), rise = dot(ends.high.normal, along);
        mask between = fall < real(0) && rise > real(0);
        real part = (ends.high.distance - rise - ends.low.distance) / select(between, fall - rise, real(1));
        part = clamp01(part);
        real bound = ends.low.distance + fall * part;
        searches = searches && between && bound < enough && bound < best.distance;
        FacePoint next = face_point(solid, x, ends.low.weights * (real(1) - part) + ends.high.weights * part);
        mask falls = dot(next.normal, along) < real(0);
        ends.low = choose(searches && falls, next, ends.low);
        ends.high = choose(searches && !falls, next, ends.high);
        best = choose(searches && next.distance < best.distance, next, best);
    }
    return ends;
}
WEFT_FN void search_edge(Solid solid, Corners x, FacePoint p, FacePoint q, inout_(FacePoint) best, real enough,
                         mask searches)
{
    Interval edge;
    edge.low = p;
    edge.high = q;
    search_between(solid, x, edge, best, enough, searches);
}

// How the weights of a point change along a way on the triangle. `normal`: of the triangle, as long as twice its area.
WEFT_FN vec3 rates_of(Corners x, vec3 way, vec3 normal)
{
    real scale = real(1) / max(dot(normal, normal), real(1e-36));
    real v = dot(cross(way, x.c - x.a), normal) * scale, w = dot(cross(x.b - x.a, way), normal) * scale;
    return vec3(-v - w, v, w);
}
WEFT_FN real part_of_edge(vec3 way, vec3 edge) { return dot(way, edge) / max(dot(edge, edge), real(1e-36)); }
WEFT_FN vec3 part_along(vec3 way, vec3 edge) { return edge * part_of_edge(way, edge); }

// The rates of the weights along a way that stays on the triangle: what would leave it at once goes along the border. There
// the rate of the third corner is zero to the last bit.
WEFT_FN vec3 rates_within(Corners x, vec3 weights, vec3 way, vec3 normal)
{
    vec3 rates = rates_of(x, way, normal);
    real least = real(1e-4), zero = real(0);
    mask off_a = weights.x < least && rates.x < zero, off_b = weights.y < least && rates.y < zero,
         off_c = weights.z < least && rates.z < zero;
    real bc = part_of_edge(way, x.c - x.b), ca = part_of_edge(way, x.a - x.c), ab = part_of_edge(way, x.b - x.a);
    rates = select(off_a, vec3(zero, -bc, bc), rates);
    rates = select(off_b, vec3(ca, zero, -ca), rates);
    return select(off_c, vec3(-ab, ab, zero), rates);
}

// Where a way from a point leaves the triangle: weights.
WEFT_FN vec3 end_of_way(vec3 weights, vec3 rates)
{
    real far = real(1e18);
    real t = min(select(rates.x < real(0), weights.x / max(-rates.x, real(1e-18)), far),
                 min(select(rates.y < real(0), weights.y / max(-rates.y, real(1e-18)), far),
                     select(rates.z < real(0), weights.z / max(-rates.z, real(1e-18)), far)));
    vec3 end = weights + rates * select(t < far, t, real(0));
    end = vec3(max(end.x, real(0)), max(end.y, real(0)), max(end.z, real(0)));
    return end * (real(1) / (end.x + end.y + end.z));
}

// Where the distance is least on a triangle:
// 1. on its edges, where they cross edges of the body;
// 2. at the foot of the body's nearest point, or of the center of its rounding (Macklin et al. 2020, "Local Optimization
//    for Robust Signed Distance Field Collision"), where the body is round;
// 3. down the slope, or along the border where the slope leads out; then along the ridge on which that ends, and so on:
//    to a corner of the body.
//   point    where to start
//   enough   m: a triangle that cannot come nearer than this, if the slope only grows, is left alone
WEFT_OUTLINED_FN FacePoint least_on_face(Solid solid, Corners x, FacePoint point, real enough)
{
    real zero = real(0), one = real(1);
    mask searches = lowest_of(x, point) < enough;
    if (!any(searches)) return point;
    mask looks = searches;

    FacePoint a = face_point(solid, x, vec3(one, zero, zero)), b = face_point(solid, x, vec3(zero, one, zero)),
              c = face_point(solid, x, vec3(zero, zero, one));
    FacePoint best = nearer(nearer(point, a), nearer(b, c));
    search_edge(solid, x, a, b, best, enough, searches);
    search_edge(solid, x, b, c, best, enough, searches);
    search_edge(solid, x, c, a, best, enough, searches);

    vec3 normal = cross(x.b - x.a, x.c - x.a);
    vec3 up = normal * (one / sqrt(max(dot(normal, normal), real(1e-36))));
    vec3 inner = point_of(x, best.weights) - best.normal * abs(best.distance + solid.roundness);
    ClosestPoints foot = closest_vertex_triangle(inner, x.a, x.b, x.c);
    best = nearer(best, face_point(solid, x, vec3(-foot.w1, -foot.w2, -foot.w3)));

    // What the triangle cannot come nearer than: the tangent planes at both ends of a line, mixed so that they are level
    // where the line is lowest, lie below a distance whose slope only grows.
    real fine = real(1e-4) * longest_edge(x);
    vec3 slope = best.normal - up * dot(best.normal, up);
    for (int line = 0; line < 4 && any(searches); ++line) {
        Interval way;
        way.low = best;
        way.high = face_point(solid, x, end_of_way(best.weights, rates_within(x, best.weights, -slope, normal)));
        best = choose(searches && way.high.distance < best.distance, way.high, best);
        way = search_between(solid, x, way, best, real(1e18), searches);
        vec3 fall = way.low.normal - up * dot(way.low.normal, up);
        vec3 rise = way.high.normal - up * dot(way.high.normal, up);
        vec3 turn = rise - fall;
        real part = clamp01(-dot(fall, turn) / max(dot(turn, turn), real(1e-12)));
        slope = fall + turn * part;
        real low = way.low.distance - dot(fall, point_of(x, way.low.weights));
        real high = way.high.distance - dot(rise, point_of(x, way.high.weights));
        real bound = low + (high - low) * part + min(dot(slope, x.a), min(dot(slope, x.b), dot(slope, x.c)));
        searches = searches && bound < min(enough, best.distance - fine);
    }
    return choose(looks, best, point);
}

// Where a triangle is nearest to a body, no slope leads along the triangle, or along the edge that the point is on. A corner
// or an edge of the body has many slopes there, of which this one pushes the triangle away without pushing it aside.
WEFT_FN vec3 slope_across(Corners x, FacePoint point)
{
    vec3 w = point.weights, slope = point.normal;
    mask off_a = w.x < min(w.y, w.z), off_b = w.y < w.z;
    vec3 edge = select(off_a, x.c - x.b, select(off_b, x.a - x.c, x.b - x.a));
    vec3 normal = cross(x.b - x.a, x.c - x.a);
    vec3 across = select(min(w.x, min(w.y, w.z)) > real(0.001), part_along(slope, normal), slope - part_along(slope, edge));
    real size = sqrt(max(dot(across, across), real(1e-30)));
    // What slides along a face of the body keeps its normal to the last bit; a triangle that is edge-on has none.
    return select(size < real(0.99) && size > real(0.05), across * (real(1) / size), slope);
}

// What a triangle and a body do in a substep.
struct FaceContact {
    mask touches;
    mask swept;         // it touches on the way
    mask fast;          // it touches on its way, or moves so far that pushes may carry it through the body
    vec3 weights;       // of the point that touches
    vec3 normal;        // in the body's frame
    vec3 place;         // where it touches, in the body's frame
    real gap;           // of that point along the normal at the end of the substep, m
    real gap_at_start;  // m
    real time;          // part of the way before it touches, 1 if it does not touch on the way
    real last;          // m: the least distance at the end of the substep
};

// Conservative advancement of the triangle's least distance.
WEFT_OUTLINED_FN FaceContact swept_face(Solid solid, Corners from, Corners to,
                                        FacePoint first, real half_thickness)
{
    real speed = max(longest_way(from, to) * solid.steepness, real(1e-30));
    real least = touching_distance(first.distance, half_thickness);
    FacePoint now = first;
    real time = real(0);
    for (int step = 0; step < 32 && any(now.distance > least && time < real(1)); ++step) {

        mask goes_on = now.distance > least && time < real(1);

        real next = min(time + (now.distance - real(0.5) * least) / speed, real(1));
        Corners there = between(from, to, next);
        // Another part of the body may have come nearer.
        FacePoint point = nearer(face_point(solid, there, now.weights),
                                 face_point(solid, there, center_weights()));
        // What the rest of the way cannot reach need not be exact.
        point = least_on_face(solid, there, point, least + speed * (real(1) - next));
        time = select(goes_on, next, time);
        now.weights = select(goes_on, point.weights, now.weights);
        now.distance = select(goes_on, point.distance, now.distance);
        now.normal = select(goes_on, point.normal, now.normal);
    }
    FaceContact contact;
    contact.touches = !(now.distance > least) || time < real(1);
    contact.weights = now.weights;
    Corners there = between(from, to, time);
    now.normal = slope_across(there, now);
    contact.normal = now.normal;
    vec3 touched = point_of(there, now.weights);
    contact.place = touched;
    contact.gap = dot(now.normal, point_of(to, now.weights) - touched) + now.distance;
    contact.gap_at_start = first.distance;
    contact.swept = contact.touches;
    contact.fast = contact.touches;
    contact.time = time;
    contact.last = now.distance;
    return contact;
}

// Whether contact of a triangle has to be computed. `center`: the middle of the triangle at the end of the substep.
WEFT_FN mask face_may_touch(Corners from, Corners to, FacePoint center, Solid solid, real nearest)
{
    real way = longest_way(from, to);
    real farthest = (radius_around(to, point_of(to, center.weights)) + way) * solid.steepness;
    return center.distance < nearest + farthest &&
           lowest_of(to, center) < max(nearest, real(2) * way * solid.steepness);
}

// Whether a triangle is on the same side of the body at the end of the substep as at its start: it is not deep inside,
// its nearest point has about kept the direction to the surface, and it has moved less than through the body. What slides is
// spared the search on its way.
//   first, last  the point that is nearest at the end, at the start and at the end
//   deepest      m: what ends deeper is searched on its way
WEFT_FN mask stays_on_side(Solid solid, FacePoint first, FacePoint last, real way, real deepest)
{
    return way < solid.width && last.distance > deepest &&
           dot(first.normal, last.normal) > real(0.5);
}

// Contact of a triangle that may touch the body. A face is kept at `nearest` from the surface, which is less than the
// corners are, so that faces of a fine mesh on a smooth body touch nothing.
//   from, to  the triangle at the start and at the end of the substep, in the body's frame
//   deepest   of stays_on_side()
WEFT_FN FaceContact face_contact(Solid solid, Corners from, Corners to, FacePoint center,
                                 real nearest, real half_thickness, real deepest)
{
    real way = longest_way(from, to), far = real(2) * way * solid.steepness;
    FacePoint last = least_on_face(solid, to, center, max(nearest, far));
    FaceContact contact;
    contact.weights = last.weights;
    contact.normal = slope_across(to, last);
    contact.place = point_of(to, last.weights);
    contact.gap = last.distance - nearest;
    contact.gap_at_start = real(0);
    contact.time = real(1);
    contact.last = last.distance;
    contact.touches = contact.gap < real(0);

    // A triangle that moves less than its least distance at the start cannot have passed.
    mask moves_far = last.distance < far;
    contact.fast = moves_far && way > real(0.25) * solid.width;
    contact.swept = contact.touches && !contact.touches;
    if (any(moves_far || contact.touches)) {
        FacePoint first = face_point(solid, from, last.weights);
        contact.gap_at_start = first.distance - nearest;

        moves_far = moves_far && !stays_on_side(solid, first, last, way, deepest);
        if (any(moves_far)) {
            first = nearer(first, face_point(solid, from, center_weights()));
            first = least_on_face(solid, from, first, way * solid.steepness);
            mask fast = moves_far && may_pass(first.distance, way, solid, real(2) * half_thickness);

            if (any(fast)) {
                FaceContact swept = swept_face(solid, from, to, first, half_thickness);
                mask stopped = fast && swept.touches;
                contact.weights = select(stopped, swept.weights, contact.weights);
                contact.normal = select(stopped, swept.normal, contact.normal);
                contact.place = select(stopped, swept.place, contact.place);
                contact.gap = select(stopped, swept.gap - nearest, contact.gap);
                contact.gap_at_start = select(stopped, swept.gap_at_start - nearest, contact.gap_at_start);
                mask overlaps = contact.gap < real(0);
                contact.touches = (stopped && overlaps) || (!stopped && contact.touches);
                contact.swept = stopped;
                contact.fast = contact.fast || stopped;
                contact.time = select(stopped, swept.time, real(1));
            }
        }
    }
    return contact;
}

// Corners have contact of their own.
WEFT_FN mask is_beside_corners(vec3 weights) { return max(weights.x, max(weights.y, weights.z)) < real(0.999); }
WEFT_FN mask touches_beside_corners(FaceContact contact)
{
    return contact.touches && is_beside_corners(contact.weights);
}

// Whether the triangle, or those around it, may pass the body after the pushes. `gives`: whether cloth moves the body. Then
// only what touches on its way counts, because to hold the cloth back in slow contact would stop the body.
WEFT_FN mask is_fast(FaceContact contact, bool gives)
{
    mask listed = touches_beside_corners(contact);
    return gives ? contact.swept && listed : contact.fast;
}

// m: a face on its side of the body comes no nearer after all pushes.
WEFT_FN real least_after_pushes(real nearest) { return real(0.25) * nearest; }

// Whether a face is still, or again, beyond where it touched on its way, or inside the body: what pushes have left. A face
// that began inside may come out, but not go deeper.
WEFT_FN mask has_passed(FaceContact contact, real nearest)
{
    real start = contact.gap_at_start + nearest;
    real least = select(contact.time > real(0), least_after_pushes(nearest), start - real(0.05) * nearest);
    return contact.swept && min(contact.gap + nearest, contact.last) < least;
}

// A contact of a face keeps the point with these weights on one side of a plane.
struct FaceRow {
    vec3 weights;
    vec3 normal;                              // world
    vec3 lever;                               // from the body's origin to where it touches, world, m
    real offset;                              // m: normal·point + offset is the gap
    real gap_at_start;                        // m
    vec3 corner_gaps;                         // of the corners at the start of the substep, m
    vec3 start;                               // the point at the start of the substep, plus how far the body carried it
    real static_friction, kinetic_friction;
    real depenetration;                       // m
    real swept;                               // 1 if the face touches on its way, 0 otherwise
};

// `x`, `start`: the triangle at the end and at the start of the substep; `local`: at the end, in the body's frame.
WEFT_FN FaceRow face_row(ContactBody body, FaceContact contact, Corners x, Corners start, Corners local)
{
    FaceRow row;
    row.weights = contact.weights;
    row.normal = rotate(body.rx, body.ry, body.rz, contact.normal);
    row.lever = rotate(body.rx, body.ry, body.rz, contact.place);
    row.offset = contact.gap - dot(row.normal, point_of(x, contact.weights));
    row.gap_at_start = contact.gap_at_start;
    row.start = point_of(start, contact.weights) + carried_by(body, point_of(local, contact.weights));
    row.corner_gaps = vec3(dot(row.normal, start.a + carried_by(body, local.a)),
                           dot(row.normal, start.b + carried_by(body, local.b)),
                           dot(row.normal, start.c + carried_by(body, local.c))) + vec3(row.offset);
    row.static_friction = body.static_friction;
    row.kinetic_friction = body.kinetic_friction;
    row.depenetration = body.depenetration;
    row.swept = select(contact.swept, real(1), real(0));
    return row;
}

// How far the particles of a row have to move, per inverse mass and weight.
//   point  the row's point now; inverse_mass  of the point: the sum of w_i weight_i²
WEFT_FN vec3 face_displacement(FaceRow row, vec3 point, real inverse_mass, inout_(ContactSum) sum)
{
    ContactBody body;
    body.static_friction = row.static_friction;
    body.kinetic_friction = row.kinetic_friction;
    body.depenetration = row.depenetration;
    vec3 x = point;
    project_contact(x, row.start, inverse_mass, sum, dot(row.normal, point) + row.offset, row.gap_at_start, row.normal,
                    vec3(real(0)), body);
    return (x - point) * select(inverse_mass > real(0), real(1) / max(inverse_mass, real(1e-30)), real(0));
}

// The last sweep keeps faces from passing, where the sweeps before have not sufficed: no corner goes behind the plane on
// which the face touched, or farther behind than it began. That holds a face back as a whole, whereas a point of it alone
// would let it turn into a body that moves fast. Faces that began deep inside are on no side. How far a corner has to move
// along the normal.
//   point, corner, corner_gap  the row's point and the corner now; of corner_gaps
WEFT_FN real face_retreat(FaceRow row, vec3 point, vec3 corner, real corner_gap, real nearest)
{
    real goal = min(real(-0.75) * nearest, row.gap_at_start);
    mask acts = row.swept > real(0) ||
                (row.gap_at_start > real(-3) * nearest && dot(row.normal, point) + row.offset < goal);
    real missing = max(min(goal, corner_gap) - (dot(row.normal, corner) + row.offset), real(0));
    return select(acts, missing, real(0));
}

// Whether a push counts: it is as long as half a quantum of the sums. `size2`: its squared length, m². Smaller ones would
// take a share from others, on processors that compute with subnormal numbers.
WEFT_FN mask is_push(real size2)
{
    return size2 > real(0.25 / (WEFT_PUSH_QUANTA_PER_METER * WEFT_PUSH_QUANTA_PER_METER));
}

// The part of its pushes that moves a particle, so that many faces do not push it too far: it goes in their mean direction,
// no farther than the longest of them.
//   longest  m
WEFT_FN real face_share(real longest, vec3 total)
{
    return min(longest / max(sqrt(dot(total, total)), real(1e-9)), real(1));
}

// A particle that is held goes only a part of its way relative to the body. `from`, `to`: in the body's frame.
WEFT_FN vec3 held_place(ContactBody body, vec3 from, vec3 to, real part)
{
    return rotate(body.rx, body.ry, body.rz, from + (to - from) * part) + body.position;
}

// Which part of its way a particle may go, and for which collider, in one integer: the largest over all faces of the
// particle is the least part, whatever their order. 0: it is not held.
#define WEFT_HOLD_PARTS 2047
#define WEFT_HOLD_COLLIDERS 1048576u
