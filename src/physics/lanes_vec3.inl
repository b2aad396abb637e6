// Vectors of three lane values, named as in GLSL. Included inside a namespace that has `real`, `mask`, `select` and the
// scalar functions, by lanes.h and lanes_scalar.inl.

struct vec3 {
    real x, y, z;

    vec3() = default;
    WEFT_FN vec3(real x_, real y_, real z_) : x(x_), y(y_), z(z_) {}
    WEFT_FN explicit vec3(real s) : x(s), y(s), z(s) {}
};

WEFT_FN vec3 operator+(vec3 a, vec3 b) { return vec3(a.x + b.x, a.y + b.y, a.z + b.z); }
WEFT_FN vec3 operator-(vec3 a, vec3 b) { return vec3(a.x - b.x, a.y - b.y, a.z - b.z); }
WEFT_FN vec3 operator-(vec3 a) { return vec3(-a.x, -a.y, -a.z); }
WEFT_FN vec3 operator*(vec3 a, real s) { return vec3(a.x * s, a.y * s, a.z * s); }
WEFT_FN vec3 operator*(real s, vec3 a) { return vec3(a.x * s, a.y * s, a.z * s); }
WEFT_FN real dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
WEFT_FN vec3 cross(vec3 a, vec3 b) {
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
WEFT_FN vec3 select(mask m, vec3 yes, vec3 no) {
    return vec3(select(m, yes.x, no.x), select(m, yes.y, no.y), select(m, yes.z, no.z));
}
