// What the passes of scanning and sorting are told, read by C++ and by GLSL, and their sizes. All are within what every
// device of Vulkan has: workgroups of 128, 16 KiB of shared memory.
#ifndef WEFT_VULKAN_PRIMITIVES_ARGS_H
#define WEFT_VULKAN_PRIMITIVES_ARGS_H

#include "vulkan/args.data.h"

#define WEFT_GROUP 128  // invocations of a workgroup
#define WEFT_EACH 16    // elements of one invocation
#define WEFT_TILE 2048  // elements of a workgroup
#define WEFT_DIGIT_BITS 5
#define WEFT_DIGITS 32

#ifdef __cplusplus
namespace weft::vulkan {
static_assert(WEFT_GROUP * WEFT_EACH == WEFT_TILE && 1 << WEFT_DIGIT_BITS == WEFT_DIGITS);
#endif

struct ScanArgs {
    Uints source;
    Uints result;  // of scan; may be the source
    Uints sums;    // of each tile: reduce writes them, scan reads the sum of all tiles before; 0: there is one tile
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
    Uints places;  // [digit · tiles + tile]: how many there are; for scatter, how many come before
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
