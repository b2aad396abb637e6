#version 450
// Empty, to measure the cost of a dispatch itself.
layout(local_size_x_id = 0) in;

void main() {}
