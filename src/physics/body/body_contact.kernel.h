// Contact with a body that is moved by what touches it (law: body.md).

// A body as one of its contacts sees it.
struct MovedBody {
    real contacts;       // so many share the body: each moves a part of it of this fraction of its mass (Tonge et al. 2012)
    real inverse_mass;   // 1/kg
    vec3 center;         // m, of mass
    vec3 ix, iy, iz;     // columns of the inverse tensor of inertia, world axes, 1/(kg m2)
};

// 1/kg: the inverse mass with which the body answers a push at `lever` from its center, along a unit vector.
WEFT_FN real weight_of(MovedBody moved, vec3 lever, vec3 along)
{
    vec3 turning = cross(lever, along);
    return moved.contacts * (moved.inverse_mass + dot(turning, rotate(moved.ix, moved.iy, moved.iz, turning)));
}

// 1/kg: the largest of these over all directions. The inverse mass of a point that is attached to the body: where the
// body is heavier, constraints that pull at the point only move it less than they could.
WEFT_FN real most_weight_of(MovedBody moved, vec3 lever)
{
    // Columns of the symmetric matrix that turns an impulse at the lever into the motion there. The lever has the
    // eigenvalue 0, so the two others follow from the trace and the sum of the principal minors.
    vec3 x = cross(rotate(moved.ix, moved.iy, moved.iz, vec3(real(0), lever.z, -lever.y)), lever);
    vec3 y = cross(rotate(moved.ix, moved.iy, moved.iz, vec3(-lever.z, real(0), lever.x)), lever);
    vec3 z = cross(rotate(moved.ix, moved.iy, moved.iz, vec3(lever.y, -lever.x, real(0))), lever);
    real trace = x.x + y.y + z.z;
    real minors = x.x * y.y - x.y * y.x + (y.y * z.z - y.z * z.y) + (x.x * z.z - x.z * z.x);
    real apart = sqrt(max(trace * trace - real(4) * minors, real(0)));
    return moved.contacts * (moved.inverse_mass + (trace + apart) * real(0.5));
}

// Like project_contact(), but the particle makes only its share of the way, by its inverse mass and that of its part of
// the body. The body makes the rest, by the opposite impulse. In later iterations a contact also takes back a push that
// others have made unnecessary.
//
// A particle with a support goes no farther than to the support. What the body presses beyond that moves the body alone.
//   undone   m: what the contact asks of the particle beyond its displacement, because the support acts on it too
WEFT_FN void project_body_contact(inout_(vec3) x, vec3 start, real w, inout_(ContactSum) sum, real gap, real gap_start,
                                  vec3 normal, vec3 carried, ContactBody body, MovedBody moved,
                                  inout_(Support) support, out_(vec3) undone)
{
    mask moves = w > real(0);
    vec3 lever = x - moved.center;
    real by_body = weight_of(moved, lever, normal);
    real share = w / select(moves, w + by_body, real(1));

    // A push of the length dn moves the particle by dn along the normal, but only `yielding` of that once it has reached
    // the support.
    real facing = -dot(normal, support.normal);
    mask may_hold = moves && by_body > real(0) && dot(support.normal, support.normal) > real(0);
    mask faces = may_hold && facing > real(WEFT_LEAST_FACING);
    real lift = select(faces, body.depenetration * real(WEFT_SLOW_LIFT), body.depenetration);
    real need = min(real(0), gap_start + lift) - gap;
    real room = room_before(support, x, start, normal, body.depenetration);
    real taken = support.pushed / select(faces, facing, real(1));
    real firm = real(1) - yielding_on_support(facing, support.friction);
    real wanted = (need - select(faces, taken * firm, real(0))) * share;
    real against = (need - room * firm) * w / select(faces, (real(1) - firm) * w + by_body, real(1));
    real dn = select(moves, max(select(faces, max(wanted, against), wanted), -sum.push), real(0));
    // A contact that does not push leaves the support alone.
    mask held = may_hold && max(sum.push, sum.push + dn) > real(0);
    sum.push = sum.push + dn;

    // Friction of the support, that of the body, and again that of the support: a particle that slides on the support is
    // stopped by the body alone, one that rests there is held by both.
    vec3 before = x;
    ContactSum back;
    back.push = support.pushed;
    back.friction = support.rubbed;
    real over = height_over(support, x, start, body.depenetration);
    move_on_support(x, back, support, start, over, normal * dn);
    x = select(held, x, before + normal * dn);

    vec3 way = x - start - carried;
    vec3 slip = way - normal * dot(way, normal);
    real length_of_slip = sqrt(max(dot(slip, slip), real(1e-30)));
    vec3 along = slip * (real(1) / length_of_slip);
    real across = weight_of(moved, lever, along);
    real part = w / select(moves, w + across, real(1));
    real free = min(length_of_slip, max(dot(x - start - support.carried, along), real(0)));
    real rest = length_of_slip - free;
    real most = rest + most_on_support(back, support, along);
    real stopped = free * part + min(rest * w / select(held, max(across, real(1e-30)), real(1)), most * part);
    vec3 rubbed = vec3(real(0), real(0), real(0));
    vec3 friction = sum.friction;
    rub_along(rubbed, sum, friction - select(held, along * stopped, slip * part), body);
    vec3 held_x = x;
    move_on_support(held_x, back, support, start, height_over(support, x, start, body.depenetration), rubbed);
    x = select(held, held_x, x + rubbed);
    support.pushed = select(held, back.push, support.pushed);
    support.rubbed = select(held, back.friction, support.rubbed);
    undone = select(held, (normal * dn + rubbed) - (x - before), vec3(real(0)));
}

// contact_particle() for a body that is moved.
//   number   of the body
WEFT_FN void contact_moved_body(Solid solid, ContactBody body, MovedBody moved, real number, inout_(vec3) x, vec3 start,
                                real w, inout_(ContactSum) sum, vec3 local, vec3 local_at_start, real gap, vec3 normal,
                                inout_(Support) support, out_(vec3) undone)
{
    ContactPlane plane = contact_plane(solid, body, sum, local, local_at_start, gap, normal);
    vec3 carried = carried_by(body, local), out_of = rotate(body.rx, body.ry, body.rz, plane.normal);
    real gap_to = plane.gap, inside = min(room_before(support, x, start, out_of, body.depenetration), real(0));
    mask presses = w > real(0) && (sum.push > real(0) || gap_to + inside < real(0));
    keep_plane(support, number, x - start - carried, presses, gap_to, out_of);
    project_body_contact(x, start, w, sum, gap_to, plane.gap_at_start, out_of, carried, body, moved, support, undone);
    keep_out(solid, body, x, w, plane);
}

// A contact of a body with another one or with a collider. It keeps a point of the first on one side of a plane.
struct BodyRow {
    vec3 normal;        // world, toward the first
    real gap_at_start;  // of the substep, m
    real static_friction, kinetic_friction;
};

// A body that does not give way.
WEFT_FN MovedBody immovable()
{
    MovedBody body;
    vec3 zero = vec3(real(0), real(0), real(0));
    body.contacts = real(0);
    body.inverse_mass = real(0);
    body.center = zero;
    body.ix = zero;
    body.iy = zero;
    body.iz = zero;
    return body;
}

// What the first body gains: kg m, the impulse times the length of the substep. The second one loses it.
//   sum   of the substep so far, kg m
//   gap   m;  way   of the first body's point relative to the second's since the start of the substep, m
//   lever_a, lever_b   of the point, from the centers of mass
WEFT_FN vec3 project_body_row(BodyRow row, inout_(ContactSum) sum, real gap, vec3 way, MovedBody a, MovedBody b,
                              vec3 lever_a, vec3 lever_b)
{
    real goal = min(real(0), row.gap_at_start);
    real w = weight_of(a, lever_a, row.normal) + weight_of(b, lever_b, row.normal);
    real change = max((goal - gap) / max(w, real(1e-30)), -sum.push);
    sum.push = sum.push + change;

    vec3 slip = way - row.normal * dot(way, row.normal);
    vec3 along = slip * inversesqrt(max(dot(slip, slip), real(1e-30)));
    real across = weight_of(a, lever_a, along) + weight_of(b, lever_b, along);
    ContactBody friction;
    friction.static_friction = row.static_friction;
    friction.kinetic_friction = row.kinetic_friction;
    vec3 gained = row.normal * change;
    rub_along(gained, sum, sum.friction - slip * (real(1) / max(across, real(1e-30))), friction);
    return gained;
}

// face_displacement() for a body that is moved.
//   carried   how far the body has moved the row's point since the row was made
WEFT_FN vec3 face_displacement_of_body(FaceRow row, vec3 point, real inverse_mass, inout_(ContactSum) sum, vec3 carried,
                                       MovedBody moved)
{
    ContactBody body;
    body.static_friction = row.static_friction;
    body.kinetic_friction = row.kinetic_friction;
    body.depenetration = row.depenetration * real(WEFT_SLOW_LIFT);
    Support behind = no_support();
    vec3 x = point, undone;
    project_body_contact(x, row.start, inverse_mass, sum, dot(row.normal, point - carried) + row.offset,
                         row.gap_at_start, row.normal, carried, body, moved, behind, undone);
    return (x - point) * select(inverse_mass > real(0), real(1) / max(inverse_mass, real(1e-30)), real(0));
}
