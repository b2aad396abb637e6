// The thickness of a cloth that is not the same everywhere.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

namespace weft {

/// A feature of several particles is as thick as at its thinnest one.
struct UnevenThickness {
    const float* factors = nullptr;  ///< by particle of the cloth; null: the thickness is the same everywhere
    float of_fabric = 0, least = 0;  ///< m: with factor 1, and the least that any particle has

    explicit operator bool() const { return factors != nullptr; }
    float at(std::uint32_t particle) const { return std::max(of_fabric * factors[particle], least); }
    float most_of(std::span<const std::uint32_t> particles) const {
        float most = 0;
        for (const std::uint32_t p : particles) most = std::max(most, at(p));
        return most;
    }
    friend bool operator==(const UnevenThickness&, const UnevenThickness&) = default;
};

}  // namespace weft
