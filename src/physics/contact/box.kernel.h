// Box around the collider's origin, along its axes.
//   numbers  half extents x, y, z [m], unused

WEFT_FN real distance_box(vec3 p, ShapeNumbers s, out_(vec3) normal)
{
    vec3 side = vec3(select(p.x < real(0), real(-1), real(1)), select(p.y < real(0), real(-1), real(1)),
                     select(p.z < real(0), real(-1), real(1)));
    vec3 q = vec3(abs(p.x) - s.n0, abs(p.y) - s.n1, abs(p.z) - s.n2);

    // Outside, the nearest point lies on a face, an edge or a corner, and the excess over the extents points away from
    // it. Inside, the normal is that of the nearest face.
    vec3 beyond = vec3(max(q.x, real(0)), max(q.y, real(0)), max(q.z, real(0)));
    real len2 = dot(beyond, beyond);
    mask outside = len2 > real(0);
    real len = sqrt(len2);
    real inner = max(q.x, max(q.y, q.z));
    real zero = real(0);
    real one = real(1);
    mask x_face = !(q.x < inner);
    mask y_face = !(q.y < inner);
    vec3 face = select(x_face, vec3(one, zero, zero), select(y_face, vec3(zero, one, zero), vec3(zero, zero, one)));
    vec3 n = select(outside, beyond * (one / max(len, real(1e-20))), face);
    normal = vec3(n.x * side.x, n.y * side.y, n.z * side.z);
    return select(outside, len, inner);
}
