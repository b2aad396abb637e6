// Arguments and sizes of the scanning and sorting passes, shared by C++ and GLSL. The sizes respect the limits that
// every Vulkan device supports: workgroups of 128, 16 KiB of shared memory.
#ifndef WEFT_VULKAN_PRIMITIVES_ARGS_H
#define WEFT_VULKAN_PRIMITIVES_ARGS_H

#include "vulkan/args.data.h"

#define WEFT_GROUP 128  // invocations of a workgroup
#define WEFT_EACH 16    // elements per invocation
#define WEFT_TILE 2048  // elements per workgroup
#define WEFT_DIGIT_BITS 5
#define WEFT_DIGITS 32

#ifdef __cplusplus
namespace weft::vulkan {
static_assert(WEFT_GROUP * WEFT_EACH == WEFT_TILE && 1 << WEFT_DIGIT_BITS == WEFT_DIGITS);
#endif

struct ScanArgs {
    Uints source;
    Uints result;  // scan only; may be the source
    Uints sums;    // per tile: reduce writes its sum, scan reads the sum of all tiles before it; 0: there is one tile
    uint count;
    uint inclusive;
};

struct SortArgs {
    Uints high;
    Uints low;
    Uints value;
    Uints to_high;
    Uints to_low;
    Uints to_value;
    Uints places;  // [digit · tiles + tile]: how often the digit occurs; for scatter, how many keys come before
    uint count;
    uint tiles;
    uint shift;  // of the digit
    uint bits;   // of each word
};

#ifdef __cplusplus
static_assert(sizeof(SortArgs) <= 128);
}  // namespace weft::vulkan
#endif

#endif
