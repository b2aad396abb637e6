// An edge of cloth that passes through a triangle (law: cloth_contact.md).

struct PassingEdge {
    mask passes;
    real w0, w1, w2, w3, w4;  // the point of the edge minus that of the triangle is the sum of w_i x_i, 0 where they meet
};

// `a`, `b`: the edge; `c`, `d`, `e`: the triangle.
WEFT_FN PassingEdge edge_through_triangle(vec3 a, vec3 b, vec3 c, vec3 d, vec3 e)
{
    vec3 normal = cross(d - c, e - c);
    real above_a = dot(a - c, normal), above_b = dot(b - c, normal);
    // A zero counts as positive on both sides of an edge, so that chains of edges and sheets of triangles have no holes.
    real side_a = select(above_a < real(0), real(-1), real(1)), side_b = select(above_b < real(0), real(-1), real(1));
    mask through = side_a * side_b < real(0);
    real t = above_a / select(through, above_a - above_b, real(1));
    vec3 p = a + (b - a) * t;
    real area = dot(normal, normal);
    real part_d = dot(cross(p - c, e - c), normal), part_e = dot(cross(d - c, p - c), normal);
    real part_c = area - part_d - part_e;
    PassingEdge edge;
    real inside = select(min(part_c, min(part_d, part_e)) < real(0), real(-1), real(1));
    edge.passes = through && area > real(0) && inside > real(0);
    real scale = real(1) / select(edge.passes, area, real(1));
    edge.w0 = real(1) - t;
    edge.w1 = t;
    edge.w2 = -part_c * scale;
    edge.w3 = -part_d * scale;
    edge.w4 = -part_e * scale;
    return edge;
}
