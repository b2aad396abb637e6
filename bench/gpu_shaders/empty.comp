#version 450
// Nothing: what is left is what a dispatch costs.
layout(local_size_x_id = 0) in;

void main() {}
