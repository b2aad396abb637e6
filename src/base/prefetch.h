// Asks the processor to load data into its caches before it is read.
#pragma once

#include <cstddef>

// Forces inlining: GCC considers a function that only prefetches to have no effect and removes the calls.
#if defined(__GNUC__)
#define WEFT_PREFETCH [[gnu::always_inline]] inline
#else
#define WEFT_PREFETCH inline
#endif

namespace weft {

/// A hint only. Does nothing on compilers without a prefetch builtin.
WEFT_PREFETCH void prefetch([[maybe_unused]] const void* begin, [[maybe_unused]] std::size_t bytes) {
#if defined(__GNUC__)
    constexpr std::size_t line = 64, most = 4 * line;
    for (std::size_t at = 0; at < bytes && at < most; at += line) {
        __builtin_prefetch(static_cast<const char*>(begin) + at);
    }
#endif
}

}  // namespace weft
