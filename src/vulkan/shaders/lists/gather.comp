#version 450
// Adds up the corrections of an item's constraints and moves its particle.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/lists/list.glsl"

void main()
{
    uint item = list.first + invocation();
    if (item >= list.end) return;
    uint begin = first_row(item), end = first_row(item + 1u);
    if (begin == end) return;
    vec3 sum = vec3(0.0);
    for (uint row = begin; row < end; ++row) sum = sum + list.corrections.at[row].xyz;
    if (list.mean == 1u) sum = sum * (1.0 / float(end - begin));
    uint p = particle_of(member_of(item), item);
    vec4 x = list.position.at[p];
    list.position.at[p] = vec4(x.xyz + sum, x.w);
}
