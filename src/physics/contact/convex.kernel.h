// Convex polyhedron, rounded by a radius.
//   numbers  radius by which it is larger than its data [m], unused, unused, unused
//   data     block 0: count of planes (integer), count of edges (integer), unused, unused
//            block 1: center [m], radius of a ball around it that holds the polyhedron [m]
//            one block per plane: normal (unit, out of the polyhedron), offset [m]; all points of the polyhedron have
//            normal·(p - center) <= offset
//            two blocks per edge: one end minus the center [m], length [m]; unit vector to the other end, unused

// Part of the polyhedron's size and of the point's distance that rounding may shift a point across a plane.
#define WEFT_CONVEX_ROUNDING 1e-6

// Inside, the nearest point of the surface is on the plane with the largest distance d. Outside, it is the foot of p on
// that plane, if the foot is on the polyhedron: no point of the polyhedron is closer than the plane. Otherwise it is on
// an edge, corners included.
WEFT_FN real distance_convex(vec3 p, ShapeNumbers s, out_(vec3) normal)
{
    int planes = integer_of(s.data, 0);
    int edges = integer_of(s.data, 1);
    real size, offset, edge_length;
    vec3 local = p - block_of(s.data, 1, size);

    vec3 n = block_of(s.data, 2, offset);
    real d = dot(n, local) - offset;
    for (int i = 1; i < planes; ++i) {
        vec3 other = block_of(s.data, 2 + i, offset);
        real beyond = dot(other, local) - offset;
        mask farther = beyond > d;
        n = select(farther, other, n);
        d = select(farther, beyond, d);
    }
    normal = n;
    real rounding = real(WEFT_CONVEX_ROUNDING) * (size + abs(d));
    mask outside = d > rounding;
    if (!any(outside)) return d - s.n0;

    vec3 foot = local - n * d;
    real off = real(0);
    for (int i = 0; i < planes; ++i) {
        vec3 other = block_of(s.data, 2 + i, offset);
        off = max(off, dot(other, foot) - offset);
    }
    mask beside = outside && off > rounding;
    if (!any(beside)) return d - s.n0;

    vec3 from_edge = local;
    real least2 = real(3e38);
    for (int i = 0; i < edges; ++i) {
        int block = 2 + planes + 2 * i;
        vec3 r = local - block_of(s.data, block, edge_length);
        vec3 along = block_of(s.data, block + 1, offset);
        vec3 away = r - along * min(max(dot(r, along), real(0)), edge_length);
        real len2 = dot(away, away);
        mask closer = len2 < least2;
        from_edge = select(closer, away, from_edge);
        least2 = select(closer, len2, least2);
    }
    real len = sqrt(least2);
    normal = select(beside, from_edge * (real(1) / max(len, real(1e-15))), n);
    return select(beside, len, d) - s.n0;
}
