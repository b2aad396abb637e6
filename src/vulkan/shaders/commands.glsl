// What commands are told. Each kind has a name of its own: particle_args.at.position is the address of the positions in
// ParticleArgs. It is read where it lies, in the constants that a dispatch pushes or behind a head of 16 bytes in the
// device's memory: a shader that copied it would keep addresses in variables, which some drivers cannot compile.
#ifndef WEFT_COMMANDS_GLSL
#define WEFT_COMMANDS_GLSL

uvec2 command = uvec2(0u);  // where it lies, if it is not pushed

layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer CommandRef {
    uint program;        // number of its shader
    uint invocations;
    uint needs_barrier;  // behind the command before it
    uint unused;
};

#define WEFT_COMMAND(Args)                                                         \
    layout(buffer_reference, std430, buffer_reference_align = 16) buffer Args##Ref \
    {                                                                              \
        uvec4 head; /* CommandRef */                                               \
        Args at;                                                                   \
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

// Of a shader that is pushed one kind, the block has that name (dispatch.glsl).
#ifndef WEFT_PUSHES_particle_args
#define particle_args ParticleArgsRef(command)
#endif
#ifndef WEFT_PUSHES_hold_args
#define hold_args HoldArgsRef(command)
#endif
#ifndef WEFT_PUSHES_average_args
#define average_args AverageArgsRef(command)
#endif
#ifndef WEFT_PUSHES_contact_args
#define contact_args ContactArgsRef(command)
#endif
#ifndef WEFT_PUSHES_keep_args
#define keep_args KeepArgsRef(command)
#endif
#ifndef WEFT_PUSHES_level_args
#define level_args LevelArgsRef(command)
#endif
#ifndef WEFT_PUSHES_face_args
#define face_args FaceArgsRef(command)
#endif
#ifndef WEFT_PUSHES_around_args
#define around_args AroundArgsRef(command)
#endif
#ifndef WEFT_PUSHES_line_args
#define line_args LineArgsRef(command)
#endif
#ifndef WEFT_PUSHES_limit_args
#define limit_args LimitArgsRef(command)
#endif
#ifndef WEFT_PUSHES_row_args
#define row_args RowArgsRef(command)
#endif

// A command that stands for those of several substeps runs once for each of them: how many were before this one.
uint substeps_before = 0u;

#endif
