// A vertex of a render mesh that follows a triangle of the simulated mesh: computes the frame at its bound point.

struct FollowFrame {
    vec3 origin;  // the bound point on the curved triangle
    vec3 x;       // the triangle's first side, projected perpendicular to z
    vec3 y;
    vec3 z;  // the interpolated normal
};

WEFT_FN vec3 out_of(FollowFrame f, vec3 v) { return f.x * v.x + f.y * v.y + f.z * v.z; }

// A unit vector perpendicular to the unit vector n: the projection of `wish` if it is long enough.
WEFT_FN vec3 across_toward(vec3 n, vec3 wish)
{
    vec3 laid = wish - n * dot(wish, n);
    real len2 = dot(laid, laid);
    mask able = len2 > real(1e-6) * dot(wish, wish);
    return select(able, laid * inversesqrt(select(able, len2, real(1))), any_across(n));
}

// Half of the weighted distance of the flat point from the tangent plane of a corner, as a vector along the normal n.
WEFT_FN vec3 phong_step(vec3 flat_point, vec3 corner, vec3 n, real weight)
{
    return n * (real(0.5) * weight * dot(flat_point - corner, n));
}

// Corners a, b, c with unit normals; b and c have the weights wb and wc, a the rest. Phong tessellation (Boubekeur and
// Alexa 2008): moves the point of the flat triangle halfway toward its projections onto the tangent planes of the
// corners. Halfway matches a surface of constant curvature to second order (an arc of half-angle phi over a chord 2L
// rises by L phi/2, the projections by L phi). Neighboring triangles meet along their common side, because there both
// depend only on its two ends.
WEFT_FN FollowFrame follow_frame(vec3 a, vec3 b, vec3 c, vec3 na, vec3 nb, vec3 nc, real wb, real wc)
{
    real wa = real(1) - wb - wc;
    vec3 flat_point = a * wa + b * wb + c * wc;
    vec3 n = na * wa + nb * wb + nc * wc;
    FollowFrame f;
    f.origin = flat_point - phong_step(flat_point, a, na, wa);
    f.origin = f.origin - phong_step(flat_point, b, nb, wb);
    f.origin = f.origin - phong_step(flat_point, c, nc, wc);
    // If the normals cancel, use an arbitrary direction.
    real len2 = dot(n, n);
    mask able = len2 > real(1e-12);
    f.z = select(able, n * inversesqrt(select(able, len2, real(1))), vec3(real(0), real(1), real(0)));
    f.x = across_toward(f.z, b - a);
    f.y = cross(f.z, f.x);
    return f;
}
