// Treats results and operands too small for a normal float (below 1.2e-38) as zero on this thread while the object
// exists.
//
// Many processors handle subnormals in microcode, a hundred times slower, and cloth that lies flat produces millions of
// them. No simulated quantity is that small. GPUs usually flush subnormals, and all SIMD lanes here flush them too, so
// the bits are the same for every instruction set.
#pragma once

#if defined(__SSE2__)
#include <xmmintrin.h>
#elif defined(__aarch64__)
#include <cstdint>
#endif

namespace weft {

class FlushSubnormals {
  public:
    FlushSubnormals(const FlushSubnormals&) = delete;
    FlushSubnormals& operator=(const FlushSubnormals&) = delete;

#if defined(__SSE2__)
    FlushSubnormals() : before_(_mm_getcsr()) {
        _mm_setcsr(before_ | 0x8040u);
    }  // results, operands
    ~FlushSubnormals() {
        _mm_setcsr(before_);
    }

  private:
    unsigned before_;
#elif defined(__aarch64__)
    FlushSubnormals() {
        __asm__ volatile("mrs %0, fpcr" : "=r"(before_));
        __asm__ volatile("msr fpcr, %0" : : "r"(before_ | std::uint64_t{1} << 24));
    }
    ~FlushSubnormals() {
        __asm__ volatile("msr fpcr, %0" : : "r"(before_));
    }

  private:
    std::uint64_t before_;
#else
    FlushSubnormals() {}
#endif
};

}  // namespace weft
