// Tension in the plane of a cloth, from the lengths of its triangles' sides (law: tear.md).

// A side of a triangle at rest.
struct TearSide {
    real rest;         // m
    real pull, push;   // N/m: stiffness k(phi) in the direction of the side, longer and shorter than at rest
    real x, y;         // unit: its direction at rest, along warp and weft
};

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
    real part = select(strain > real(0), side.pull, side.push) * strain * real(0.5);
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

// Mean stress of the triangle (a, b, c): force per width at rest, in the axes of warp and weft that move with it.
WEFT_FN PlaneStress triangle_stress(vec3 a, vec3 b, vec3 c, TearSide ab, TearSide bc, TearSide ca)
{
    vec3 first = b - a, second = c - b;
    real u = sqrt(dot(first, first));
    mask able = u > real(1e-20);
    vec3 along = first * select(able, real(1) / select(able, u, real(1)), real(0));
    real vx = dot(second, along);
    vec3 aside = second - along * vx;
    real vy = sqrt(dot(aside, aside));
    TearRotation r = triangle_rotation(u, vx, vy, ab, bc);
    mask turned = ab.x * bc.y - ab.y * bc.x < real(0);
    real height = select(turned, -vy, vy);
    PlaneStress s = turned_side_stress(u, real(0), ab, r);
    s = add_stress(s, turned_side_stress(vx, height, bc, r), real(1));
    return add_stress(s, turned_side_stress(-u - vx, -height, ca, r), real(1));
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

// Stiffness of a side against strain in the direction (x, y): k cos^4 of the angle between them. The axes of (x, y) are
// turned from those of the side as turn_stress() has it.
WEFT_FN real side_stiffness(TearSide side, real c2, real s2, real x, real y)
{
    real side_c2 = side.x * side.x - side.y * side.y, side_s2 = real(2) * side.x * side.y;
    real cos2 = real(0.5) + real(0.5) * ((side_c2 * c2 - side_s2 * s2) * (x * x - y * y) +
                                         (side_c2 * s2 + side_s2 * c2) * (real(2) * x * y));
    return side.pull * cos2 * cos2;
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
