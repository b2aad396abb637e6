// Selects the instruction sets that the loops are compiled for. Include before hwy/foreach_target.h, in every file that
// includes itself for each of them.
#pragma once

// Highway leaves out the sets in HWY_DISABLED_TARGETS: those whose loops are no faster here than those of the set
// below.
#if defined(WEFT_ONE_TARGET)
// With sanitizers these loops take minutes and gigabytes to compile for each instruction set. One set is enough to find
// the same errors.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3 | HWY_AVX3_DL)
#else
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#endif
