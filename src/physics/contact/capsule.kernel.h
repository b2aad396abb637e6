// Capsule along the collider's y axis: a segment with a radius.
//   numbers  radius [m], half the length of the segment [m], unused, unused

WEFT_FN real distance_capsule(vec3 p, ShapeNumbers s, out_(vec3) normal)
{
    vec3 d = vec3(p.x, p.y - min(max(p.y, -s.n1), s.n1), p.z);
    real len2 = dot(d, d);
    real len = sqrt(len2);
    mask off_axis = len2 > real(1e-20);   // on the axis all directions are equal: use x
    normal = select(off_axis, d * (real(1) / max(len, real(1e-10))), vec3(real(1), real(0), real(0)));
    return len - s.n0;
}
