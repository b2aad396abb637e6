// Tangents: the direction in which u grows, for normal maps (tangents.md has the law).

struct TangentFrame {
    vec3 tangent;    // in which u grows
    vec3 bitangent;  // in which v grows
};

// Of a triangle with the corners a, b, c, from the UVs of b and c less those of a: the solution of
//     b - a = du1 tangent + dv1 bitangent,   c - a = du2 tangent + dv2 bitangent.
// UVs without an area give nothing.
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

// Some unit vector across a unit normal: the x or y axis, less what of it lies along the normal. Written out, as not
// every compiler of shaders keeps the sign of a difference from 0.
WEFT_FN vec3 any_across(vec3 n)
{
    vec3 of_x = vec3(real(1) - n.x * n.x, -(n.y * n.x), -(n.z * n.x));
    vec3 of_y = vec3(-(n.x * n.y), real(1) - n.y * n.y, -(n.z * n.y));
    vec3 t = select(abs(n.x) < real(0.7), of_x, of_y);
    return t * inversesqrt(max(dot(t, t), real(1e-30)));
}

// From the sum over the triangles at a vertex: laid into the plane of its normal, unit. `handedness` is 1 or -1:
// bitangent = handedness * cross(normal, tangent).
WEFT_FN vec3 unit_tangent(TangentFrame sum, vec3 n, out_(real) handedness)
{
    vec3 t = sum.tangent - n * dot(n, sum.tangent);
    real len2 = dot(t, t);
    // What the projection leaves of a tangent along the normal is rounding, not a direction.
    mask able = len2 > real(1e-30) && len2 > real(1e-10) * dot(sum.tangent, sum.tangent);
    t = select(able, t * inversesqrt(max(len2, real(1e-30))), any_across(n));
    handedness = select(dot(cross(n, t), sum.bitangent) < real(0), real(-1), real(1));
    return t;
}
