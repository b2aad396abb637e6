// Contacts of bodies with one another and with colliders: one text for C++ and GLSL, on one lane (law: body.md). It comes
// after the other kernels.

// m: a contact that is open by less is listed, because pushes in the substep may close it.
#define WEFT_BODY_OPEN_MARGIN 1e-4
// m: overlap that stays, so that what rests is not moved in every substep.
#define WEFT_BODY_SLACK 1e-5
// Tangent steps along an edge.
#define WEFT_BODY_EDGE_STEPS 6

// What the features of a shape are: one ball, all of its surface, or less than that.
#define WEFT_FEATURES_BALL 0
#define WEFT_FEATURES_ALL 1
#define WEFT_FEATURES_SOME 2

// Whether these features have to meet that shape. Where the ball of one side meets all of the surface of the other, the
// other need not meet the ball. `first`: of two balls the first one meets the second.
WEFT_FN bool features_meet(int features, int shape, bool first)
{
    if (shape != WEFT_FEATURES_BALL || features == WEFT_FEATURES_SOME) return true;
    return features == WEFT_FEATURES_BALL && first;
}

// A body or a collider in a substep: its poses are those of a ContactBody.
struct BodySide {
    ContactBody poses;
    MovedBody moved;
    vec3 v, rate;  // m/s and rad/s, of a body
    mask is_body;
};

// A ball of one side's features that may touch the other side.
struct BodyTouch {
    vec3 local_a, local_b;       // m: where they touch; the feature has a radius around its point
    vec3 normal;                 // world, from b to a
    real radius, gap_at_start;   // m
    real approach;               // m/s along the normal at the start of the substep; negative: they come nearer
    real static_friction, kinetic_friction, restitution;
    real taken;                  // N s, by bounce_bodies()
    real push;                   // kg m
    vec3 friction;               // kg m
};

// How far the point of the side that is now at `x` has moved since the start of the substep.
WEFT_FN vec3 way_with(ContactBody poses, vec3 x) { return x - placed_by_start(poses, to_body(poses, x)); }

// m/s: the velocity of the side's point at `x`. A collider's is the same at the start and at the end.
WEFT_FN vec3 speed_with(BodySide side, vec3 x, vec3 v, vec3 rate, Step step)
{
    if (!side.is_body) return way_with(side.poses, x) * step.inv_h;
    return v + cross(rate, x - side.moved.center);
}

// m: how far a point of a body with this radius may move in the substep.
WEFT_FN real way_of_body(BodySide side, real radius, Step step)
{
    return sqrt(dot(side.v, side.v)) * step.h + sqrt(dot(side.rate, side.rate)) * step.h * radius;
}

// Likewise for the point of a collider that would be at `x` if it had not moved.
WEFT_FN real way_of_collider(ContactBody poses, vec3 x)
{
    vec3 way = placed_by(poses, to_body_at_start(poses, x)) - x;
    return sqrt(dot(way, way));
}

// m: a contact of the pair is listed if it is open by less; negative: the sides are too far apart for any.
//   way    m: of the body and the solid, relative to one another
WEFT_FN real body_margin(Solid solid, ContactBody poses, vec3 center, real radius, real way)
{
    real margin = real(WEFT_BODY_OPEN_MARGIN) + real(0.5) * way;
    vec3 unused;
    real distance = solid_distance(solid, to_body(poses, center), unused);
    return distance > solid.steepness * (radius + margin + real(2) * way) ? real(-1) : margin;
}

// Contact of a ball of the features of `a` with the shape of `b`. Returns false if there is none.
//   face     of the faces of `b`: face_toward(), or -1
WEFT_FN bool touch_body(Solid solid, FlatFaces faces, int face, BodySide a, BodySide b, vec3 local, real radius,
                        real margin, Step step, out_(BodyTouch) touch)
{
    ContactBody poses = b.poses;
    poses.half_thickness = radius;
    vec3 x = placed_by(a.poses, local), start = placed_by_start(a.poses, local);
    vec3 at = to_body(poses, x), at_start = to_body_at_start(poses, start);
    FaceGap to;
    to.meets = false;
    if (face >= 0) to = gap_to_face(faces, face, at, at_start, radius);
    if (!to.meets) {
        vec3 normal;
        real gap = solid_distance(solid, at, normal) - radius;
        vec3 way = at - at_start;
        if (gap > margin + real(2) * solid.steepness * sqrt(dot(way, way))) return false;
        ContactSum none;
        none.friction = vec3(real(0), real(0), real(0));
        none.push = real(0);
        ContactPlane plane = contact_plane(solid, poses, none, at, at_start, gap, normal);
        to.gap = plane.gap;
        to.gap_at_start = plane.gap_at_start;
        to.normal = plane.normal;
    }
    if (!(to.gap < margin)) return false;
    touch.local_a = local;
    touch.local_b = at - to.normal * (to.gap + radius);
    touch.normal = rotate(poses.rx, poses.ry, poses.rz, to.normal);
    touch.radius = radius;
    touch.gap_at_start = to.gap_at_start;
    vec3 touched = x - touch.normal * radius;
    touch.approach = dot(touch.normal, speed_with(a, touched, a.v, a.rate, step) -
                                           speed_with(b, touched, b.v, b.rate, step));
    touch.taken = real(0);
    touch.push = real(0);
    touch.friction = vec3(real(0), real(0), real(0));
    return true;
}

// Where the edge of `a` is nearest to the shape of `b`, as a part of it, or -1 if that is an end or farther than the
// margin. The ends are features of their own. Each step goes to where the tangents at the ends of the interval meet: a
// distance whose slope only grows lies above both.
WEFT_FN real nearest_on_edge(Solid solid, ContactBody a, ContactBody b, BodyEdge edge, real margin)
{
    vec3 from = to_body(b, placed_by(a, edge.from)), to = to_body(b, placed_by(a, edge.to));
    vec3 along = to - from, normal;
    real taper = edge.radius_to - edge.radius_from;
    real low = real(0), low_distance = solid_distance(solid, from, normal) - edge.radius_from;
    real low_slope = dot(normal, along) - taper;
    real high = real(1), high_distance = solid_distance(solid, from + along, normal) - edge.radius_from - taper;
    real high_slope = dot(normal, along) - taper;
    real ends = low_distance < high_distance ? low_distance : high_distance;
    real best = low_distance < high_distance ? low : high, best_distance = ends;
    bool outside = false;
    for (int i = 0; i < WEFT_BODY_EDGE_STEPS; ++i) {
        if (outside || !(low_slope < real(0) && high_slope > real(0))) continue;
        real width = high - low;
        real part = (high_distance - high_slope * width - low_distance) / (low_slope - high_slope);
        part = max(min(part, width), real(0));
        outside = low_distance + low_slope * part > margin;
        real next = low + part;
        real distance = solid_distance(solid, from + along * next, normal) - edge.radius_from - taper * next;
        real slope = dot(normal, along) - taper;
        if (distance < best_distance) {
            best = next;
            best_distance = distance;
        }
        if (slope < real(0)) {
            low = next;
            low_distance = distance;
            low_slope = slope;
        } else {
            high = next;
            high_distance = distance;
            high_slope = slope;
        }
    }
    // What lies flat touches with its ends.
    real least = ends - real(WEFT_BODY_OPEN_MARGIN);
    return !outside && best_distance < (margin < least ? margin : least) ? best : real(-1);
}

// Where the edge of `a` touches the shape of `b`, as a part of it; negative: nowhere. An edge that lies on the face touches
// with both ends of what lies there, unless they are ends of the edge. Any other edge touches in one place.
//   last     the second place
WEFT_FN real touching_part(Solid solid, FlatFaces faces, int face, ContactBody a, ContactBody b, BodyEdge edge,
                           real margin, bool last)
{
    if (face >= 0) {
        EdgeOnFace on = edge_on_face(faces, face, a, b, edge);
        if (on.lies && last) return on.high < real(1) ? on.high : real(-1);
        if (on.lies) return on.low > real(0) ? on.low : real(-1);
    }
    return last ? real(-1) : nearest_on_edge(solid, a, b, edge, margin);
}

// Lets a contact begin with what it gave in the substep before, so that what lies on one another settles within a few
// substeps. What came nearer faster than `slow`, m/s, hit, which it does not do again.
WEFT_FN void go_on_from(BodyTouch before, real slow, inout_(BodyTouch) touch)
{
    if (before.approach < -slow) return;
    touch.push = before.push;
    touch.friction = before.friction - touch.normal * dot(before.friction, touch.normal);
}

// What a contact has given so far, kg m, to the first side. `touched`: m: where.
WEFT_FN vec3 given_by(BodyTouch touch, BodySide a, out_(vec3) touched)
{
    touched = placed_by(a.poses, touch.local_a) - touch.normal * touch.radius;
    return touch.normal * touch.push + touch.friction;
}

// Lets no contact get deeper than it was at the start of the substep.
//
// What the first side gains, kg m: the impulse times the length of the substep. The second one loses it.
//   touched   m: where
WEFT_FN vec3 project_bodies(inout_(BodyTouch) touch, BodySide a, BodySide b, out_(vec3) touched)
{
    vec3 xa = placed_by(a.poses, touch.local_a), xb = placed_by(b.poses, touch.local_b);
    touched = xa - touch.normal * touch.radius;
    ContactSum sum;
    sum.friction = touch.friction;
    sum.push = touch.push;
    BodyRow row;
    row.normal = touch.normal;
    row.gap_at_start = touch.gap_at_start;
    row.static_friction = touch.static_friction;
    row.kinetic_friction = touch.kinetic_friction;
    vec3 way = way_with(a.poses, touched) - way_with(b.poses, touched);
    vec3 by = project_body_row(row, sum, dot(touch.normal, xa - xb) - touch.radius, way, a.moved, b.moved,
                               touched - a.moved.center, touched - b.moved.center);
    touch.friction = sum.friction;
    touch.push = sum.push;
    return by;
}

// m: the gap at which lift_bodies() leaves a contact.
//   depenetration   m: so much of the overlap goes
WEFT_FN real lifted_gap(BodyTouch touch, real depenetration)
{
    return min(real(-WEFT_BODY_SLACK), touch.gap_at_start + depenetration);
}

// The same for overlap from before the substep. It only moves the sides, or they would fly apart.
WEFT_FN vec3 lift_bodies(BodyTouch touch, BodySide a, BodySide b, real depenetration, out_(vec3) touched)
{
    vec3 xa = placed_by(a.poses, touch.local_a), xb = placed_by(b.poses, touch.local_b);
    touched = xa - touch.normal * touch.radius;
    real gap = dot(touch.normal, xa - xb) - touch.radius;
    real w = weight_of(a.moved, touched - a.moved.center, touch.normal) +
             weight_of(b.moved, touched - b.moved.center, touch.normal);
    return touch.normal * (max(lifted_gap(touch, depenetration) - gap, real(0)) / max(w, real(1e-30)));
}

// After Müller et al. 2020, "Detailed Rigid Body Simulation with Extended Position Based Dynamics", section 3.6: the
// velocities at a contact become what restitution makes of those before it, or zero. Projections alone leave some, and
// what stands would tremble. No contact takes back more than it gave. The impulse, N s, as of project_bodies(). v and rate
// of the sides are those of now.
//   slow   m/s: what comes nearer more slowly does not bounce
WEFT_FN vec3 bounce_bodies(inout_(BodyTouch) touch, BodySide a, BodySide b, real slow, Step step, out_(vec3) touched)
{
    touched = placed_by(a.poses, touch.local_a) - touch.normal * touch.radius;
    vec3 speed = speed_with(a, touched, a.v, a.rate, step) - speed_with(b, touched, b.v, b.rate, step);
    real wanted = touch.approach < -slow ? -touch.restitution * touch.approach : real(0);
    real w = weight_of(a.moved, touched - a.moved.center, touch.normal) +
             weight_of(b.moved, touched - b.moved.center, touch.normal);
    real impulse = max((wanted - dot(touch.normal, speed)) / max(w, real(1e-30)), -touch.push / step.h - touch.taken);
    touch.taken = touch.taken + impulse;
    return touch.normal * impulse;
}
