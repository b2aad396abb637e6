// Arguments of commands. Each kind has its own name: particle_args.at.position is the address of the positions in
// ParticleArgs. Shaders read arguments in place: from the push constants of a dispatch, or from device memory after a
// head of 16 bytes. Copying them would keep addresses in variables, which some drivers cannot compile.
#ifndef WEFT_COMMANDS_GLSL
#define WEFT_COMMANDS_GLSL

uvec2 command = uvec2(0u);  // address of the command, if it is not pushed

layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer CommandRef {
    uint program;        // number of its shader
    uint invocations;
    uint needs_barrier;  // after the command before it
    uint unused;
};

#define WEFT_COMMAND(Args)                                                         \
    layout(buffer_reference, std430, buffer_reference_align = 16) buffer Args##Ref \
    {                                                                              \
        uvec4 head; /* CommandRef */                                               \
        Args at;                                                                   \
    };
WEFT_COMMAND(ParticleArgs)
WEFT_COMMAND(TargetArgs)
WEFT_COMMAND(GrabArgs)
WEFT_COMMAND(AverageArgs)
WEFT_COMMAND(SteadyArgs)
WEFT_COMMAND(TautArgs)
WEFT_COMMAND(CoupleArgs)
WEFT_COMMAND(ContactArgs)
WEFT_COMMAND(FaceContactArgs)
WEFT_COMMAND(KeepArgs)
WEFT_COMMAND(LevelArgs)
WEFT_COMMAND(LevelLimitArgs)
WEFT_COMMAND(FaceArgs)
WEFT_COMMAND(AroundArgs)
WEFT_COMMAND(LineArgs)
WEFT_COMMAND(LimitArgs)
WEFT_COMMAND(RowArgs)
#undef WEFT_COMMAND

// In a shader with one kind of push constants, the block itself has that name (dispatch.glsl).
#ifndef WEFT_PUSHES_particle_args
#define particle_args ParticleArgsRef(command)
#endif
#ifndef WEFT_PUSHES_target_args
#define target_args TargetArgsRef(command)
#endif
#ifndef WEFT_PUSHES_grab_args
#define grab_args GrabArgsRef(command)
#endif
#ifndef WEFT_PUSHES_average_args
#define average_args AverageArgsRef(command)
#endif
#ifndef WEFT_PUSHES_steady_args
#define steady_args SteadyArgsRef(command)
#endif
#ifndef WEFT_PUSHES_taut_args
#define taut_args TautArgsRef(command)
#endif
#ifndef WEFT_PUSHES_couple_args
#define couple_args CoupleArgsRef(command)
#endif
#ifndef WEFT_PUSHES_contact_args
#define contact_args ContactArgsRef(command)
#endif
#ifndef WEFT_PUSHES_face_contact_args
#define face_contact_args FaceContactArgsRef(command)
#endif
#ifndef WEFT_PUSHES_keep_args
#define keep_args KeepArgsRef(command)
#endif
#ifndef WEFT_PUSHES_level_args
#define level_args LevelArgsRef(command)
#endif
#ifndef WEFT_PUSHES_level_limit_args
#define level_limit_args LevelLimitArgsRef(command)
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

// Number of substeps before this one, for a command that is repeated once per substep.
uint substeps_before = 0u;

#endif
