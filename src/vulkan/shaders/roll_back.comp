#version 450
// Back to where the frame began, if something in it was not finite.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/common.glsl"
#include "vulkan/shaders/particles.glsl"

layout(push_constant) uniform Push { KeepArgs args; };

void main()
{
    run_roll_back(args, invocation());
}
