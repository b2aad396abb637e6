// Sequences that are evenly distributed over an interval.
#pragma once

#include <cstdint>

namespace weft::render {

/// The middles of `count` equal parts of 0…1.
inline float middle(std::uint32_t i, std::uint32_t count) {
    return (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
}

/// Van der Corput's sequence: 0, 0.5, 0.25, 0.75, …
inline float radical_inverse(std::uint32_t number) {
    float result = 0, digit = 0.5f;
    for (; number != 0; number >>= 1, digit *= 0.5f)
        if (number & 1) result += digit;
    return result;
}

}  // namespace weft::render
