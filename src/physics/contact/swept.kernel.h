// Contact of a particle that moves fast: finds where it first touches a collider during the substep, so that it does not
// pass (law: contact.md). One text for all shapes.

// `kind`: number of the shape in shapes.def.
WEFT_OUTLINED_FN real shape_distance(int kind, vec3 p, ShapeNumbers s, out_(vec3) normal)
{
    int number = 0;
    real distance = real(0);
    normal = vec3(real(0), real(1), real(0));
#define WEFT_SHAPE(name, Name) if (kind == number++) distance = distance_##name(p, s, normal);
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE
    return distance;
}

// A shape, and what is known of it everywhere.
struct Solid {
    int kind;
    ShapeNumbers numbers;
    real steepness;  // the surface is no nearer than the distance divided by this: 1 if it is convex, more if it is not
    real roundness;  // m: the least radius to which its surface is curved outward
    real width;      // m: what passes through it, or through one of its parts, moves at least this far
};

WEFT_FN real solid_distance(Solid solid, vec3 p, out_(vec3) normal)
{
    return shape_distance(solid.kind, p, solid.numbers, normal);
}

// The first touch of a point that moves straight in the body's frame.
struct Touch {
    mask touches;
    real time;      // part of the way before it
    real distance;  // there, m, > 0
    vec3 normal;    // there
};

// The distance at which a point is said to touch: less than the thickness asks, so that the normal is well defined.
WEFT_FN real touching_distance(real distance_at_start, real half_thickness)
{
    return real(0.5) * min(distance_at_start, max(half_thickness, real(1e-5)));
}

// Whether something with this distance at the start and this way, m, may pass to the body's other side. What is deeper
// inside is on no side: it is pushed out where it is.
WEFT_FN mask may_pass(real distance_at_start, real way, Solid solid, real half_thickness)
{
    return distance_at_start > real(-0.5) * half_thickness && way * solid.steepness > max(distance_at_start, real(0));
}

// Conservative advancement: every step is as long as the distance allows. A point that has not arrived after the last
// step is said to touch there, which only restricts it to one side of a plane.
//   distance, normal   at `from`, m; a point that is inside touches there
//   least     m, at most half of `distance`; the point comes no nearer than half of it
WEFT_FN Touch first_touch(Solid solid, vec3 from, vec3 to, real distance, vec3 normal, real least)
{
    vec3 way = to - from;
    real speed = max(sqrt(dot(way, way)) * solid.steepness, real(1e-30));
    Touch touch;
    touch.time = real(0);
    touch.distance = distance;
    touch.normal = normal;
    // Without a return in the loop, which some drivers compile wrongly.
    for (int step = 0; step < 32 && any(touch.distance > least && touch.time < real(1)); ++step) {
        mask goes_on = touch.distance > least && touch.time < real(1);
        real next = min(touch.time + (touch.distance - real(0.5) * least) / speed, real(1));
        vec3 normal_there;
        real there = solid_distance(solid, from + way * next, normal_there);
        touch.time = select(goes_on, next, touch.time);
        touch.distance = select(goes_on, there, touch.distance);
        touch.normal = select(goes_on, normal_there, touch.normal);
    }
    touch.touches = !(touch.distance > least) || touch.time < real(1);
    return touch;
}

// Whether a particle may touch the body during the substep. `gap`: at the end of the substep; `way`: relative to the
// body, m. A particle that ends farther away than twice its way began farther away than its way.
WEFT_FN mask may_touch(real gap, ContactSum sum, real way, Solid solid, ContactBody body)
{
    return gap < real(0) || sum.push > real(0) ||
           gap + body.half_thickness < real(2) * solid.steepness * way;
}

// How a particle that may touch a body meets it: a plane that it must not go behind.
struct ContactPlane {
    mask stopped;       // it touches on its way
    vec3 at;            // where it touches, or its start, in the body's frame
    real distance;      // there, m
    vec3 normal_there;  // in the body's frame
    real gap;           // at the end of the substep, less half the thickness, m
    real gap_at_start;  // m
    vec3 normal;        // in the body's frame
};

//   local, local_at_start   the particle now and at the start of the substep, in the body's frame
//   gap, normal    at `local`: distance minus half the thickness; in the body's frame
WEFT_FN ContactPlane contact_plane(Solid solid, ContactBody body, ContactSum sum, vec3 local, vec3 local_at_start,
                                   real gap, vec3 normal)
{
    ContactPlane plane;
    vec3 normal_at_start;
    real distance_at_start = solid_distance(solid, local_at_start, normal_at_start);
    vec3 way = local - local_at_start;
    // A particle whose way is shorter than its distance at the start cannot reach the surface: the distance at its end
    // decides.
    real length_of_way = sqrt(dot(way, way));
    mask fast = may_touch(gap, sum, length_of_way, solid, body) &&
                may_pass(distance_at_start, length_of_way, solid, body.half_thickness);
    plane.stopped = fast;
    plane.at = local_at_start;
    plane.distance = distance_at_start;
    plane.normal_there = normal_at_start;
    if (any(fast)) {
        Touch touch = first_touch(solid, local_at_start, local, distance_at_start, normal_at_start,
                                  touching_distance(distance_at_start, body.half_thickness));
        plane.stopped = fast && touch.touches;
        plane.at = local_at_start + way * touch.time;
        plane.distance = touch.distance;
        plane.normal_there = touch.normal;
        gap = select(plane.stopped, dot(touch.normal, local - plane.at) + touch.distance - body.half_thickness, gap);
        normal = select(plane.stopped, touch.normal, normal);
    }
    plane.gap = gap;
    plane.gap_at_start = distance_at_start - body.half_thickness;
    plane.normal = normal;
    return plane;
}

// A particle that touched on its way may slide along the plane where it touched, but not into another part of the body.
// One that began inside may go where it is pushed.
WEFT_FN void keep_out(Solid solid, ContactBody body, inout_(vec3) x, real w, ContactPlane plane)
{
    if (!any(plane.stopped)) return;
    vec3 to = to_body(body, x);
    vec3 slide = to - plane.at;
    mask slides_far = plane.stopped && w > real(0) && plane.distance > real(0) &&
                      sqrt(dot(slide, slide)) * solid.steepness > plane.distance;
    if (!any(slides_far)) return;
    Touch touch =
        first_touch(solid, plane.at, to, plane.distance, plane.normal_there, real(0.5) * plane.distance);
    vec3 there = rotate(body.rx, body.ry, body.rz, plane.at + slide * touch.time) + body.position;
    x = select(slides_far && touch.touches, there, x);
}

// Contact of a particle that may touch the body.
//   x, start       the particle now and at the start of the substep
//   local, local_at_start   the same in the body's frame
//   gap, normal    at `local`: distance minus half the thickness; in the body's frame
WEFT_FN void contact_particle(Solid solid, ContactBody body, inout_(vec3) x, vec3 start, real w,
                              inout_(ContactSum) sum, vec3 local, vec3 local_at_start, real gap, vec3 normal)
{
    ContactPlane plane = contact_plane(solid, body, sum, local, local_at_start, gap, normal);
    project_contact(x, start, w, sum, plane.gap, plane.gap_at_start,
                    rotate(body.rx, body.ry, body.rz, plane.normal), carried_by(body, local), body);
    keep_out(solid, body, x, w, plane);
}
