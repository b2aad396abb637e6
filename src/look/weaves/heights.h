// What a weave is made of before it is a Relief: heights on a square grid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace weft::weaves {

/// Lengths are spacings of threads. Sample (x, y) stands at u = (x + ½) step, v = (y + ½) step; all of it repeats.
struct Heights {
    std::uint32_t side = 0;      ///< samples
    std::uint32_t spacings = 0;  ///< threads a side
    std::vector<float> height, warp;

    Heights(std::uint32_t samples, std::uint32_t threads)
        : side(samples),
          spacings(threads),
          height(std::size_t{samples} * samples),
          warp(std::size_t{samples} * samples, 1.0f) {}
    float step() const { return static_cast<float>(spacings) / static_cast<float>(side); }
};

/// Two systems of threads that cross.
Heights plain(std::uint32_t side);
/// Warp over three, under one, a step aside in each row.
Heights twill(std::uint32_t side);
/// Warp over seven, under one, three steps aside.
Heights satin(std::uint32_t side);
/// Wales along u, the face of jersey.
Heights knit(std::uint32_t side);
/// Two wales of face stand above two of back.
Heights rib(std::uint32_t side);
/// Cushions with creases between them.
Heights grain(std::uint32_t side);

}  // namespace weft::weaves
