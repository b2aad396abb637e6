// For one lane only, in C++ and GLSL: the number of steps differs from pair to pair.

WEFT_FN real pair_distance(bool edges, vec3 x0, vec3 x1, vec3 x2, vec3 x3) {
    if (edges) return closest_edge_edge(x0, x1, x2, x3).distance;
    return closest_vertex_triangle(x0, x1, x2, x3).distance;
}

// Whether the sides of a pair come within their thickness while each particle moves straight from x to x + m. The gap
// along the normal alone does not say so, since features may pass each other far to the side; and a pair that does not
// come near must do nothing, or the result would depend on which pairs are listed. Conservative advancement: every step
// is as long as the distance allows.
WEFT_FN bool comes_near(bool edges, vec3 x0, vec3 x1, vec3 x2, vec3 x3, vec3 m0, vec3 m1, vec3 m2, vec3 m3,
                        real distance, real thickness) {
    if (distance <= thickness) return true;
    // The largest relative motion of a particle of one side and one of the other.
    vec3 a = m0 - m2, b = m0 - m3, c = edges ? m1 - m2 : m0 - m1, d = edges ? m1 - m3 : a;
    real fastest = sqrt(max(max(dot(a, a), dot(b, b)), max(dot(c, c), dot(d, d))));
    real time = real(0);
    // Without a return in the loop, which some drivers compile wrongly.
    for (int step = 0; step < 64 && distance > thickness && time < real(1); ++step) {
        time = min(time + (distance - real(0.5) * thickness) / fastest, real(1));
        distance = pair_distance(edges, x0 + m0 * time, x1 + m1 * time, x2 + m2 * time, x3 + m3 * time);
    }
    return distance <= thickness || time < real(1);
}
