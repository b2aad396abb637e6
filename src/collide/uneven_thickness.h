// The thickness of a cloth that is not the same everywhere.
#pragma once

#include <algorithm>
#include <cstdint>

namespace weft {

/// A feature of several particles is as thick as at its thinnest one.
struct UnevenThickness {
    const float* factors = nullptr;  ///< by particle of the cloth; null: the thickness is the same everywhere
    float of_fabric = 0, least = 0;  ///< m: with factor 1, and the least that any particle has

    explicit operator bool() const { return factors != nullptr; }
    float at(std::uint32_t particle) const { return std::max(of_fabric * factors[particle], least); }
    friend bool operator==(const UnevenThickness&, const UnevenThickness&) = default;
};

}  // namespace weft
