#version 450
// A descriptor set beyond the limits of most devices.
layout(local_size_x = 1) in;
layout(std430, set = 60, binding = 0) buffer Out { float result[]; };

void main() { result[0] = 1.0; }
