#version 460
#extension GL_EXT_buffer_reference : require
// A vertex of ImGui: a place in pixels, a place in the texture, and a color of four bytes, sRGB-encoded.

struct Vertex {
    float x, y, u, v;
    uint color;
};
layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer Vertices { Vertex at[]; };
layout(push_constant) uniform Push {
    Vertices vertices;
    vec2 scale, offset;
} push;

#ifndef WEFT_SOLID
layout(location = 0) out vec2 uv;
#endif
layout(location = 1) out vec4 color;

void main() {
    const Vertex vertex = push.vertices.at[gl_VertexIndex];
#ifndef WEFT_SOLID
    uv = vec2(vertex.u, vertex.v);
#endif
    color = unpackUnorm4x8(vertex.color);
    gl_Position = vec4(vec2(vertex.x, vertex.y) * push.scale + push.offset, 0.0, 1.0);
}
