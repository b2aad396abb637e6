#version 450
// More push constants and invocations than most devices support.
layout(local_size_x_id = 0, local_size_y_id = 1) in;
layout(std430, set = 0, binding = 0) buffer Out { float result[]; };
layout(push_constant) uniform Push { vec4 numbers[64]; };

void main() { result[0] = numbers[gl_LocalInvocationID.x].x; }
