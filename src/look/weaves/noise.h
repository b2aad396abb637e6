// Noise with the same bits on every platform: integer hashes and polynomials, no functions of the math library.
#pragma once

#include <cstdint>

namespace weft::weaves {

/// 0…1, a hash of the triple. The mixing is PCG's output function (O'Neill 2014; Jarzynski and Olano 2020).
inline float chance(std::uint32_t a, std::uint32_t b, std::uint32_t c = 0) {
    std::uint32_t x = a * 0x9e3779b9u + b * 0x85ebca6bu + c * 0xc2b2ae35u + 0x27220a95u;
    for (int round = 0; round < 2; ++round) {
        x = x * 747796405u + 2891336453u;
        x = ((x >> ((x >> 28) + 4)) ^ x) * 277803737u;
        x = (x >> 22) ^ x;
    }
    return static_cast<float>(x >> 8) * (1.0f / 16777216.0f);
}

/// -1…1.
inline float swing(std::uint32_t a, std::uint32_t b, std::uint32_t c = 0) {
    return 2 * chance(a, b, c) - 1;
}

/// From 0 at 0 to 1 at 1, with zero slope at both ends.
inline float eased(float t) {
    return t * t * (3 - 2 * t);
}

/// -1…1 with period 1, close to a cosine. t >= 0.
inline float wave(float t) {
    const float part = t - static_cast<float>(static_cast<std::int32_t>(t));
    return 2 * eased(part < 0.5f ? 1 - 2 * part : 2 * part - 1) - 1;
}

/// -1…1, smooth along `at`, different for each `thread`; repeats after `period` units. at >= 0.
inline float drift(std::uint32_t seed, std::uint32_t thread, float at, std::uint32_t period) {
    const auto knot = static_cast<std::uint32_t>(at);
    const float here = swing(seed, thread, knot % period), next = swing(seed, thread, (knot + 1) % period);
    return here + (next - here) * eased(at - static_cast<float>(knot));
}

}  // namespace weft::weaves
