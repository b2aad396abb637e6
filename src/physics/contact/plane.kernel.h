// Half space: the solid lies below the plane.
//   numbers  normal x, y, z (unit), offset [m]

WEFT_FN real distance_plane(vec3 p, ShapeNumbers s, out_(vec3) normal)
{
    normal = vec3(s.n0, s.n1, s.n2);
    return dot(normal, p) - s.n3;
}
