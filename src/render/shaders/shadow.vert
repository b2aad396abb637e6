#version 460
#include "render/shaders/common.glsl"
#include "render/shaders/mesh.glsl"

void main() {
    vec4 p = shadow.to_shadow * vec4(world_position(), 1.0);
    gl_Position = vec4(p.xy * 2.0 - 1.0, p.z, 1.0);
}
