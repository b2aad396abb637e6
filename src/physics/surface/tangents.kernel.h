// Tangents: the direction of increasing u, for normal maps (law: tangents.md).

struct TangentFrame {
    vec3 tangent;    // direction of increasing u
    vec3 bitangent;  // direction of increasing v
};

// Of a triangle with the corners a, b, c, from the UVs of b and c less those of a: the solution of b - a = du1 tangent
// + dv1 bitangent,   c - a = du2 tangent + dv2 bitangent. The result is zero if the UVs have no area.
WEFT_FN TangentFrame face_tangents(vec3 a, vec3 b, vec3 c, real du1, real dv1, real du2, real dv2)
{
    vec3 e1 = b - a;
    vec3 e2 = c - a;
    real det = du1 * dv2 - du2 * dv1;
    real size = abs(du1 * dv2) + abs(du2 * dv1);
    mask able = abs(det) > size * real(1e-6) && size > real(1e-30);
    real inverse = real(1) / select(able, det, real(1));
    TangentFrame frame;
    frame.tangent = select(able, (e1 * dv2 - e2 * dv1) * inverse, vec3(real(0)));
    frame.bitangent = select(able, (e2 * du1 - e1 * du2) * inverse, vec3(real(0)));
    return frame;
}

// A unit vector perpendicular to a unit normal: the x or y axis minus its component along the normal. Written out,
// because not every shader compiler keeps the sign of a difference from 0.
WEFT_FN vec3 any_across(vec3 n)
{
    vec3 of_x = vec3(real(1) - n.x * n.x, -(n.y * n.x), -(n.z * n.x));
    vec3 of_y = vec3(-(n.x * n.y), real(1) - n.y * n.y, -(n.z * n.y));
    vec3 t = select(abs(n.x) < real(0.7), of_x, of_y);
    return t * inversesqrt(max(dot(t, t), real(1e-30)));
}

// The sum over the triangles at a vertex, projected onto the plane of its normal and normalized. `handedness` is 1 or
// -1: bitangent = handedness * cross(normal, tangent).
WEFT_FN vec3 unit_tangent(TangentFrame sum, vec3 n, out_(real) handedness)
{
    vec3 t = sum.tangent - n * dot(n, sum.tangent);
    real len2 = dot(t, t);
    // If the tangent is parallel to the normal, its projection is only rounding error.
    mask able = len2 > real(1e-30) && len2 > real(1e-10) * dot(sum.tangent, sum.tangent);
    t = select(able, t * inversesqrt(max(len2, real(1e-30))), any_across(n));
    handedness = select(dot(cross(n, t), sum.bitangent) < real(0), real(-1), real(1));
    return t;
}
