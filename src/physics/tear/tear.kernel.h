// Tension in the plane of a cloth, from the lengths of its triangles' sides (law: tear.md).

// A side of a triangle at rest.
struct TearSide {
    real rest;         // m
    real pull, push;   // N/m: stiffness k(phi) in the direction of the side, longer and shorter than at rest
    real x, y;         // unit: its direction at rest, along warp and weft
    real play;         // strain at which its threads are straight
};

#define WEFT_TEAR_SIDE_NUMBERS 6u

// A symmetric tensor in the plane: stress in N/m, in the axes of warp (x) and weft (y).
struct PlaneStress {
    real mean;   // (xx + yy) / 2
    real difference;   // (xx - yy) / 2
    real mixed;  // xy
};

// Principal values and the direction of the larger one.
struct Tension {
    real most, least;  // N/m
    real x, y;         // unit, along warp and weft; the warp if all directions are alike
};

WEFT_FN PlaneStress no_stress()
{
    PlaneStress s;
    s.mean = real(0);
    s.difference = real(0);
    s.mixed = real(0);
    return s;
}

WEFT_FN PlaneStress add_stress(PlaneStress a, PlaneStress b, real weight)
{
    PlaneStress s;
    s.mean = a.mean + b.mean * weight;
    s.difference = a.difference + b.difference * weight;
    s.mixed = a.mixed + b.mixed * weight;
    return s;
}

// Length over length at rest, minus 1. A side without length at rest has no strain.
WEFT_FN real side_strain(vec3 a, vec3 b, TearSide side)
{
    vec3 d = b - a;
    mask able = side.rest > real(1e-10);
    real strain = (sqrt(dot(d, d)) - side.rest) / select(able, side.rest, real(1));
    return select(able, strain, real(0));
}

// k eps n N^T of one side, made symmetric: N is its direction at rest, n = (x, y) its present one, without the triangle's
// rotation.
WEFT_FN PlaneStress side_stress(real strain, TearSide side, real x, real y)
{
    StretchSpring spring = stretch_spring(strain, side.play);
    real part = select(strain > real(0), side.pull, side.push) * spring.c / spring.share * real(0.5);
    PlaneStress s;
    s.mean = part * (x * side.x + y * side.y);
    s.difference = part * (x * side.x - y * side.y);
    s.mixed = part * (x * side.y + y * side.x);
    return s;
}

// The rotation of a triangle in its plane: cosine and sine of the angle from the axes of warp and weft to those in which
// its sides are (u, 0) and v, from the polar decomposition of its deformation.
struct TearRotation {
    real c, s;
};

WEFT_FN TearRotation triangle_rotation(real u, real vx, real vy, TearSide ab, TearSide bc)
{
    real ux0 = ab.rest * ab.x, uy0 = ab.rest * ab.y, vx0 = bc.rest * bc.x, vy0 = bc.rest * bc.y;
    mask turned = ux0 * vy0 - uy0 * vx0 < real(0);   // the axes of warp and weft see the triangle from behind
    real height = select(turned, -vy, vy);
    real c = u * vy0 - vx * uy0 + height * ux0;
    real s = u * vx0 - vx * ux0 - height * uy0;
    c = select(turned, -c, c);
    s = select(turned, -s, s);
    real size2 = c * c + s * s;
    mask able = size2 > real(1e-30);
    real inverse = real(1) / sqrt(select(able, size2, real(1)));
    TearRotation r;
    r.c = select(able, c * inverse, real(1));
    r.s = select(able, s * inverse, real(0));
    return r;
}

// Stress of a side that runs along (x, y) in the axes that triangle_rotation() has turned.
WEFT_FN PlaneStress turned_side_stress(real x, real y, TearSide side, TearRotation r)
{
    real length = sqrt(x * x + y * y);
    mask able = side.rest > real(1e-10), has_direction = length > real(1e-20);
    real inverse = real(1) / select(has_direction, length, real(1));
    real strain = select(able, (length - side.rest) / select(able, side.rest, real(1)), real(0));
    return side_stress(strain, side, select(has_direction, (r.c * x + r.s * y) * inverse, side.x),
                       select(has_direction, (r.c * y - r.s * x) * inverse, side.y));
}

// A triangle in its plane: its sides are (u, 0), (vx, height) and the one that closes it.
struct TearFlat {
    real u, vx, height;
    TearRotation turned;   // from the axes of warp and weft
};

WEFT_FN TearFlat lay_flat(vec3 a, vec3 b, vec3 c, TearSide ab, TearSide bc)
{
    vec3 first = b - a, second = c - b;
    TearFlat laid;
    laid.u = sqrt(dot(first, first));
    mask able = laid.u > real(1e-20);
    vec3 along = first * select(able, real(1) / select(able, laid.u, real(1)), real(0));
    laid.vx = dot(second, along);
    vec3 aside = second - along * laid.vx;
    real vy = sqrt(dot(aside, aside));
    laid.turned = triangle_rotation(laid.u, laid.vx, vy, ab, bc);
    laid.height = select(ab.x * bc.y - ab.y * bc.x < real(0), -vy, vy);
    return laid;
}

// Mean stress of a triangle whose sides are springs: force per width at rest, in the axes of warp and weft that move with
// it.
WEFT_FN PlaneStress springs_stress(TearFlat f, TearSide ab, TearSide bc, TearSide ca)
{
    PlaneStress s = turned_side_stress(f.u, real(0), ab, f.turned);
    s = add_stress(s, turned_side_stress(f.vx, f.height, bc, f.turned), real(1));
    return add_stress(s, turned_side_stress(-f.u - f.vx, -f.height, ca, f.turned), real(1));
}

// What a membrane adds to the springs of a triangle's sides: the energy per area 1/2 g Q g, with the Green strains g of the
// sides ab, bc and ca. These are the numbers of Q, which is symmetric, in N/m.
struct TearCoupling {
    real ab, bc, ca, ab_bc, bc_ca, ca_ab;
};

// Green strain of a side that runs along (x, y).
WEFT_FN real side_green(real x, real y, TearSide side)
{
    mask able = side.rest > real(1e-10);
    real inverse = real(1) / select(able, side.rest, real(1));
    x = x * inverse;
    y = y * inverse;
    return select(able, real(0.5) * (x * x + y * y - real(1)), real(0));
}

// q l/l0 n N^T of one side, made symmetric: q is the derivative of the energy by its Green strain.
WEFT_FN PlaneStress green_stress(real q, real x, real y, TearSide side, TearRotation r)
{
    mask able = side.rest > real(1e-10);
    real part = select(able, q * real(0.5) / select(able, side.rest, real(1)), real(0));
    real nx = r.c * x + r.s * y, ny = r.c * y - r.s * x;
    PlaneStress s;
    s.mean = part * (nx * side.x + ny * side.y);
    s.difference = part * (nx * side.x - ny * side.y);
    s.mixed = part * (nx * side.y + ny * side.x);
    return s;
}

// The part of a membrane's stress that its springs do not have.
WEFT_FN PlaneStress coupling_stress(TearFlat f, TearSide ab, TearSide bc, TearSide ca, TearCoupling q)
{
    real last_x = -f.u - f.vx;
    real g0 = side_green(f.u, real(0), ab), g1 = side_green(f.vx, f.height, bc), g2 = side_green(last_x, -f.height, ca);
    PlaneStress s = green_stress(q.ab * g0 + q.ab_bc * g1 + q.ca_ab * g2, f.u, real(0), ab, f.turned);
    s = add_stress(s, green_stress(q.ab_bc * g0 + q.bc * g1 + q.bc_ca * g2, f.vx, f.height, bc, f.turned), real(1));
    return add_stress(s, green_stress(q.ca_ab * g0 + q.bc_ca * g1 + q.ca * g2, last_x, -f.height, ca, f.turned), real(1));
}

// The same tensor in axes from which the present ones are turned by an angle; c2, s2: cosine and sine of twice that.
WEFT_FN PlaneStress turn_stress(PlaneStress s, real c2, real s2)
{
    PlaneStress t;
    t.mean = s.mean;
    t.difference = s.difference * c2 - s.mixed * s2;
    t.mixed = s.difference * s2 + s.mixed * c2;
    return t;
}

WEFT_FN Tension principal_tension(PlaneStress s)
{
    real radius = sqrt(s.difference * s.difference + s.mixed * s.mixed);
    mask apart = radius > real(0);
    real inverse = real(1) / select(apart, radius, real(1));
    // Half of the angle whose cosine is difference / radius. The component that is at least 1/sqrt(2) comes from the root,
    // the other one from the sine, so that neither cancels.
    real large = sqrt(real(0.5) + real(0.5) * abs(s.difference) * inverse);
    real small = real(0.5) * s.mixed * inverse / large;
    mask along_warp = !(s.difference < real(0));
    Tension t;
    t.most = s.mean + radius;
    t.least = s.mean - radius;
    t.x = select(apart, select(along_warp, large, small), real(1));
    t.y = select(apart, select(along_warp, small, large), real(0));
    return t;
}

// Square of the cosine of the angle between a side and the direction (x, y). The axes of (x, y) are turned from those of the
// side as turn_stress() has it.
WEFT_FN real side_cos2(TearSide side, real c2, real s2, real x, real y)
{
    real side_c2 = side.x * side.x - side.y * side.y, side_s2 = real(2) * side.x * side.y;
    return real(0.5) + real(0.5) * ((side_c2 * c2 - side_s2 * s2) * (x * x - y * y) +
                                    (side_c2 * s2 + side_s2 * c2) * (real(2) * x * y));
}

// Stiffness of a side against strain in the direction (x, y): k cos^4 of the angle between them.
WEFT_FN real side_stiffness(TearSide side, real c2, real s2, real x, real y)
{
    real cos2 = side_cos2(side, c2, s2, x, y);
    return side.pull * cos2 * cos2;
}

// The stiffness of a membrane that its springs do not have.
WEFT_FN real coupling_stiffness(TearSide ab, TearSide bc, TearSide ca, TearCoupling q, real c2, real s2, real x, real y)
{
    real g0 = side_cos2(ab, c2, s2, x, y), g1 = side_cos2(bc, c2, s2, x, y), g2 = side_cos2(ca, c2, s2, x, y);
    return q.ab * g0 * g0 + q.bc * g1 * g1 + q.ca * g2 * g2 +
           real(2) * (q.ab_bc * g0 * g1 + q.bc_ca * g1 * g2 + q.ca_ab * g2 * g0);
}

// 1 / strength in the direction (x, y), m/N: 1/S = cos^2/S_warp + sin^2/S_weft. Takes 1/S_warp and 1/S_weft, 0 where
// there is no limit.
WEFT_FN real inverse_strength(real x, real y, real warp, real weft) { return x * x * warp + y * y * weft; }

// The factor c of the limit at the end of a cut, squared. It is calibrated: a rubber strip with a long cut then rips when
// the rip frees its energy (tear.md).
#define WEFT_CUT_END_FACTOR_SQUARED 0.32

// 1 / limit at the end of a cut, m/N: limit = c sqrt(energy stiffness / edge). `stiffness` is in N/m, `edge` in m.
WEFT_FN real inverse_cut_limit(real stiffness, real edge, real energy)
{
    real square = real(WEFT_CUT_END_FACTOR_SQUARED) * energy * stiffness;
    mask limited = square > real(0);
    return select(limited, sqrt(edge / select(limited, square, real(1))), real(0));
}
