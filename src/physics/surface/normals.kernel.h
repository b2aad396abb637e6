// Normals: the normalized sum of the area-weighted normals of the triangles at a particle, smoothed once.
// surface/normals.md says why.

// Twice the area times the unit normal.
WEFT_FN vec3 face_normal(vec3 a, vec3 b, vec3 c) { return cross(b - a, c - a); }

// Returns +y instead of NaN if the faces of a particle cancel, vanish or exceed the range of a float.
WEFT_FN vec3 unit_normal(vec3 sum)
{
    real len2 = dot(sum, sum);
    return select(len2 > real(1e-30) && len2 < real(1e38), sum * inversesqrt(max(len2, real(1e-30))), vec3(real(0), real(1), real(0)));
}

// The sum of the unit normals at the corners, weighted by the area: `face` is the triangle's face_normal.
WEFT_FN vec3 smooth_face(vec3 face, vec3 at_a, vec3 at_b, vec3 at_c)
{
    return (at_a + at_b + at_c) * sqrt(dot(face, face));
}
