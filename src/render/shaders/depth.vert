#version 460
#include "render/shaders/common.glsl"
#include "render/shaders/mesh.glsl"

void main() { gl_Position = frame.to_clip * vec4(world_position(), 1.0); }
