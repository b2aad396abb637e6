// Arguments of the reductions, shared by C++ and GLSL. A workgroup reduces a tile of elements and writes two words for
// it: the sum, and the bits of the largest term.
#ifndef WEFT_VULKAN_MEASURES_ARGS_H
#define WEFT_VULKAN_MEASURES_ARGS_H

#include "vulkan/primitives/args.data.h"

#ifdef __cplusplus
namespace weft::vulkan {
#endif

struct MeasureParticlesArgs {
    Vec4s position;
    Vec4s velocity;
    Floats masses;  // kg
    Uints found;
    uint count;
    uint unused;
};

struct MeasureEdgesArgs {
    Vec4s position;
    Uints edges;  // four each: the ends, and the square of the rest length as two floats
    Uints found;
    uint count;
    uint unused;
};

struct MeasureRowsArgs {
    Vec4s position;
    Uints particles;  // [slot · stride + row] of the stretch constraints
    Floats fields;    // [field · stride + row]
    Floats lambda;
    Uints found;
    float inv_h2;  // 1/s2  of the substep, as two floats; 0: the residual is C alone
    float inv_h2_low;
    uint stride;
    uint count;  // rows with padding
    uint first_dummy;
    uint unused;
};

#ifdef __cplusplus
static_assert(sizeof(MeasureRowsArgs) <= 128);
}  // namespace weft::vulkan
#endif

#endif
