#version 460
#include "common.glsl"
#include "mesh.glsl"

void main() { gl_Position = frame.to_clip * vec4(world_position(), 1.0); }
