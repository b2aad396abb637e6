#version 450
// A descriptor set beyond what most devices have.
layout(local_size_x = 1) in;
layout(std430, set = 60, binding = 0) buffer Out { float result[]; };

void main() { result[0] = 1.0; }
