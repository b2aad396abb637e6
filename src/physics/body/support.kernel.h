// A support holds what is pushed at it, not past it: the least cosine between the push and the support's normal.
#define WEFT_LEAST_FACING 0.1
// Overlap of a body with faces, and with particles that have a support, is removed at this part of the speed of other
// overlap: the body moves, not the cloth, and keeps the velocity.
#define WEFT_SLOW_LIFT 0.1

// m/s: a faster particle slides on its support.
#define WEFT_SLIDING 0.002

// A particle between a body and a collider (law: body.md). What the body presses on it, the collider takes.

struct Support {
    vec3 normal;    // world, unit, out of the collider; zero: there is none
    real offset;    // m: the particle touches it where dot(normal, x) is this
    vec3 rubbed;    // m: displacement by the collider's friction, against that of bodies
    real pushed;    // m: displacement along the normal, likewise
    vec3 carried;   // m: how far the collider itself moves there in the substep
    real collider;  // its number
    real friction;  // of the pair: static, or kinetic if the particle slides
    real presser;   // number of the first body that presses on the particle in the substep, plus one; 0: none
    vec3 seen;      // world: normal of the plane of that body that the particle met then
    real height;    // m: the particle touches this plane where dot(seen, its way relative to the body) is -height
};

WEFT_FN Support no_support()
{
    Support support;
    support.normal = vec3(real(0), real(0), real(0));
    support.offset = real(0);
    support.rubbed = support.normal;
    support.pushed = real(0);
    support.carried = support.normal;
    support.collider = real(-1);
    support.friction = real(0);
    support.presser = real(0);
    support.seen = support.normal;
    support.height = real(0);
    return support;
}

// m: how far a particle is from where its support holds it. Negative: the collider will push it out. An overlap from before
// the substep may stay, but for a small part: what the body gains by it, it keeps as velocity.
WEFT_FN real height_over(Support support, vec3 x, vec3 start, real depenetration)
{
    real gap_at_start = dot(support.normal, start + support.carried) - support.offset;
    return dot(support.normal, x) - support.offset -
           min(real(0), gap_at_start + depenetration * real(WEFT_SLOW_LIFT));
}

// m: the same along the opposite of `normal`; far if no support faces it.
//   depenetration   m: it is not less than that, negative
WEFT_FN real room_before(Support support, vec3 x, vec3 start, vec3 normal, real depenetration)
{
    real facing = -dot(normal, support.normal);
    mask faces = facing > real(WEFT_LEAST_FACING);
    real room = height_over(support, x, start, depenetration) / select(faces, facing, real(1));
    return select(faces, max(room, -depenetration), real(1e30));
}

// A push against the support moves the particle by this part of what it would without support. The push of the support and
// its friction hold the rest: all of it, if the push is within the cone of friction.
//   facing   cosine of the angle between the push and the opposite of the support's normal, > 0
WEFT_FN real yielding_on_support(real facing, real friction)
{
    real aside = sqrt(max(real(1) - facing * facing, real(0)));
    return aside * max(aside - friction * facing, real(0));
}

// The coefficient of friction on the support in a substep. A particle that slid on it keeps sliding until friction stops
// it. Otherwise it would have to be pulled loose in each substep, and cloth that is dragged slowly would jerk.
//   velocity   m/s, of the particle relative to the support at the start of the substep
WEFT_FN real friction_on_support(vec3 velocity, vec3 normal, real static_friction, real kinetic_friction)
{
    vec3 slip = velocity - normal * dot(velocity, normal);
    return select(dot(slip, slip) > real(WEFT_SLIDING) * real(WEFT_SLIDING), kinetic_friction, static_friction);
}

// Of all colliders that a particle is near, the deepest supports it.
//   gap, normal   to the collider; world
WEFT_FN void support_by(inout_(Support) support, vec3 x, real gap, vec3 normal, real half_thickness, real friction,
                        real collider, vec3 carried)
{
    mask found = dot(support.normal, support.normal) > real(0);
    real least = select(found, dot(support.normal, x) - support.offset, half_thickness);
    mask better = gap < least;
    support.normal = select(better, normal, support.normal);
    support.offset = select(better, dot(normal, x) - gap, support.offset);
    support.carried = select(better, carried, support.carried);
    support.collider = select(better, collider, support.collider);
    support.friction = select(better, friction, support.friction);
}

// What a particle hands on to its support would move it by meters if nothing held it. So a later sweep must take it back
// along the normal along which it was given, also at a corner of the body, where a tenth of a millimeter may turn the normal
// by a right angle. The particle keeps the plane that it met first in the substep.
//   way      m: of the particle relative to the body, since the start of the substep
//   number   of the body
//   presses  whether the contact has pushed, or is going to
WEFT_FN void keep_plane(inout_(Support) support, real number, vec3 way, mask presses, inout_(real) gap,
                        inout_(vec3) normal)
{
    mask supported = presses && dot(support.normal, support.normal) > real(0);
    mask first = supported && support.presser < real(0.5);
    support.presser = select(first, number + real(1), support.presser);
    support.seen = select(first, normal, support.seen);
    support.height = select(first, gap - dot(normal, way), support.height);
    mask mine = supported && abs(support.presser - number - real(1)) < real(0.5);
    gap = select(mine, support.height + dot(support.seen, way), gap);
    normal = select(mine, support.seen, normal);
}

// Moves a particle that its support holds: what would take it into the support presses on that, what lifts it relieves
// that, and then friction of the support acts, as far as what it has taken allows.
//   over     m: height_over() before
WEFT_FN void move_on_support(inout_(vec3) x, inout_(ContactSum) back, Support support, vec3 start, real over, vec3 by)
{
    real pressed = max(-dot(support.normal, by) - max(over, real(0)), -back.push);
    x = x + by + support.normal * pressed;
    back.push = back.push + pressed;
    ContactBody behind;
    behind.static_friction = support.friction;
    behind.kinetic_friction = support.friction;
    vec3 way = x - start - support.carried;
    rub_along(x, back, back.friction - (way - support.normal * dot(way, support.normal)), behind);
}

// m: so far can a displacement against `along`, unit, grow until the friction of the support no longer holds it.
WEFT_FN real most_on_support(ContactSum back, Support support, vec3 along)
{
    // |friction + s across|² = hold² (push + s down)²
    real down = dot(along, support.normal), hold = support.friction * support.friction;
    vec3 across = along - support.normal * down;
    real a = dot(across, across) - hold * down * down;
    real b = dot(back.friction, across) - hold * back.push * down;
    real c = min(dot(back.friction, back.friction) - hold * back.push * back.push, real(0));
    real under = b * b - a * c, root = sqrt(max(under, real(0)));
    mask opens = b < real(0), never = select(opens, a - real(1e-6), under) < real(0);
    real last = select(opens, root - b, -c) / select(opens, max(a, real(1e-6)), max(b + root, real(1e-30)));
    return select(never, real(1e6), last);
}

// What the collider has taken counts as its own push, so its friction can be as large. Returns it, as a displacement.
WEFT_FN vec3 take_support(inout_(ContactSum) sum, inout_(ContactBody) body, Support support, real collider)
{
    mask mine = dot(support.normal, support.normal) > real(0) && abs(support.collider - collider) < real(0.5);
    // Both: what the support has held up to its limit must not slip back to kinetic friction now.
    body.static_friction = select(mine, support.friction, body.static_friction);
    body.kinetic_friction = select(mine, support.friction, body.kinetic_friction);
    real pushed = select(mine, support.pushed, real(0));
    vec3 rubbed = select(mine, support.rubbed, vec3(real(0), real(0), real(0)));
    sum.push = sum.push + pushed;
    sum.friction = sum.friction + rubbed;
    return support.normal * pushed + rubbed;
}
