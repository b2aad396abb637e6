#version 450
// Every operation on floats that a driver might fuse or simplify, and memory by address.
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require

layout(local_size_x_id = 0) in;
layout(buffer_reference, std430, buffer_reference_align = 4) buffer Floats { float at[]; };
layout(push_constant) uniform Push {
    Floats from;
    Floats to;
    uint count;
    float a;
    float b;
};

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    float x = from.at[i];
    vec3 v = vec3(x, a, b) * a + vec3(b, x, a) / b;
    mat3 m = mat3(v, v.yzx, v.zxy) * b;
    mat3 o = outerProduct(v, vec3(a, b, x));
    vec3 w = m * v - v * o;
    float s = dot(w, (m * o) * v) - mod(x, b);
    s += length(cross(v, w)) - mix(x, a, b);
    to.at[i] = -s + ((x + a) - x) * b;
}
