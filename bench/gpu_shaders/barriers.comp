#version 450
// Two barriers per round; between them each invocation reads what its neighbor has written.
#extension GL_EXT_buffer_reference : require
layout(local_size_x_id = 0) in;
layout(buffer_reference, std430, buffer_reference_align = 4) buffer Uints { uint at[]; };
layout(push_constant) uniform Push {
    Uints to;
    uint rounds;
};
shared uint values[1024];

void main()
{
    uint i = gl_LocalInvocationID.x;
    uint next = i + 1u == gl_WorkGroupSize.x ? 0u : i + 1u;
    uint x = i;
    for (uint r = 0u; r < rounds; ++r) {
        values[i] = x;
        barrier();
        x = values[next] + 1u;
        barrier();
    }
    to.at[i] = x;
}
