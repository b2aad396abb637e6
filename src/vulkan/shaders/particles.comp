#version 450
// A pass with one invocation per particle or other element. WEFT_PASS is its function.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/common.glsl"
#include "vulkan/shaders/dispatch.glsl"
#include "vulkan/shaders/particles.glsl"
#include "vulkan/shaders/targets.glsl"
#include "vulkan/shaders/cover.glsl"
#include "vulkan/shaders/body_contact.glsl"
#include "vulkan/shaders/face_contact.glsl"
#include "vulkan/shaders/faces.glsl"
#include "vulkan/shaders/grabs.glsl"
#include "vulkan/shaders/levels.glsl"

void main()
{
    if (!find_command()) return;
    uint i = invocation_of_command();
    if (i < invocations_of_command()) WEFT_PASS(i);
}
