// Tells the processor what will be read soon, so that it is near by then.
#pragma once

#include <cstddef>

// Of functions that do nothing else: GCC takes those for ones without an effect, and leaves calls of them out.
#if defined(__GNUC__)
#define WEFT_PREFETCH [[gnu::always_inline]] inline
#else
#define WEFT_PREFETCH inline
#endif

namespace weft {

/// A hint and no more: nothing with compilers that have no word for it.
WEFT_PREFETCH void prefetch([[maybe_unused]] const void* begin, [[maybe_unused]] std::size_t bytes) {
#if defined(__GNUC__)
    constexpr std::size_t line = 64, most = 4 * line;
    for (std::size_t at = 0; at < bytes && at < most; at += line) {
        __builtin_prefetch(static_cast<const char*>(begin) + at);
    }
#endif
}

}  // namespace weft
