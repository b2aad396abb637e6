#version 450
// A pass over particles or what is as simple: WEFT_PASS is its function, WEFT_ARGS refers to what that is told.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/common.glsl"
#include "vulkan/shaders/dispatch.glsl"
#include "vulkan/shaders/particles.glsl"
#include "vulkan/shaders/faces.glsl"
#include "vulkan/shaders/levels.glsl"

void main()
{
    Share share = share_of_workgroup();
    if (is_none(share.command)) return;
    uint i = invocation_of(share);
    if (i < CommandRef(share.command).invocations) WEFT_PASS(WEFT_ARGS(share.command), i);
}
