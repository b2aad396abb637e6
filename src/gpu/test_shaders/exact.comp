#version 450
// Already decorated by the compiler.
layout(local_size_x = 1) in;
layout(std430, set = 0, binding = 0) buffer Out { float result[]; };

void main()
{
    precise float sum = result[0] * result[1] + result[2];
    result[3] = sum - result[0] * result[2];
}
