// Commands in the device's memory: what a shader is told lies behind a head of 16 bytes, and is read where it lies. A
// shader that copied it would keep addresses in variables of its own, which some drivers cannot compile.
#ifndef WEFT_COMMANDS_GLSL
#define WEFT_COMMANDS_GLSL

layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer CommandRef {
    uint program;        // number of its shader
    uint invocations;
    uint needs_barrier;  // behind the command before it
    uint unused;
};

#define WEFT_COMMAND(Args)                                                                  \
    layout(buffer_reference, std430, buffer_reference_align = 16) buffer Args##Ref          \
    {                                                                                       \
        uvec4 head; /* CommandRef */                                                        \
        Args at;                                                                            \
    };
WEFT_COMMAND(ParticleArgs)
WEFT_COMMAND(HoldArgs)
WEFT_COMMAND(AverageArgs)
WEFT_COMMAND(ContactArgs)
WEFT_COMMAND(KeepArgs)
WEFT_COMMAND(LevelArgs)
WEFT_COMMAND(FaceArgs)
WEFT_COMMAND(AroundArgs)
WEFT_COMMAND(LineArgs)
WEFT_COMMAND(LimitArgs)
WEFT_COMMAND(RowArgs)
#undef WEFT_COMMAND

// A command that stands for those of several substeps runs once for each of them: how many were before this one.
uint substeps_before = 0u;

#endif
