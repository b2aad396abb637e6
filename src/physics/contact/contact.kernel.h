// Contact of a particle with a collider: (x - q).n >= thickness/2, hard, with positional Coulomb friction. The shapes
// supply distance and normal; the code below is the same for all of them.

struct ShapeNumbers {
    real n0, n1, n2, n3;
    ShapeBlocks data;   // of shapes that four numbers do not describe
};

// A collider's poses at the end and at the start of a substep.
struct ContactBody {
    vec3 rx, ry, rz, position;          // columns of the rotation
    vec3 rx0, ry0, rz0, position0;
    real static_friction, kinetic_friction;   // of the pair
    real half_thickness;                      // m
    real depenetration;                       // m    largest part of an old overlap that a substep removes
};

WEFT_FN vec3 rotate(vec3 rx, vec3 ry, vec3 rz, vec3 v) { return rx * v.x + ry * v.y + rz * v.z; }
WEFT_FN vec3 unrotate(vec3 rx, vec3 ry, vec3 rz, vec3 v) { return vec3(dot(rx, v), dot(ry, v), dot(rz, v)); }

WEFT_FN vec3 to_body(ContactBody body, vec3 x) { return unrotate(body.rx, body.ry, body.rz, x - body.position); }
WEFT_FN vec3 to_body_at_start(ContactBody body, vec3 x)
{
    return unrotate(body.rx0, body.ry0, body.rz0, x - body.position0);
}

// Displacement of the body's point `local` during the substep. Exactly 0 for a body at rest.
WEFT_FN vec3 carried_by(ContactBody body, vec3 local)
{
    return (rotate(body.rx, body.ry, body.rz, local) + body.position)
         - (rotate(body.rx0, body.ry0, body.rz0, local) + body.position0);
}

// Displacement of a particle by a contact since the start of the substep.
struct ContactSum {
    vec3 friction;  // m    tangential displacement
    real push;      // m    along the normal
};

// Replaces the friction of a contact by `wanted`, clamped to what its push allows.
WEFT_FN void rub_along(inout_(vec3) x, inout_(ContactSum) sum, vec3 wanted, ContactBody body)
{
    real len2 = dot(wanted, wanted);
    real hold = body.static_friction * sum.push;
    real rub = body.kinetic_friction * sum.push;
    mask slides = len2 > hold * hold;
    vec3 friction = select(slides, wanted * min(real(1), rub * inversesqrt(max(len2, real(1e-30)))), wanted);
    friction = select(sum.push > real(0), friction, vec3(real(0)));
    x = x + (friction - sum.friction);
    sum.friction = friction;
}

//   x, start           the particle now and at the start of the substep
//   gap, gap_start     its distance to the body minus half the thickness, now and then
//   normal             out of the body, unit, world
//   carried            how far the body itself moved at this point
WEFT_FN void project_contact(inout_(vec3) x, vec3 start, real w, inout_(ContactSum) sum,
                             real gap, real gap_start, vec3 normal, vec3 carried, ContactBody body)
{
    // New overlap is removed at once. Overlap from before the substep is removed at a limited speed, so that a cloth
    // placed inside a body is not ejected.
    real goal = min(real(0), gap_start + body.depenetration);
    real dn = select(w > real(0), max(goal - gap, real(0)), real(0));
    x = x + normal * dn;
    sum.push = sum.push + dn;

    // Friction is one displacement per substep; every iteration refines it and clamps it to Coulomb's disc.
    vec3 moved = x - start - carried;
    vec3 slip = moved - normal * dot(moved, normal);
    rub_along(x, sum, sum.friction - slip, body);
}
