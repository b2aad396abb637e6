#version 450
// Bound buffers of both kinds in two sets, and specialization constants.
layout(local_size_x = 8, local_size_y_id = 4, local_size_z = 2) in;
layout(constant_id = 0) const uint first = 7;
layout(constant_id = 2) const float scale = 2.0;
layout(std430, set = 1, binding = 3) buffer Out { float result[]; };
layout(std140, set = 0, binding = 1) uniform In { vec4 numbers; };
layout(std430, set = 0, binding = 0) readonly buffer More { float more[]; };
layout(push_constant) uniform Push {
    uint offset;
    vec3 shift;
};

void main()
{
    uint i = gl_GlobalInvocationID.x + offset;
    result[i] = more[i] * scale + numbers.x + float(first) + shift.z;
}
