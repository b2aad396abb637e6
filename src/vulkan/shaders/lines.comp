#version 450
// Rows of stretch, a line to an invocation.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/common.glsl"
#include "vulkan/shaders/lines.glsl"

layout(push_constant) uniform Push { LineArgs args; };

void main()
{
    run_lines(args, invocation());
}
