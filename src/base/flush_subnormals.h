// While it lives, results and operands too small for a normal float (below 1.2e-38) count as zero on this thread.
//
// Processors that handle them exactly do so in microcode, a hundred times slower, and cloth that lies flat makes them
// by the million. Nothing that is simulated is so small. GPUs flush them as a rule, and so do all lanes of a CPU here,
// so the bits stay the same for every instruction set.
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
