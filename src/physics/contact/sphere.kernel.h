// Sphere around the collider's origin.
//   numbers  radius [m], unused, unused, unused

WEFT_FN real distance_sphere(vec3 p, ShapeNumbers s, out_(vec3) normal)
{
    real len2 = dot(p, p);
    real len = sqrt(len2);
    mask off_center = len2 > real(1e-20);   // at the center all directions are equal: use y
    normal = select(off_center, p * (real(1) / max(len, real(1e-10))), vec3(real(0), real(1), real(0)));
    return len - s.n0;
}
