// Slack of the one-sided constraints in this frame, computed by one workgroup. It has two parts: the tension that 95 %
// of the stretch constraints stayed below in the last frame, and the stretch between pins that are too far apart.
// (solver/plan/tension.cpp is the CPU version.)
#ifndef WEFT_LIMITS_GLSL
#define WEFT_LIMITS_GLSL

#define WEFT_BINS 80u
#define WEFT_BINS_PER_DOUBLING 4u
#define WEFT_LEAST 1e-5
#define WEFT_MOST 100.0  // the last bin begins at 9
#define WEFT_ROWS_LOOKED_AT 16u  // constraints per vector; one vector in four is sampled

shared uint bins[WEFT_BINS];
shared uint strain_bits;  // largest strain between pins; the bits of positive floats have the order of the floats

// Bins of strain, found from exponent and thresholds, because drivers round logarithms differently.
const float bin_starts[WEFT_BINS_PER_DOUBLING] = float[](1.0, 1.18920712, 1.41421356, 1.68179283);

uint bin_of(float strain)
{
    if (!(strain > WEFT_LEAST)) return 0u;
    if (!(strain < WEFT_MOST)) return WEFT_BINS - 1u;
    uint bits = floatBitsToUint(max(strain / WEFT_LEAST, 1.0));
    float mantissa = uintBitsToFloat((bits & 0x7fffffu) | 0x3f800000u);  // 1 to 2
    uint part = WEFT_BINS_PER_DOUBLING - 1u;
    while (mantissa < bin_starts[part]) --part;
    return min(1u + WEFT_BINS_PER_DOUBLING * ((bits >> 23) - 127u) + part, WEFT_BINS - 1u);
}

float start_of(uint bin)
{
    uint steps = bin - 1u;
    return WEFT_LEAST * bin_starts[steps % WEFT_BINS_PER_DOUBLING] *
           uintBitsToFloat((127u + steps / WEFT_BINS_PER_DOUBLING) << 23);
}

// Constraints that were removed from a line keep their particles, without stiffness.
bool is_stiff(uint r)
{
    uint stride = limit_args.at.stride;
    return !(limit_args.at.fields.at[stride + r] < 0.0 && limit_args.at.fields.at[2u * stride + r] < 0.0);
}

void run_limits()
{
    // The limits depend on lambda of the previous frame, which the first run of this frame has overwritten.
    if (limit_args.at.frame.at.again == 1u) return;
    uint me = gl_LocalInvocationID.x, all = gl_WorkGroupSize.x;
    for (uint i = me; i < WEFT_BINS; i += all) bins[i] = 0u;
    if (me == 0u) strain_bits = 0u;
    barrier();

    float scale = limit_args.at.frame.at.strain_per_lambda;
    uint looked_at = scale != 0.0 ? limit_args.at.rows / (4u * WEFT_ROWS_LOOKED_AT) * WEFT_ROWS_LOOKED_AT +
                                             min(limit_args.at.rows % (4u * WEFT_ROWS_LOOKED_AT), WEFT_ROWS_LOOKED_AT)
                                       : 0u;
    for (uint i = me; i < looked_at; i += all) {
        uint r = i / WEFT_ROWS_LOOKED_AT * 4u * WEFT_ROWS_LOOKED_AT + i % WEFT_ROWS_LOOKED_AT;
        uint a = limit_args.at.particles.at[r];
        if (a >= limit_args.at.first_dummy || a == limit_args.at.particles.at[limit_args.at.stride + r]) continue;
        if (!is_stiff(r)) continue;
        float strain = scale * limit_args.at.lambda.at[r] / limit_args.at.fields.at[r];
        atomicAdd(bins[bin_of(strain)], 1u);
    }
    for (uint i = me; i < limit_args.at.spans; i += all) {
        vec3 a = load_point(limit_args.at.position, limit_args.at.span_ends.at[2u * i]).xyz;
        vec3 b = load_point(limit_args.at.position, limit_args.at.span_ends.at[2u * i + 1u]).xyz;
        atomicMax(strain_bits, floatBitsToUint(max(0.0, length(a - b) / limit_args.at.span_lengths.at[i] - 1.0)));
    }
    barrier();
    if (me == 0u) {
        uint count = 0u;
        for (uint i = 0u; i < WEFT_BINS; ++i) count += bins[i];
        uint above = 0u, bin = WEFT_BINS;
        while (bin > 1u && 20u * (above + bins[bin - 1u]) <= count) above += bins[--bin];
        // Upper end of the highest bin below the excluded 5 %.
        float strain = bin <= 1u ? 0.0 : start_of(bin);
        float straight = limit_args.at.straight_strain;
        float of_cloth = strain > straight ? straight + (strain - straight) / WEFT_STRAIGHT_STIFFNESS : strain;
        float measured = strain * (1.0 + of_cloth) * limit_args.at.softest;
        straight = limit_args.at.straight;
        float eased = measured > straight ? straight + (measured - straight) / WEFT_STRAIGHT_STIFFNESS : measured;
        float tension = max(0.0, eased - limit_args.at.model_tension);
        limit_args.at.limits.at.tension = tension;
        limit_args.at.limits.at.allowed = max(1.0, (1.0 + uintBitsToFloat(strain_bits)) / (1.0 + limit_args.at.stretched * tension));
    }
}

#endif
