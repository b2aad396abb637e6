#version 460
#include "render/shaders/common.glsl"
#include "render/shaders/mesh.glsl"

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec4 tangent;
layout(location = 3) out vec2 uv;
layout(location = 4) out vec3 rest;
layout(location = 5) out float scalar;

void main() {
    position = world_position();
    normal = turned(object.normals.at[gl_VertexIndex].xyz);
    tangent = vec4(0.0);
    uv = vec2(0.0);
    rest = vec3(0.0);
    scalar = 0.0;
    if ((object.flags & object_has_tangents) != 0u) {
        vec4 t = object.tangents.at[gl_VertexIndex];
        tangent = vec4(turned(t.xyz), t.w);
    }
    if ((object.flags & object_has_uvs) != 0u) uv = object.uvs.at[gl_VertexIndex];
    if ((object.flags & object_has_rest) != 0u) {
        rest = vec3(object.rest.at[3 * gl_VertexIndex], object.rest.at[3 * gl_VertexIndex + 1],
                    object.rest.at[3 * gl_VertexIndex + 2]);
    }
    if ((object.flags & object_has_scalars) != 0u) scalar = object.scalars.at[gl_VertexIndex];
    gl_Position = frame.to_clip * vec4(position, 1.0);
}
