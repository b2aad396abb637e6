// Tapered capsule along the collider's y axis: two balls and the cone that touches both.
//   numbers  radius of the ball at -half_height [m], radius of the one at +half_height [m], half_height [m],
//            slope: the difference of the radii, divided by the distance of the centers; 1 or -1 if the first or the
//            second ball holds the other one
//
// In the half plane of p and the axis, with r the distance to the axis, the cone is a line with the normal (c, slope),
// c = sqrt(1 - slope²). It touches each ball where the ball's radius is parallel to the normal. The lines through the
// centers along the normal therefore separate the points that are nearest to a ball from those nearest to the cone.

WEFT_FN real distance_tapered_capsule(vec3 p, ShapeNumbers s, out_(vec3) normal)
{
    real zero = real(0);
    real one = real(1);
    real slope = s.n3;
    real c = sqrt(max((one - slope) * (one + slope), zero));
    real r2 = p.x * p.x + p.z * p.z;
    mask off_axis = r2 > real(1e-20);   // on the axis all directions are equal: use x
    real r = select(off_axis, sqrt(r2), zero);
    real inv_r = one / max(r, real(1e-10));
    real side_x = select(off_axis, p.x * inv_r, one);
    real side_z = select(off_axis, p.z * inv_r, zero);

    // Along the cone's line, from where it touches the first ball to where it touches the second one.
    real y = p.y + s.n2;
    real along = c * y - slope * r;
    mask first = along < zero || !(slope < one);
    mask second = !first && (along > c * (s.n2 + s.n2) || !(slope > -one));
    mask ball = first || second;

    real up = select(second, p.y - s.n2, y);
    real len2 = r * r + up * up;
    real len = sqrt(len2);
    mask off_center = len2 > real(1e-20);
    real inv = one / max(len, real(1e-10));
    real n_side = select(ball, select(off_center, r * inv, one), c);
    real n_up = select(ball, select(off_center, up * inv, zero), slope);
    normal = vec3(side_x * n_side, n_up, side_z * n_side);
    return select(ball, len - select(second, s.n1, s.n0), c * r + slope * y - s.n0);
}
