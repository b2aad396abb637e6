// Shelter from the wind: whether a collider stands in the way of the air (law: air.md). One text for all shapes.

// Follows the ray from a point to its end, in the body's frame. On a convex shape the distance along a ray is convex: a
// step to the tangent plane never leads past the surface, and where the distance grows it does so from then on. On other
// shapes a step is as long as the distance allows, and at least 1/32 of the way, but not past a tangent plane.
//   ray       unit vector, from which the air comes
//   reach     m, length of the way
// A point on the surface is not in its shelter if the ray leads out of the shape.
WEFT_FN mask is_sheltered(Solid solid, vec3 from, vec3 ray, real reach)
{
    mask convex = !(solid.steepness > real(1));
    mask goes_on = reach > real(0);
    mask hit = reach < real(0);
    mask outside = hit;   // at the last point
    real t = real(0);
    // Without a return in the loop, which some drivers compile wrongly.
    for (int step = 0; step < 48 && any(goes_on); ++step) {
        vec3 normal;
        real distance = solid_distance(solid, from + ray * t, normal);
        real approach = -dot(normal, ray);
        mask nears = approach > real(0.01);
        mask arrives = (nears && distance < real(1e-4)) || (outside && distance < real(0));
        hit = hit || (goes_on && arrives);
        outside = distance > real(0);

        real to_plane = distance / max(approach, real(0.01));
        real least = select(nears, min(to_plane, reach * real(1.0 / 32.0)), reach * real(1.0 / 32.0));
        t = t + select(convex, to_plane, max(distance / solid.steepness, max(least, real(1e-5))));
        goes_on = goes_on && !arrives && (nears || !convex) && t < reach;
    }
    return hit;
}
