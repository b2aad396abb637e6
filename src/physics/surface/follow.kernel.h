// A vertex of a drawn mesh that follows a triangle of the simulated one: the frame that stands there.

struct FollowFrame {
    vec3 origin;  // the bound point on the curved triangle
    vec3 x;       // along the triangle's first side, as far as that lies across z
    vec3 y;
    vec3 z;  // the interpolated normal
};

WEFT_FN vec3 out_of(FollowFrame f, vec3 v) { return f.x * v.x + f.y * v.y + f.z * v.z; }

// A unit vector across the unit vector n, toward `wish` as far as that goes.
WEFT_FN vec3 across_toward(vec3 n, vec3 wish)
{
    vec3 laid = wish - n * dot(wish, n);
    real len2 = dot(laid, laid);
    mask able = len2 > real(1e-6) * dot(wish, wish);
    return select(able, laid * inversesqrt(select(able, len2, real(1))), any_across(n));
}

// Of the triangle's flat point, how far it is moved against the normal of a corner.
WEFT_FN vec3 phong_step(vec3 flat_point, vec3 corner, vec3 n, real weight)
{
    return n * (real(0.5) * weight * dot(flat_point - corner, n));
}

// Of the corners a, b, c with their unit normals; the last two weigh wb and wc, the first the rest.
// Phong tessellation: the point of the flat triangle, moved toward its projections onto the tangent planes of the
// corners. Boubekeur and Alexa 2008. With half of the way a surface of constant curvature is met up to the second
// order (an arc of half-angle phi over a chord 2L rises by L phi/2, the projections by L phi), and neighbors meet along
// their common side, since there both depend on its two ends alone.
WEFT_FN FollowFrame follow_frame(vec3 a, vec3 b, vec3 c, vec3 na, vec3 nb, vec3 nc, real wb, real wc)
{
    real wa = real(1) - wb - wc;
    vec3 flat_point = a * wa + b * wb + c * wc;
    vec3 n = na * wa + nb * wb + nc * wc;
    FollowFrame f;
    f.origin = flat_point - phong_step(flat_point, a, na, wa);
    f.origin = f.origin - phong_step(flat_point, b, nb, wb);
    f.origin = f.origin - phong_step(flat_point, c, nc, wc);
    // Normals that cancel leave no direction; any will do, as long as it is one.
    real len2 = dot(n, n);
    mask able = len2 > real(1e-12);
    f.z = select(able, n * inversesqrt(select(able, len2, real(1))), vec3(real(0), real(1), real(0)));
    f.x = across_toward(f.z, b - a);
    f.y = cross(f.z, f.x);
    return f;
}
