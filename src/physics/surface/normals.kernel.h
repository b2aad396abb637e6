// Normals: the normalized sum of the area-weighted normals of the triangles at a particle.

// Twice the area times the unit normal.
WEFT_FN vec3 face_normal(vec3 a, vec3 b, vec3 c) { return cross(b - a, c - a); }

// Returns +y instead of NaN if the faces of a particle cancel, vanish or exceed the range of a float.
WEFT_FN vec3 unit_normal(vec3 sum)
{
    real len2 = dot(sum, sum);
    return select(len2 > real(1e-30) && len2 < real(1e38), sum * inversesqrt(max(len2, real(1e-30))), vec3(real(0), real(1), real(0)));
}
