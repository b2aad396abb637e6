#version 460
#include "render/shaders/common.glsl"

layout(location = 0) out vec4 color;

void main() {
    FlatRef corners = FlatRef(push.items);
    FlatData one = corners.at[gl_VertexIndex];
    color = one.color;
    gl_Position = vec4(one.position.xy * frame.size.zw * 2.0 - 1.0, 0.0, 1.0);
}
