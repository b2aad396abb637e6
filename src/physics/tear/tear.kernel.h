// Tension in the plane of a cloth, from the lengths of its triangles' sides (law: tear.md).

// A side of a triangle at rest.
struct TearSide {
    real rest;         // m
    real pull, push;   // N/m: stiffness k(phi) in the direction of the side, longer and shorter than at rest
    real c2, s2;       // cosine and sine of twice its angle to the warp
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

// k eps n n^T of one side, with n n^T = 1/2 (1 + cos 2phi, sin 2phi; sin 2phi, 1 - cos 2phi).
WEFT_FN PlaneStress side_stress(real strain, TearSide side)
{
    real part = select(strain > real(0), side.pull, side.push) * strain * real(0.5);
    PlaneStress s;
    s.mean = part;
    s.difference = part * side.c2;
    s.mixed = part * side.s2;
    return s;
}

// Mean stress of the triangle (a, b, c).
WEFT_FN PlaneStress triangle_stress(vec3 a, vec3 b, vec3 c, TearSide ab, TearSide bc, TearSide ca)
{
    PlaneStress s = side_stress(side_strain(a, b, ab), ab);
    s = add_stress(s, side_stress(side_strain(b, c, bc), bc), real(1));
    return add_stress(s, side_stress(side_strain(c, a, ca), ca), real(1));
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

// Stiffness of a side against strain in the direction (x, y): k cos^4 of the angle between them.
WEFT_FN real side_stiffness(TearSide side, real x, real y)
{
    real cos2 = real(0.5) + real(0.5) * (side.c2 * (x * x - y * y) + side.s2 * (real(2) * x * y));
    return side.pull * cos2 * cos2;
}

// 1 / strength in the direction (x, y), m/N: 1/S = cos^2/S_warp + sin^2/S_weft. Takes 1/S_warp and 1/S_weft, 0 where
// there is no limit.
WEFT_FN real inverse_strength(real x, real y, real warp, real weft) { return x * x * warp + y * y * weft; }

// The factor c of the limit at the end of a cut, squared: the mean of K/sqrt(2 pi r) over the first edge is
// sqrt(2/pi) K/sqrt(length).
#define WEFT_CUT_END_FACTOR_SQUARED 0.63661977236758134

// 1 / limit at the end of a cut, m/N: limit = c sqrt(energy stiffness / edge). `stiffness` is in N/m, `edge` in m.
WEFT_FN real inverse_cut_limit(real stiffness, real edge, real energy)
{
    real square = real(WEFT_CUT_END_FACTOR_SQUARED) * energy * stiffness;
    mask limited = square > real(0);
    return select(limited, sqrt(edge / select(limited, square, real(1))), real(0));
}
